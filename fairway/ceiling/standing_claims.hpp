// What can be claimed of states without looking a whole step ahead, and what limits claims.
#pragma once

#include <vector>

#include "fairway/ceiling/ball_lattice.hpp"
#include "fairway/ceiling/signed_distance.hpp"

namespace fairway {

/// The places along the straight flight through a node with a bin's middle heading, as offsets of
/// fine places. Every flight through the node passes within `loses` less what the offset misses.
struct FlownBy {
  double time = 0.0;  ///< negative: before the node
  int columns[4] = {};
  int rows[4] = {};
  int loses[4] = {};  ///< units: how much less (more) than at the fine place a distance may be
};

class StandingClaims {
 public:
  StandingClaims(const BallLattice& lattice, const SignedDistance& obstacles,
                 const SignedDistance& goal);

  /// For the claim "cannot reach the mission".
  struct Lost {
    Radius always = 0;   ///< in an obstacle
    Radius ahead = 0;    ///< every flight hits an obstacle within half a step, and no goal before
    Radius behind = 0;   ///< every flight that got here hit one within half a step before
    Radius no_goal = 0;  ///< no flight meets the goal within a step
  };
  [[nodiscard]] Lost lost(int k, int y, int x) const;

  /// For the claim "some control brings it to the mission".
  struct Inside {
    Radius goal = 0;    ///< in the goal
    Radius ahead = 0;   ///< no flight touches an obstacle within half a step
    Radius around = 0;  ///< nor within half a step before
  };
  [[nodiscard]] Inside inside(int k, int y, int x) const;

 private:
  const BallLattice& l_;
  const SignedDistance& obstacles_;
  const SignedDistance& goal_;
  int between_ = 0;  // half the length between two places of a flight, units
  std::vector<std::vector<FlownBy>> flown_;  // [bin], from half a step before to a step after
};

}  // namespace fairway
