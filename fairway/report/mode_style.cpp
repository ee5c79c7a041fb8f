#include "fairway/report/mode_style.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "fairway/base/heading.hpp"

namespace fairway {
namespace {

/// "90 degrees": of a direction counter-clockwise from east, in [0, 360).
std::string degrees_text(double direction_rad) {
  const double degrees = std::round(direction_rad * 180.0 / pi * 10.0) / 10.0;
  return fmt::format("{:g} degrees", degrees - 360.0 * std::floor(degrees / 360.0));
}

std::string name_of(int mode, const ModeRecord* record) {
  if (mode == 0) return "mode 0: the plan's own";
  if (record == nullptr || record->rule.empty()) return fmt::format("mode {}", mode);
  if (record->rule != "direction" || !record->direction_rad) {
    std::string rule = record->rule;
    for (char& c : rule) c = c == '_' ? ' ' : c;
    return fmt::format("mode {}: {}", mode, rule);
  }
  return fmt::format("mode {}: on towards {}", mode, degrees_text(*record->direction_rad));
}

}  // namespace

std::vector<ModeLook> mode_looks(int modes, std::span<const ModeRecord> further) {
  std::vector<ModeLook> looks{{name_of(0, nullptr), style_of(Verdict::reach)}};
  for (int mode = 1; mode < modes; ++mode) {
    const auto k = static_cast<std::size_t>(mode - 1);
    const ModeRecord* record = k < further.size() ? &further[k] : nullptr;
    const bool directed = record != nullptr && record->direction_rad.has_value();
    // Directions of a record are finite; those of another program may be many turns.
    const double turn =
        directed ? *record->direction_rad / two_pi : mode / std::max(1.0, modes - 1.0);
    const double hue_deg = 360.0 * (turn - std::floor(turn));
    const bool grey = record != nullptr && !directed;
    VerdictStyle style{color_of_oklch(grey ? 0.62 : 0.74, grey ? 0.0 : 0.13, hue_deg),
                       {palette::white, 0.5, {}}};
    style.rising = mode % 3 == 2;
    style.falling = mode % 3 == 0;
    looks.push_back({name_of(mode, record), style});
  }
  return looks;
}

VerdictStyle no_mode_style() {
  return {color_of_oklch(0.95, 0.0, 0.0), {palette::ink, 0.5, {0.7, 1.8}}, false, true};
}

}  // namespace fairway
