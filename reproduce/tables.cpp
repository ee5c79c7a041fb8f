#include "reproduce/tables.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace fairway::reproduce {
namespace {

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string goal_table(const std::vector<GoalRow>& rows) {
  std::string text =
      "| | turning (rad) | reversals | rms rate (rad/s) | largest rate (rad/s) | time (s) |"
      " reach | mean turning (rad) | mean reversals | mean rms rate (rad/s) | mean largest rate"
      " (rad/s) |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const GoalRow& r : rows)
    text += fmt::format(
        "| {} | {:.2f} | {} | {:.3f} | {:.3f} | {:.1f} | {:.1f} % | {:.2f} | {:.2f} | {:.4f} |"
        " {:.4f} |\n",
        r.name, r.drawn.turning_rad, r.drawn.reversals, r.drawn.rms_rate_radps,
        r.drawn.largest_rate_radps, r.drawn_time_s, 100.0 * r.reached_share, r.mean_turning_rad,
        r.mean_reversals, r.mean_rms_rate_radps, r.mean_largest_rate_radps);
  return text;
}

std::string path_table(const std::vector<PathRow>& rows) {
  std::string text =
      "| | mean (m) | max (m) | mean away from corners (m) | mean corner spike (m) | spike at each"
      " corner (m) |\n|---|---|---|---|---|---|\n";
  for (const PathRow& r : rows) {
    std::string corners;
    for (const double spike : r.lap.corner_m)
      corners += fmt::format("{}{:.1f}", corners.empty() ? "" : ", ", spike);
    text += fmt::format("| {} | {:.2f} | {:.1f} | {:.2f} | {:.1f} | {} |\n", r.name, r.lap.mean_m,
                        r.lap.max_m, r.lap.mean_of_straights_m, mean_of(r.lap.corner_m), corners);
  }
  return text;
}

nlohmann::json numbers_of(const GoalRow& r) {
  return {{"cell_m", r.cell_m},
          {"sigma_cells", r.sigma_cells},
          {"turning_rad", r.drawn.turning_rad},
          {"reversals", r.drawn.reversals},
          {"rms_rate_radps", r.drawn.rms_rate_radps},
          {"largest_rate_radps", r.drawn.largest_rate_radps},
          {"time_s", r.drawn_time_s},
          {"reached_share", r.reached_share},
          {"mean_turning_rad", r.mean_turning_rad},
          {"mean_reversals", r.mean_reversals},
          {"mean_rms_rate_radps", r.mean_rms_rate_radps},
          {"mean_largest_rate_radps", r.mean_largest_rate_radps}};
}

nlohmann::json numbers_of(const PathRow& r) {
  return {{"cell_m", r.cell_m},
          {"sigma_cells", r.sigma_cells},
          {"mean_m", r.lap.mean_m},
          {"max_m", r.lap.max_m},
          {"mean_of_straights_m", r.lap.mean_of_straights_m},
          {"corner_m", r.lap.corner_m}};
}

template <typename Row>
nlohmann::json list_of(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows) list.push_back(numbers_of(row));
  return list;
}

}  // namespace

std::string tables_of(const Reproduction& r) {
  return "Fig. 6, heading of the single goal mission by sigma, cells of 8 m:\n\n" +
         goal_table(r.goal_by_sigma) +
         "\nFig. 7, distance from the path by sigma, cells of 8 m:\n\n" +
         path_table(r.path_by_sigma) +
         "\nFig. 8a, heading by resolution (sigma 16, 8, 4 cells):\n\n" +
         goal_table(r.goal_by_cell) +
         "\nFig. 8b, distance from the path by resolution (sigma 16, 8, 4 cells):\n\n" +
         path_table(r.path_by_cell);
}

nlohmann::json numbers_of(const Reproduction& r) {
  return {{"fig6", list_of(r.goal_by_sigma)},
          {"fig7", list_of(r.path_by_sigma)},
          {"fig8a", list_of(r.goal_by_cell)},
          {"fig8b", list_of(r.path_by_cell)}};
}

}  // namespace fairway::reproduce
