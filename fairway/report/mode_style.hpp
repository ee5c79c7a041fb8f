// The look of a plan's modes (docs/modes.md): the first as what reaches, further ones by the hue of
// the direction that they go on in, with a pattern that changes from one to the next.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fairway/plan/plan_record.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {

struct ModeLook {
  std::string name;  ///< "mode 3: on towards 90 degrees"
  VerdictStyle style;
};

/// A look for each of `modes` modes, the first included. `further`: how those after it were made,
/// in order: grey where they have no direction. Where nothing is told, hues are spread evenly.
[[nodiscard]] std::vector<ModeLook> mode_looks(int modes, std::span<const ModeRecord> further);

/// Of states that no mode is proved to bring.
[[nodiscard]] VerdictStyle no_mode_style();

}  // namespace fairway
