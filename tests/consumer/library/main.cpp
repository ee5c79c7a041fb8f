// Plans on a small map and flies the plan, with the installed library alone.
#include <cstdio>
#include <utility>
#include <variant>

#include <fairway/field/compute_field.hpp>
#include <fairway/plan/plan_file.hpp>
#include <fairway/plan/plan_of_field.hpp>
#include <fairway/simulate/exact_flight.hpp>

int main(int, char** argv) {
  fairway::ObstacleMap map;
  map.grid = {60, 40, 0.0, 0.0, 1.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (int iy = 0; iy < 20; ++iy) map.obstacle[map.grid.index({30, iy})] = 1;

  const fairway::Vehicle vehicle{5.0, 2.0};
  auto result = fairway::compute_field(map, vehicle, fairway::GoalMission{{50.0, 10.0}, {}}, {});
  auto* field = std::get_if<fairway::Field>(&result);
  if (field == nullptr) return 1;

  const fairway::Plan plan = fairway::plan_of_field(std::move(*field), vehicle);
  fairway::write_plan(plan, argv[1], fairway::Existing::replace);
  const fairway::Plan back = fairway::read_plan(argv[1]);
  const auto flight =
      fairway::ExactFlights(back).fly({{8.0, 8.0}, fairway::Heading::from_rad(3.0)});
  std::printf("%s after %.3f m\n", fairway::name_of(flight.outcome), flight.length_m);
  return flight.outcome == fairway::Outcome::reach ? 0 : 1;
}
