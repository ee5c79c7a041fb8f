// What a proof that behaviours follow a path says beyond the verdicts of leaves: which leaves are
// its core, how near to the path behaviours of the core stay, and how they go round it.
//
// From a leaf of the core every behaviour crosses into leaves of the core, for ever (on an open
// path: or comes to its end). Every leaf of the core has a *stage* of the lap, and stages are
// passed in their order. In most of them all headings lie within an angle of one direction u, less
// than a right one, so that a behaviour on its way from x to x' takes at most (x' - x) . u / (v
// cos(angle)). Added up over a lap, places where one stage ends count only with the *difference* of
// the vectors u / (v cos) of the stages before and after: little in a gentle bend, nothing on a
// straight. So it does not matter how far before or behind the others a behaviour goes on to the
// next stage.
//
// Where the path bends too sharply for that, the leaves of one long stage are in groups that are
// left in turn, as in contract_verdicts.hpp.
//
// Properties that always hold:
//   1. From a leaf of stage k every behaviour crosses into leaves of stage k, or of one up to a
//      third of a lap further on.
//   2. Until then all its headings lie within off_rad[k] of heading_rad[k], or off_rad[k] is NaN:
//      then property 3 of contract_verdicts.hpp holds for links within the stage, and whoever comes
//      to the stage leaves it within time_s[k].
//   3. From passing to the first stage from the last until passing there again, no behaviour takes
//      less than lap_least_s or more than lap_most_s.
//   4. A part in which a behaviour of the core may be, the nearest point of the path to whose
//   middle
//      lies in a stretch of the tube, lies within distance_m of the path, and headings there are
//      within off_rad of the path's tangents at the points nearest to the part's places.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct LapStages {
  std::vector<float> heading_rad;  ///< [stages]
  std::vector<float> off_rad;      ///< [stages]
  std::vector<float> time_s;       ///< [stages]; 0 where there is a direction
  std::vector<float> station_m;    ///< [stages], of the path where it begins
  double lap_least_s = 0.0;
  double lap_most_s = 0.0;

  std::size_t size() const { return heading_rad.size(); }
};

/// Between two stations of the path, of all that follow it.
struct TubeStretch {
  float distance_m = 0.0F;  ///< from the path, at most
  float off_rad = 0.0F;     ///< from the tangent, at most
};

/// The largest distance and the largest angle.
inline TubeStretch widest_of(const std::vector<TubeStretch>& tube) {
  TubeStretch widest;
  for (const TubeStretch& s : tube) {
    widest = {std::max(widest.distance_m, s.distance_m), std::max(widest.off_rad, s.off_rad)};
  }
  return widest;
}

/// Of a goal mission that holds: the path is a circle there, and who follows it stays in this disc.
/// It is all that is proved: there is one stage, without laps.
struct HoldDisc {
  Vec2 goal_m;
  double radius_m = 0.0;
};

struct FollowProof {
  PathMission path;  ///< the line that is followed; its tolerances are not used
  std::vector<std::uint16_t> leaf_stage;  ///< [leaves], from 1; 0: not of the core
  LapStages stages;                       ///< of an open path one, without a direction
  std::vector<TubeStretch> tube;          ///< equal stretches, from the path's first vertex

  std::optional<HoldDisc> hold;
};

}  // namespace fairway
