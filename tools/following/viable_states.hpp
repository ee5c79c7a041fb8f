// The states from which some control comes to the path, facing along it, without touching an
// obstacle: what no field can exceed.
//
// A search, from each state by itself, over arcs of the turning radius to the left and right and
// straight pieces, ten degrees of a turn long; places nearer to one another than a tenth of a
// radius, with the same heading, count as one. What it finds is a way that can be flown: the share
// of states with one is a bound from below. With `cut_m` > 0 ways may cut so far into obstacles:
// what has not even such a way has hardly any, so that this share is an estimate from above.
#pragma once

#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/path_locator.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway::following {

class ViableStates {
 public:
  /// Of a plan with a path mission; keeps a reference to it.
  explicit ViableStates(const Plan& plan);

  [[nodiscard]] bool contains(const State& state, double cut_m) const;

 private:
  struct Node;

  bool is_blocked(Vec2 place, double cut_m) const;
  bool is_clear(const Node& from, int side, double cut_m) const;
  Node after(const Node& from, int side, double share) const;
  double off_rad(const Node& node) const;

  const Plan& plan_;
  PathLocator path_;
  double r_;
};

}  // namespace fairway::following
