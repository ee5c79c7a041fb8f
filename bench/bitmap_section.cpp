// Backward reachable sets on border samples (paper 2), at the paper's size and ten times that along
// each side; and what it would cost to fly every state of the paper's 3-D grid instead. Each set is
// computed in its own process, so that the peak memory is its own.
#include <fmt/core.h>
#include <sys/resource.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bench/child_process.hpp"
#include "bench/sections.hpp"
#include "fairway/base/random.hpp"
#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/bitmap/bitmap_volume.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway::bench {
namespace {

constexpr std::size_t volume_draws = 1'000'000;

/// The real field towards a goal in the centre of free cells: d 8 m, r 20 m, goal radius 2 r.
Plan open_plan(int side) {
  ObstacleMap map;
  map.grid = {side, side, 0.0, 0.0, 8.0};
  map.obstacle.assign(map.grid.size(), 0);
  const Vehicle vehicle{10.0, 20.0};
  const Vec2 goal = map.grid.corner({side / 2, side / 2});
  FieldOrRefusal answer = compute_field(map, vehicle, GoalMission{goal, {}}, {});
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw std::runtime_error("the open map refuses its mission: " + refused->message);
  }
  return plan_of_field(std::move(std::get<Field>(answer)), vehicle);
}

struct Run {
  Took took;
  double states = 0.0;
  double stored_bytes = 0.0;
  double peak_bytes = 0.0;  // of the process
  double volume_share = 0.0;
};

Run run_in_own_process(const Settings& settings, int side, int samples) {
  ChildProcess child({settings.program, "--one-bitmap", std::to_string(side), "--samples",
                      std::to_string(samples), "--threads", std::to_string(settings.threads)});
  Run run;
  std::istringstream answer(child.read_line().value_or(""));
  if (!(answer >> run.took.wall_s >> run.took.cpu_s >> run.states >> run.stored_bytes >>
        run.peak_bytes >> run.volume_share)) {
    throw std::runtime_error(fmt::format("the bitmap of {} x {} cells gave no answer", side, side));
  }
  return run;
}

Run median_run(const std::vector<Run>& runs) {
  Run middle = runs.front();
  std::vector<Took> took;
  std::vector<double> peaks;
  for (const Run& run : runs) {
    if (run.volume_share != middle.volume_share) {
      throw std::runtime_error("two runs of the same bitmap differ");
    }
    took.push_back(run.took);
    peaks.push_back(run.peak_bytes);
  }
  middle.took = median(took);
  middle.peak_bytes = median(peaks);
  return middle;
}

/// The wall time of flying a state, over states drawn from the 3-D grid of the paper's comparison,
/// with all threads at work.
struct Forward {
  double seconds_per_state = 0.0;
  double share = 0.0;
};
Forward fly_sample(const Settings& settings, int side) {
  const Plan plan = open_plan(side);
  const ExactFlights flights(plan);
  std::vector<State> starts;
  Random random(7);
  while (starts.size() < static_cast<std::size_t>(settings.flights) * 64) {
    const Vec2 p{plan.grid.width_m() * random.unit(), plan.grid.height_m() * random.unit()};
    const Heading heading = Heading::from_rad(random.uniform(-pi, pi));
    if (plan.region[plan.grid.index(plan.grid.cell_of(p))] == Region::goal) continue;
    starts.push_back({p, heading});
  }
  std::vector<double> seconds;
  double reached = 0.0;
  for (int repeat = 0; repeat <= settings.repeats; ++repeat) {  // the first warms up
    std::vector<FlightResult> results;
    seconds.push_back(timed([&] { results = flights.fly_all(starts); }).wall_s);
    reached = 0.0;
    for (const FlightResult& r : results) reached += r.outcome == Outcome::reach ? 1.0 : 0.0;
  }
  seconds.erase(seconds.begin());
  const auto n = static_cast<double>(starts.size());
  return {median(seconds) / n, reached / n};
}

void add_rows(std::vector<Row>& rows, const Settings& settings, int side, double limit_s,
              double limit_bytes, bool limit_is_peak) {
  const int m = settings.bitmap_samples;
  std::vector<Run> runs;
  const int repeats = side > 100 ? std::min(settings.repeats, 3) : settings.repeats;
  for (int i = 0; i < repeats; ++i) runs.push_back(run_in_own_process(settings, side, m));
  const Run run = median_run(runs);
  const Forward forward = fly_sample(settings, side);
  if (std::abs(forward.share - run.volume_share) > 0.02) {
    throw std::runtime_error(
        fmt::format("flights reach from {:.4f} of the volume, the bitmap says {:.4f}",
                    forward.share, run.volume_share));
  }
  const std::string what = fmt::format("bitmap, {} x {} cells, m = {}", side, side, m);
  rows.push_back(at_most_row(
      what,
      fmt::format("{} = {:.1f} ns CPU a state", shown(run.took), 1e9 * run.took.cpu_s / run.states),
      run.took.wall_s, limit_s));
  const auto megabytes = [](double bytes) { return fmt::format("{:.1f} MB", 1e-6 * bytes); };
  if (limit_is_peak) {
    rows.push_back({"  stored", megabytes(run.stored_bytes)});
    rows.push_back(at_most_row("  peak memory, whole process (MB)", megabytes(run.peak_bytes),
                               1e-6 * run.peak_bytes, 1e-6 * limit_bytes));
  } else {
    rows.push_back(at_most_row("  stored (MB)", megabytes(run.stored_bytes),
                               1e-6 * run.stored_bytes, 1e-6 * limit_bytes));
    rows.push_back({"  peak memory, whole process", megabytes(run.peak_bytes)});
  }
  rows.push_back({"  volume that reaches", fmt::format("{:.2f} %", 100.0 * run.volume_share),
                  fmt::format("{:.2f} % of flights", 100.0 * forward.share)});
  // m^3 n^2 states, the 3-D grid of the paper's comparison.
  const double states = std::pow(m, 3) * side * side;
  const double all_s = forward.seconds_per_state * states;
  Row row = at_least_row("  flying all m^3 n^2 states, times as long", shown(run.took),
                         all_s / run.took.wall_s, 100.0);
  row.peer = fmt::format("{:.3g} s extrapolated from {} flights", all_s, settings.flights * 64);
  row.ratio = fmt::format("{:.0f}", all_s / run.took.wall_s);
  rows.push_back(std::move(row));
}

}  // namespace

void run_one_bitmap(int side, int samples) {
  const Plan plan = open_plan(side);
  const std::vector<std::uint8_t> target = target_cells(plan.grid, plan.region, {});
  BorderBitmap set;
  const Took took = timed([&] { set = backward_reachable_set(plan, target, {samples}); });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const VolumeShare share = volume_share_reached(plan, target, set, volume_draws);
  fmt::print("{} {} {} {} {} {}\n", took.wall_s, took.cpu_s,
             static_cast<double>(set.borders().count() * set.states_per_border()), set.bytes(),
             1024.0 * static_cast<double>(usage.ru_maxrss), share.reached);
}

std::vector<Row> bitmap_rows(const Settings& settings) {
  std::vector<Row> rows;
  add_rows(rows, settings, settings.bitmap_side, 0.5, 3.8e6, false);
  add_rows(rows, settings, 10 * settings.bitmap_side, 60.0, 1e9, true);
  return rows;
}

}  // namespace fairway::bench
