// Pictures of a bitmap: paper 2's reachability map (section V.B, Fig. 23a).
#pragma once

#include "fairway/bitmap/reachability_map.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

/// A panel for each heading, four in a row: what the samples say about a vehicle at each cell's
/// centre with that heading. Throws PreconditionViolation as draw_verdicts does.
[[nodiscard]] Picture draw_reachability_slices(const ReachabilityMap& map,
                                               const VerdictPictureOptions& options);

/// Three panels: of the headings at each cell's centre, the share that reaches, the share that does
/// not, and the share for which samples disagree; in the classes of draw_proved_shares.
[[nodiscard]] Picture draw_reachability_shares(const ReachabilityMap& map,
                                               const VerdictPictureOptions& options);

}  // namespace fairway
