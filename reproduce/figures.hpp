// Figs. 3 to 8 of paper 1, drawn and measured.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fairway/field/field.hpp"
#include "fairway/report/picture.hpp"
#include "reproduce/measures.hpp"

namespace fairway::reproduce {

/// One curve of Figs. 6 to 8, and the same over many random starts.
struct GoalRow {
  std::string name;
  double cell_m = 0.0;
  double sigma_cells = 0.0;
  HeadingMeasures drawn;  ///< the flight of the figure
  double drawn_time_s = 0.0;
  double reached_share = 0.0;  ///< of the random safe-start states
  double mean_turning_rad = 0.0;
  double mean_reversals = 0.0;
  double mean_rms_rate_radps = 0.0;
  double mean_largest_rate_radps = 0.0;
};
struct PathRow {
  std::string name;
  double cell_m = 0.0;
  double sigma_cells = 0.0;
  PathMeasures lap;  ///< one lap, after a first one
};

struct Reproduction {
  std::map<std::string, Picture> pictures;  ///< by file name without ending, "fig6a" and so on
  std::vector<GoalRow> goal_by_sigma;       ///< Fig. 6
  std::vector<PathRow> path_by_sigma;       ///< Fig. 7
  std::vector<GoalRow> goal_by_cell;        ///< Fig. 8a
  std::vector<PathRow> path_by_cell;        ///< Fig. 8b
};

/// Metric, filter and blend as printed. Values that the paper leaves open are the middle of its
/// ranges.
[[nodiscard]] FieldOptions options_to_the_letter();

/// Reads demo.toml and path.toml in `demo`. `base` has every option but sigma_cells.
[[nodiscard]] Reproduction reproduce_figures(const std::filesystem::path& demo,
                                             const FieldOptions& base);

}  // namespace fairway::reproduce
