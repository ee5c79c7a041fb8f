// Three panels of shares side by side, and code shared with other panels of a map.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "fairway/report/draw_verdicts.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// "heading 45°", from 0 to 360.
[[nodiscard]] std::string heading_text(double heading_rad);

struct SharePanels {
  static constexpr std::size_t count = 3;  ///< reaches, fails, open: the colours are theirs
  std::array<const char*, count> names{};
  std::size_t each = 0;  ///< what is counted in a sample, at least 1
  std::string of;        ///< "of 32 states per cell": the legend's first line
  std::function<std::size_t(std::size_t sample, std::size_t panel)> part;
};

/// Throws PreconditionViolation when an option is out of range or `each` is 0.
[[nodiscard]] Picture draw_share_panels(const VerdictMap& map, const SharePanels& shares,
                                        const VerdictPictureOptions& options);

}  // namespace fairway
