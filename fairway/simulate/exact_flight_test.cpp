#include "fairway/simulate/exact_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr float no_command = std::numeric_limits<float>::quiet_NaN();

Plan plan_of(int nx, int ny, double cell_m, double turn_radius_m,
             const std::function<float(Vec2)>& heading) {
  Plan plan;
  plan.grid = {nx, ny, 0.0, 0.0, cell_m};
  plan.vehicle = {10.0, turn_radius_m};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.heading_rad.push_back(heading(plan.grid.center(plan.grid.cell_at(i))));
  }
  return plan;
}

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

TEST(ExactFlight, crosses_a_uniform_field_to_the_edge_in_closed_form) {
  const ExactFlights flights(plan_of(30, 20, 2.0, 5.0, [](Vec2) { return 0.0F; }));
  const FlightRun run = flights.run(state(10.0, 10.0, pi / 2));
  EXPECT_EQ(run.result.outcome, Outcome::leave);
  EXPECT_EQ(run.ended_by, EndedBy::grid_edge);
  // A quarter circle to the right, then 60 - 15 m straight.
  EXPECT_NEAR(run.result.length_m, 5.0 * pi / 2 + 45.0, 1e-12);
  EXPECT_NEAR(run.result.time_s, run.result.length_m / 10.0, 1e-14);
}

TEST(ExactFlight, never_reaches_in_a_circular_vortex) {
  // Leaning inwards by 0.3 rad, else the cells' constant headings carry the vehicle slowly out.
  const Plan plan = plan_of(64, 64, 2.0, 5.0, [](Vec2 p) {
    return Heading::stored(std::atan2(p.y - 64.0, p.x - 64.0) + pi / 2 + 0.3);
  });
  const ExactFlights flights(plan);
  const FlightRun run = flights.run(state(80.0, 64.0, pi / 2));
  EXPECT_EQ(run.result.outcome, Outcome::trapped);
  EXPECT_EQ(run.ended_by, EndedBy::repeating_state);
  EXPECT_EQ(run.result.length_m, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace fairway
