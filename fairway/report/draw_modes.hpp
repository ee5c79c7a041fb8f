// A picture of which mode serves which states.
#pragma once

#include <vector>

#include "fairway/report/draw_verdicts.hpp"
#include "fairway/report/mode_style.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// A panel for each heading, four in a row: the first mode that is proved to reach from each cell's
/// middle with that heading. The legend has the modes that serve a state of the picture. `looks`:
/// of map.modes modes. Throws PreconditionViolation as draw_verdicts() does, and when looks are
/// missing.
[[nodiscard]] Picture draw_modes(const VerdictMap& map, const std::vector<ModeLook>& looks,
                                 const VerdictPictureOptions& options);

}  // namespace fairway
