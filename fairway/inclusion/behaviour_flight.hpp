// How sets of behaviours within a contract fly over the parts of a plan's cells, from the borders
// of parts to the next ones they may cross.
//
// A set of behaviours is a convex set of places with an arc of headings. In a part whose arc holds
// its heading a behaviour is *aligned*: its heading stays in the arc for as long as it is in the
// part, whatever it does there, so that it leaves within a cone. Elsewhere it *turns*: its heading
// is monotone, and is the clock. In steps of a few degrees a convex set holds where all turning
// behaviours may be; the step ends at once where an arc that is met begins or ends, so that within
// a step every part either is one where behaviours are aligned or is not.
//
// Properties that always hold:
//   1. Every behaviour within the contract that starts in the set crosses one of the ranges of the
//      image, aligned with the part it leaves, or ends with one of its ends, or the image gave up,
//      or is partial.
//      Whatever it touches before that crossing is among the ends.
//   2. Obstacles and the outside are grown by `place_slack`: to come so near is to touch.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

class Tube;

/// Sides of a part, in the order of their outward headings 0, 90, 180, 270 degrees. Places along a
/// side count from the right of one who looks outwards, 0 to 1.
enum class PartSide : std::uint8_t { east, north, west, south };

/// Behaviours that leave a part over a range of one of its sides, with headings of its arc.
struct Crossing {
  PartPlace part;
  PartSide side = PartSide::east;
  double lo = 0.0;
  double hi = 0.0;
  HeadingArc headings;  ///< all that the behaviours had since they started, widened
  double flown = 0.0;   ///< at most, in parts
};

struct PartVisit {
  std::size_t part;
  HeadingArc headings;
};

struct BehaviourImage {
  std::vector<Crossing> crossings;
  std::uint8_t ends = 0;  ///< bit v: some behaviour may end with Verdict v
  double flown = 0.0;     ///< at most, in parts, by those that end
  bool gave_up = false;
  bool is_partial = false;  ///< enough was known before all was flown
  // With a tube, over all parts on the way (tube.hpp):
  float distance_m = 0.0F;        ///< of the farthest
  double off_rad = 0.0;           ///< between a heading and the path, at most
  std::vector<PartVisit> visits;  ///< when they are told: all parts on the way

  bool may_end(Verdict v) const { return (ends >> static_cast<unsigned>(v) & 1U) != 0; }
};

struct BehaviourOptions {
  double step_rad = 0.0872664625997165;  ///< of the heading, while turning
  int most_steps = 600;                  ///< of all sets of one image, before it is given up
  const Tube* tube = nullptr;            ///< to tell how far from the path an image leads
  bool tells_visits = false;
  /// Asked after every step: whether what the image has by now is enough, so that the rest need not
  /// be flown.
  const std::function<bool(const BehaviourImage&)>* is_enough = nullptr;
};

/// Of all that leave `part`, an ordinary one, over places [lo, hi] of `side`, aligned with it.
[[nodiscard]] BehaviourImage image_of_crossing(const Parts& parts, PartPlace part, PartSide side,
                                               double lo, double hi,
                                               const BehaviourOptions& options = {});

/// Of a single state: `place` in parts.
[[nodiscard]] BehaviourImage image_of_state(const Parts& parts, Vec2 place, double heading_rad,
                                            const BehaviourOptions& options = {});

/// Of all states at a place of `set`, which lies in `part`, an ordinary one, and with a heading of
/// `headings`.
[[nodiscard]] BehaviourImage image_of_states(const Parts& parts, PartPlace part,
                                             const ConvexSet& set, const HeadingArc& headings,
                                             const BehaviourOptions& options = {});

}  // namespace fairway
