// The whole field stage with default options: time and memory per cell, from small maps to large.
// Every run is its own process, as for a user: no memory is warm, and the peak is its own.
#include <fmt/core.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/child_process.hpp"
#include "bench/sections.hpp"
#include "fairway/field/compute_field.hpp"

namespace fairway::bench {
namespace {

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

struct Run {
  Took took;
  double bytes_before = 0.0;
  double bytes_peak = 0.0;
  double reached_share = 0.0;
};

Run run_in_own_process(const Settings& settings, int side) {
  ChildProcess child({settings.program, "--one-field", std::to_string(side), "--threads",
                      std::to_string(settings.threads)});
  Run run;
  std::istringstream answer(child.read_line().value_or(""));
  if (!(answer >> run.took.wall_s >> run.took.cpu_s >> run.bytes_before >> run.bytes_peak >>
        run.reached_share)) {
    throw std::runtime_error(
        fmt::format("the pipeline on {} x {} cells gave no answer", side, side));
  }
  return run;
}

// The exponent p of the best fit time ~ cells^p (least squares of logarithms).
double growth_exponent(const std::vector<double>& cells, const std::vector<double>& seconds) {
  double mean_x = 0.0;
  double mean_y = 0.0;
  const auto n = static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    mean_x += std::log(cells[i]) / n;
    mean_y += std::log(seconds[i]) / n;
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double dx = std::log(cells[i]) - mean_x;
    covariance += dx * (std::log(seconds[i]) - mean_y);
    variance += dx * dx;
  }
  return covariance / variance;
}

}  // namespace

void run_one_field(int side) {
  const ObstacleMap map = blob_map(side, map_seed);
  const Vehicle vehicle{10.0, 5.0};  // r = 2.5 cells, as in paper 1's figures
  const Mission mission = GoalMission{map.grid.center(open_place(map, 12)), {}};
  malloc_trim(0);
  const double before = resident_bytes();
  FieldOrRefusal answer;
  const Took took = timed([&] { answer = compute_field(map, vehicle, mission, {}); });
  const double peak = peak_resident_bytes();
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw std::runtime_error("the blob map refuses its mission: " + refused->message);
  }
  const Field& field = std::get<Field>(answer);
  std::size_t safe_start = 0;
  for (const Region region : field.region) safe_start += region == Region::free ? 1 : 0;
  const double share =
      1.0 - static_cast<double>(field.unreachable_free_cells) / static_cast<double>(safe_start);
  fmt::print("{} {} {} {} {}\n", took.wall_s, took.cpu_s, before, peak, share);
}

std::vector<Row> pipeline_rows(const Settings& settings) {
  std::vector<std::vector<Run>> runs(settings.sides.size());
  for (int repeat = 0; repeat < settings.repeats; ++repeat) {
    for (std::size_t s = 0; s < runs.size(); ++s) {
      runs[s].push_back(run_in_own_process(settings, settings.sides[s]));
    }
  }
  std::vector<Row> rows;
  std::vector<double> all_cells;
  std::vector<double> all_seconds;
  for (std::size_t s = 0; s < runs.size(); ++s) {
    const int side = settings.sides[s];
    const double cells = static_cast<double>(side) * side;
    std::vector<Took> took;
    std::vector<double> growth;
    std::vector<double> peak;
    for (const Run& run : runs[s]) {
      took.push_back(run.took);
      growth.push_back((run.bytes_peak - run.bytes_before) / cells);
      peak.push_back(run.bytes_peak / cells);
    }
    const Took mid = median(took);
    all_cells.push_back(cells);
    all_seconds.push_back(mid.wall_s);
    const double ns = 1e9 * mid.wall_s / cells;
    const std::string what = fmt::format("whole pipeline, {} x {}", side, side);
    const std::string time =
        fmt::format("{:.1f} ns a cell ({:.2f} cores)", ns, mid.cpu_s / mid.wall_s);
    if (side != settings.side) {
      rows.push_back({what, time});
      continue;
    }
    rows.push_back(at_most_row(what, time, ns, 120.0));
    rows.push_back(at_most_row("  peak memory, without the map",
                               fmt::format("{:.1f} bytes a cell", median(growth)), median(growth),
                               48.0));
    rows.push_back(at_most_row("  peak memory, whole process",
                               fmt::format("{:.1f} bytes a cell", median(peak)), median(peak),
                               48.0));
    rows.push_back({"  safe-start cells that reach the goal",
                    fmt::format("{:.2f} %", 100.0 * runs[s][0].reached_share)});
  }
  const double exponent = growth_exponent(all_cells, all_seconds);
  rows.push_back(at_most_row("  exponent p in time ~ cells^p", fmt::format("{:.3f}", exponent),
                             exponent, 1.05));
  return rows;
}

}  // namespace fairway::bench
