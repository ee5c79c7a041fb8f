// A picture of what any control could do.
#pragma once

#include <vector>

#include "fairway/ceiling/ceiling.hpp"
#include "fairway/map/region.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// Three panels: of the states of each cell, over all headings, the share that some control brings
/// to the mission, the share that none does, and what lies between the bounds. With the verdicts of
/// a plan, which has the same mission: what it is proved to keep, what none could, and what is
/// neither.
[[nodiscard]] Picture draw_ceiling(const Ceiling& ceiling, const std::vector<Region>& region,
                                   const VerdictPictureOptions& options,
                                   const VerdictMap* plan = nullptr);

}  // namespace fairway
