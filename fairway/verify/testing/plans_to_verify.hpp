// Plans for tests and falsification: random ones, made as hard as possible.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// A plan as the certified method sees it; owns the arrays that the flow points to.
struct PlanFlow {
  const Plan& plan;
  std::vector<CellKind> kind;
  std::vector<bool> is_free;

  explicit PlanFlow(const Plan& plan_) : plan(plan_) {
    for (const Region region : plan.region) {
      kind.push_back(region == Region::obstacle ? CellKind::obstacle
                     : region == Region::goal   ? CellKind::target
                                                : CellKind::ordinary);
      is_free.push_back(region == Region::free);
    }
  }
  Flow flow() const { return {plan.grid, plan.vehicle, plan.heading_rad.data(), kind.data()}; }
};

inline Plan empty_plan(int nx, int ny, double cell_m, double turn_radius_m) {
  Plan plan;
  plan.grid = {nx, ny, 0.0, 0.0, cell_m};
  plan.vehicle = {10.0, turn_radius_m};
  plan.heading_rad.assign(plan.grid.size(), 0.0F);
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  return plan;
}

enum class FieldStyle { rough, smooth, axes, quarters, weaving, goalward };
inline constexpr int field_styles = 6;

/// The command of one cell, in the styles without memory.
inline double sample_heading(FieldStyle style, Random& random, Vec2 p, Vec2 goal, double twist) {
  static constexpr std::array<double, 9> axes{0.0,  1.5707963, -1.5707963, 3.1415925, -3.1415925,
                                              1e-8, -1e-8,     0.78539816, 1e-4};
  switch (style) {
    case FieldStyle::rough:
      return random.uniform(-pi, pi);
    case FieldStyle::smooth:
      return 2.5 * std::sin(p.x * 0.9 + twist) + 2.0 * std::cos(p.y * 0.7 - twist);
    case FieldStyle::axes:
      return axes[random.below(axes.size())];
    case FieldStyle::quarters:
      return static_cast<double>(random.below(8)) * (pi / 4);
    case FieldStyle::weaving:  // towards a line, from both sides
      return (p.y > goal.y ? -1.0 : 1.0) * std::exp(-10.0 * random.unit()) +
             (random.below(4) == 0 ? pi : 0.0);
    case FieldStyle::goalward:
      return std::atan2(goal.y - p.y, goal.x - p.x) + 0.9 * std::sin(p.x * 0.5 + twist);
  }
  return 0.0;
}

/// Random plan number `seed`: size, ratio of cell to turning radius, field, obstacles, goal cells
/// and cells without a command all vary.
inline Plan random_plan(std::uint64_t seed) {
  Random random = Random::stream(0x5eed, seed);
  static constexpr std::array<double, 6> ratios{0.99, 0.9, 0.5, 0.4, 0.1, 0.999999};
  const int nx = 3 + static_cast<int>(random.below(10));
  const int ny = 3 + static_cast<int>(random.below(10));
  const double cell_m = random.below(2) == 0 ? 1.0 : random.uniform(0.3, 40.0);
  Plan plan = empty_plan(nx, ny, cell_m, cell_m / ratios[random.below(ratios.size())]);
  if (random.below(2) == 0) {
    plan.grid.x0_m = random.uniform(-1e4, 1e4);
    plan.grid.y0_m = random.uniform(-1e4, 1e4);
  }
  const auto style = static_cast<FieldStyle>(seed % field_styles);
  const double twist = random.uniform(-pi, pi);
  const Vec2 goal{random.uniform(0.0, nx), random.uniform(0.0, ny)};
  const double goal_radius = random.uniform(0.8, 3.0);
  const double blocked = random.below(3) == 0 ? 0.0 : 0.12 * random.unit();
  const double silent = random.below(3) == 0 ? 0.1 : 0.0;
  const bool ring = random.below(3) == 0;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const Vec2 p{c.ix + 0.5, c.iy + 0.5};
    plan.heading_rad[i] = Heading::stored(sample_heading(style, random, p, goal, twist));
    if (random.unit() < silent) plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    if (norm(p - goal) < goal_radius) plan.region[i] = Region::goal;
    if (random.below(4) == 0 && plan.region[i] == Region::free) plan.region[i] = Region::buffer;
    const bool edge = c.ix == 0 || c.iy == 0 || c.ix == nx - 1 || c.iy == ny - 1;
    if (random.unit() < blocked || (ring && edge)) plan.region[i] = Region::obstacle;
  }
  return plan;
}

/// Random plan number `seed` at the limits of what a plan may be: one to ten cells per side, sizes
/// up to the ends of their range, commands on axes, as close to axes as a plan may have them, and
/// exactly opposite to their neighbours'.
inline Plan odd_plan(std::uint64_t seed) {
  Random random = Random::stream(0x0dd, seed);
  const auto one_of = [&random](const auto& values) { return values[random.below(values.size())]; };
  static constexpr std::array<double, 10> cells{1.0,  1.0, 1.0,   8.0,  0.1,
                                                1e-6, 1e6, 1e-15, 1e15, 3.0};
  static constexpr std::array<double, 10> radii{1.0 + 0x1p-52, 1.000001, 1.01, 1.1, 1.5,
                                                2.0,           2.5,      10.0, 1e4, 1e9};
  static constexpr std::array<double, 6> speeds{10.0, 10.0, 1.0, 0.3, 1e-15, 1e15};
  static constexpr std::array<double, 6> axes{0.0,       1.5707963,  -1.5707963,
                                              3.1415925, -3.1415925, 0.78539816};
  const int nx = 1 + static_cast<int>(random.below(10));
  const int ny = 1 + static_cast<int>(random.below(10));
  const double cell_m = one_of(cells);
  Plan plan = empty_plan(nx, ny, cell_m, one_of(radii) * cell_m);
  plan.vehicle.speed_mps = one_of(speeds);
  if (random.below(3) == 0) {
    const double far_m = std::min(1e15, 1e9 * cell_m);
    const double near_m = std::min(far_m, 1e3 * cell_m);
    plan.grid.x0_m = random.below(2) == 0 ? far_m : random.uniform(-near_m, near_m);
    plan.grid.y0_m = random.below(2) == 0 ? -far_m : random.uniform(-near_m, near_m);
  }
  const std::uint64_t style = random.below(6);
  const double one = random.uniform(-pi, pi);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const double sign = random.below(2) == 0 ? 1.0 : -1.0;
    const double tiny = sign * std::pow(10.0, random.uniform(-15.65, -6.0));
    const Cell c = plan.grid.cell_at(i);
    const double weave = (2 * c.iy > ny ? -1.0 : 1.0) * std::pow(10.0, random.uniform(-8.0, -1.0));
    const std::array<double, 6> commands{
        tiny,
        one_of(axes),
        (c.ix + c.iy) % 2 == 0 ? one : Heading::from_rad(one + pi).rad(),
        weave,
        random.uniform(-pi, pi),
        random.below(2) == 0 ? tiny : one_of(axes)};
    plan.heading_rad[i] = Heading::stored(commands[random.below(4) == 0 ? random.below(6) : style]);
    if (random.below(12) == 0) plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    if (std::isnan(plan.heading_rad[i])) plan.cost_m[i] = std::numeric_limits<float>::infinity();
    const std::uint64_t draw = random.below(16);
    plan.region[i] = draw == 0   ? Region::goal
                     : draw == 1 ? Region::obstacle
                     : draw < 5  ? Region::buffer
                                 : Region::free;
  }
  return plan;
}

}  // namespace fairway
