// Exact flights: cells crossed per second of one core's time, one flight after another in one
// thread.
#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/sections.hpp"
#include "bench/synthetic_plan.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway::bench {
namespace {

Plan plan_on_blobs(int side) {
  const ObstacleMap map = blob_map(side, map_seed);
  const Vehicle vehicle{10.0, 5.0};
  FieldOrRefusal answer =
      compute_field(map, vehicle, GoalMission{map.grid.center(open_place(map, 12)), {}}, {});
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw std::runtime_error("the blob map refuses its mission: " + refused->message);
  }
  return plan_of_field(std::move(std::get<Field>(answer)), vehicle);
}

// Any safe start that can reach the goal, with any heading.
std::vector<State> random_starts(const Plan& plan, int count) {
  std::vector<State> starts;
  Random random(5);
  while (starts.size() < static_cast<std::size_t>(count)) {
    const Vec2 p{random.uniform(0.0, plan.grid.width_m()),
                 random.uniform(0.0, plan.grid.height_m())};
    const Heading heading = Heading::from_rad(random.uniform(-pi, pi));
    const std::size_t cell = plan.grid.index(plan.grid.cell_of(p));
    if (plan.region[cell] != Region::free || !std::isfinite(plan.cost_m[cell])) continue;
    starts.push_back({p, heading});
  }
  return starts;
}

Row row_of(const std::string& name, const Plan& plan, const Settings& settings) {
  const ExactFlights flights(plan);
  const std::vector<State> starts = random_starts(plan, settings.flights);
  const FlightLimits limits{0.0, 20'000};
  std::uint64_t crossings = 0;
  std::size_t reached = 0;
  std::vector<Took> runs;
  for (int repeat = 0; repeat <= settings.repeats; ++repeat) {  // the first warms up
    crossings = 0;
    reached = 0;
    runs.push_back(timed([&] {
      for (const State& start : starts) {
        const FlightRun run = flights.run(start, limits);
        crossings += run.crossings;
        reached += run.ended_by == EndedBy::goal ? 1 : 0;
      }
    }));
  }
  runs.erase(runs.begin());
  // One thread: its CPU time, which other processes do not lengthen much.
  const double per_second = 1e-6 * static_cast<double>(crossings) / median(runs).cpu_s;
  const double share = 100.0 * static_cast<double>(reached) / static_cast<double>(starts.size());
  return at_least_row(name,
                      fmt::format("{:.1f} million cells/s ({:.1f} % reach)", per_second, share),
                      per_second, 15.0);
}

}  // namespace

std::vector<Row> flight_rows(const Settings& settings) {
  const int side = settings.side;
  const int small = side / 8;
  return {row_of(fmt::format("exact flights, a plan on {} x {} blobs", side, side),
                 plan_on_blobs(side), settings),
          row_of(fmt::format("  a made-up plan, {} x {}", small, small),
                 synthetic_plan(small, FieldKind::goal), settings),
          row_of("  turning all the time", synthetic_plan(small, FieldKind::meander), settings),
          row_of("  an independent heading in every cell", synthetic_plan(small, FieldKind::rough),
                 settings)};
}

}  // namespace fairway::bench
