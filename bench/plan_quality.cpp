// Measures how good plans are: over random goals on each map given, the share of random safe starts
// of finite cost that reach the goal, and what happens to the others. The defaults of FieldOptions
// were chosen with it; docs/defaults.md has its table.
//
//   plan_quality GOALS STATES RESOLUTION_M TURN_RADIUS_M MAP.map...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/random.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/start_states.hpp"

namespace {

using namespace fairway;

struct Tally {
  int goals = 0;
  double flights = 0.0;
  double reach = 0.0;
  double collide = 0.0;
  double trapped = 0.0;
  double worst = 1.0;
  double crossings = 0.0;
  double cells_flown = 0.0;
};

Plan plan_of(Field field, const Vehicle& vehicle) {
  Plan plan;
  plan.grid = field.grid;
  plan.vehicle = vehicle;
  plan.heading_rad = std::move(field.heading_rad);
  plan.region = std::move(field.region);
  plan.cost_m = std::move(field.cost_m);
  return plan;
}

void add_flights(const Plan& plan, int states, std::uint64_t seed, Tally& tally) {
  const ExactFlights flights(plan);
  const std::vector<State> starts =
      random_states(plan, StartRegion::safe_start, static_cast<std::size_t>(states), seed);
  double reached = 0.0;
  for (const FlightRun& run : flights.run_all(starts)) {
    reached += run.result.outcome == Outcome::reach ? 1.0 : 0.0;
    tally.collide += run.result.outcome == Outcome::collide ? 1.0 : 0.0;
    tally.trapped += run.result.outcome == Outcome::trapped ? 1.0 : 0.0;
    tally.crossings += static_cast<double>(run.crossings);
    tally.cells_flown += run.flown_m / plan.grid.cell_m;
  }
  const auto n = static_cast<double>(starts.size());
  tally.goals += 1;
  tally.flights += n;
  tally.reach += reached;
  tally.worst = std::min(tally.worst, reached / n);
}

// Random goals; those that violate Assumption 1, or that less than a tenth of the map can reach, do
// not count.
Tally measure(const ObstacleMap& map, const Vehicle& vehicle, const FieldOptions& options,
              int goals, int states) {
  Random random(7);
  Tally tally;
  for (int tries = 0; tally.goals < goals && tries < 3000; ++tries) {
    const Cell cell = map.grid.cell_at(random.below(map.grid.size()));
    FieldOrRefusal answer =
        compute_field(map, vehicle, GoalMission{map.grid.center(cell), {}}, options);
    auto* field = std::get_if<Field>(&answer);
    if (field == nullptr) continue;
    const auto free = static_cast<std::size_t>(
        std::count(field->region.begin(), field->region.end(), Region::free));
    if (free - field->unreachable_free_cells < free / 10) continue;
    add_flights(plan_of(std::move(*field), vehicle), states, random.bits(), tally);
  }
  return tally;
}

const char* name_of(Blend blend) { return blend == Blend::paper ? "paper" : "continuous"; }

std::vector<FieldOptions> candidates() {
  std::vector<FieldOptions> out;
  for (const Blend blend : {Blend::continuous, Blend::paper}) {
    for (const double sigma_border : {0.0, 0.5, 1.0, 1.5}) {
      for (const double sigma : {0.0, 1.0, 2.0, 4.0}) {
        FieldOptions options;
        options.blend = blend;
        options.sigma_border = sigma_border;
        options.sigma_cells = sigma;
        out.push_back(options);
      }
    }
  }
  for (const double capture : {0.0, 0.005}) {
    FieldOptions options;
    options.axis_capture_rad = capture;
    out.push_back(options);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fputs("usage: plan_quality GOALS STATES RESOLUTION_M TURN_RADIUS_M MAP.map...\n", stderr);
    return 64;
  }
  const Vehicle vehicle{10.0, std::atof(argv[4])};
  fmt::print(
      "| map | blend | sigma_border | sigma_cells | axis_capture_rad | goals | reach | worst "
      "goal | collide | trapped | crossings per cell |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 5; i < argc; ++i) {
    MapRequest request;
    request.file = argv[i];
    request.cell_m = std::atof(argv[3]);
    request.resolution_m = request.cell_m;
    const ObstacleMap map = read_map(request);
    for (const FieldOptions& options : candidates()) {
      const Tally t = measure(map, vehicle, options, std::atoi(argv[1]), std::atoi(argv[2]));
      fmt::print("| {} | {} | {} | {} | {} | {} | {:.5f} | {:.5f} | {:.5f} | {:.5f} | {:.2f} |\n",
                 request.file.stem().string(), name_of(options.blend), options.sigma_border,
                 options.sigma_cells, options.axis_capture_rad, t.goals, t.reach / t.flights,
                 t.worst, t.collide / t.flights, t.trapped / t.flights,
                 t.crossings / t.cells_flown);
      std::fflush(stdout);
    }
  }
  return 0;
}
