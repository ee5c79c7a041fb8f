// Exact flights: cell crossings per second on one core.
//
// Fields without a map file: "goal" is what plans look like (headings that change little from cell
// to cell, towards a goal in the middle), "meander" makes the vehicle turn all the time, "rough"
// has an independent heading in every cell. Starts are random; every flight runs to its end or for
// 4000 cells.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

enum class Kind { goal, meander, rough };

Plan synthetic_plan(int n, Kind kind) {
  Plan plan;
  plan.grid = {n, n, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.resize(plan.grid.size());
  Random random(3);
  const Vec2 goal{n * 1.0, n * 1.0};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 p = plan.grid.center(plan.grid.cell_at(i));
    const Vec2 to_goal = goal - p;
    const double distance = norm(to_goal);
    double heading = std::atan2(to_goal.y, to_goal.x);
    if (kind == Kind::goal) heading += 0.7 * std::sin(p.x / 37.0) * std::cos(p.y / 53.0);
    if (kind == Kind::meander) heading += 1.4 * std::sin(p.x / 6.0) * std::cos(p.y / 7.0);
    if (kind == Kind::rough) heading = random.uniform(-pi, pi);
    plan.heading_rad[i] = Heading::stored(heading);
    if (distance < 10.0 && kind != Kind::rough) plan.region[i] = Region::goal;
  }
  return plan;
}

void fly(benchmark::State& bench, Kind kind) {
  const Plan plan = synthetic_plan(static_cast<int>(bench.range(0)), kind);
  const ExactFlights flights(plan);
  Random random(5);
  std::vector<State> starts;
  for (int i = 0; i < 4096; ++i) {
    starts.push_back(
        {{random.uniform(0.0, plan.grid.width_m()), random.uniform(0.0, plan.grid.height_m())},
         Heading::from_rad(random.uniform(-pi, pi))});
  }
  std::size_t next = 0;
  std::uint64_t crossings = 0;
  for (auto _ : bench) {
    const FlightRun run = flights.run(starts[next++ % starts.size()], {0.0, 4000});
    crossings += run.crossings;
    benchmark::DoNotOptimize(run.result);
  }
  bench.counters["crossings/s"] =
      benchmark::Counter(static_cast<double>(crossings), benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(fly, goal, Kind::goal)->Arg(512)->Arg(4096);
BENCHMARK_CAPTURE(fly, meander, Kind::meander)->Arg(512);
BENCHMARK_CAPTURE(fly, rough, Kind::rough)->Arg(512);

}  // namespace
}  // namespace fairway

BENCHMARK_MAIN();
