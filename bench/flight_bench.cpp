// Exact flights: cell crossings per second on one core, over synthetic plans
// (bench/synthetic_plan.hpp). Starts are random; every flight runs to its end or for 4000 cells.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/synthetic_plan.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway::bench {
namespace {

void fly(benchmark::State& bench, FieldKind kind) {
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

BENCHMARK_CAPTURE(fly, goal, FieldKind::goal)->Arg(512)->Arg(4096);
BENCHMARK_CAPTURE(fly, meander, FieldKind::meander)->Arg(512);
BENCHMARK_CAPTURE(fly, rough, FieldKind::rough)->Arg(512);

}  // namespace
}  // namespace fairway::bench

BENCHMARK_MAIN();
