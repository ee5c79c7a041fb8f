// The states from which some control comes to the path, facing along it, without touching an
// obstacle: what no field can exceed, measured on a grid of places and headings.
//
// V(x, h) = the clearance that the best control keeps on its way there = clearance(x) on the path,
// elsewhere min(clearance(x), max over left, straight and right of V one step on). Values between
// the grid's places are interpolated, so the border of the set is known to about half a step of
// the grid; in corridors hardly wider than a turn back that matters, and errs on the large side.
#pragma once

#include <cstdint>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway::following {

class ViableStates {
 public:
  /// Of the cells from which the plan has commands. `fineness`: places per side of a cell.
  ViableStates(const Plan& plan, int fineness);

  [[nodiscard]] bool contains(const State& state) const;

 private:
  float value_at(Vec2 place_m, int heading) const;
  float best_after(Vec2 place_m, int heading) const;

  Grid fine_;
  double turn_radius_m_;
  std::vector<std::int32_t> node_;   // [fine cell] its number, -1: none
  std::vector<std::uint32_t> cell_;  // [node] of the fine grid
  std::vector<float> clearance_m_;   // [node]
  std::vector<float> value_m_;       // [node][heading]
};

}  // namespace fairway::following
