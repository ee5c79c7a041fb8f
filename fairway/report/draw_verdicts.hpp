// Pictures of a verdict map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/report/picture.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct VerdictPictureOptions {
  std::string title = {};
  double panel_pt = 0.0;  ///< longer side of a panel, points, 30..1000; 0: chosen to suit a page
  double pixels_per_pt = 2.0;  ///< resolution of the PNG, 0.5..8
  /// Of draw_verdicts: [headings][ny][nx], 1 for undecided states that are at risk; none: not
  /// known.
  const std::vector<std::uint8_t>* at_risk = nullptr;
};

/// A panel for each heading, four in a row: the verdict of a vehicle at each cell's centre with
/// that heading, by colour and pattern. Throws PreconditionViolation when an option is out of
/// range, the map's arrays do not fit, or it has no heading.
[[nodiscard]] Picture draw_verdicts(const VerdictMap& map, const VerdictPictureOptions& options);

/// Three panels: of the states of each cell, over all headings, the share proved to reach (or to
/// hold), the share proved to fail, and the share undecided; in classes, so that one state among
/// all shows.
[[nodiscard]] Picture draw_proved_shares(const VerdictMap& map,
                                         const VerdictPictureOptions& options);

}  // namespace fairway
