#include "fairway/run/summary.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/share_text.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Down, never up: 99.996 % is not 100 %.
std::string percent(double value) {
  const double hundredths = std::floor(value * 1e4 + 1e-9) / 100.0;
  return fmt::format("{:.2f} %", hundredths);
}

}  // namespace

RegionCells count_regions(const Plan& plan) {
  RegionCells counts;
  for (std::size_t i = 0; i < plan.region.size(); ++i) {
    switch (plan.region[i]) {
      case Region::free:
        ++counts.free;
        counts.unreachable += std::isinf(plan.cost_m[i]) ? 1 : 0;
        break;
      case Region::buffer:
        ++counts.buffer;
        break;
      case Region::obstacle:
        ++counts.obstacle;
        break;
      case Region::goal:
        ++counts.goal;
        break;
    }
  }
  return counts;
}

const char* goal_word(const Plan& plan) {
  const auto& mission = plan.record.mission;
  return mission && std::holds_alternative<PathMission>(*mission) ? "path" : "goal";
}

json outcome_json(const OutcomeCounts& counts) {
  const std::size_t all = counts.total();
  json report = {{"count", all}};
  for (const Outcome outcome : outcomes_in_order) {
    report["outcomes"][name_of(outcome)] = counts.of(outcome);
    report["share"][name_of(outcome)] = all == 0 ? json() : json(counts.share(outcome));
  }
  const auto [low, high] = wilson_interval(counts.of(Outcome::reach), all);
  report["reach_share_interval_95"] = {low, high};
  return report;
}

std::string outcome_words(const OutcomeCounts& counts) {
  const std::size_t reach = counts.of(Outcome::reach);
  const auto [low, high] = wilson_interval(reach, counts.total());
  return fmt::format("{} reach ({}; 95 % interval {} to {}), {} collide, {} leave, {} are trapped",
                     reach, percent(counts.share(Outcome::reach)), percent(low), percent(high),
                     counts.of(Outcome::collide), counts.of(Outcome::leave),
                     counts.of(Outcome::trapped));
}

json plan_summary(const Scenario& scenario, const ObstacleMap& map, const Plan& plan) {
  const RegionCells regions = count_regions(plan);
  json options = json::object();
  for (const char* table : {"map", "vehicle", "mission", "plan", "simulate"}) {
    options[table] = effective_values(scenario, table);
  }
  options["map"].erase("file");  // it stands among the inputs, with its digest
  options["mission"].erase("path_file");
  json summary = {
      {"program", program_version},
      {"cells", {plan.grid.nx, plan.grid.ny}},
      {"cell_m", plan.grid.cell_m},
      {"origin_m", {plan.grid.x0_m, plan.grid.y0_m}},
      {"region_cells",
       {{"free", regions.free},
        {"buffer", regions.buffer},
        {"obstacle", regions.obstacle},
        {"goal", regions.goal}}},
      {"unreachable_free_cells", regions.unreachable},
      {"unreachable_share_of_free", share(regions.unreachable, regions.free)},
      {"inputs", json::parse(json_text(plan.record)).value("inputs", json::array())},
      {"options", options},
      {"warnings", plan_warnings(map, plan)},
  };
  return summary;
}

std::string plan_words(const Plan& plan) {
  const RegionCells regions = count_regions(plan);
  const std::size_t n = plan.grid.size();
  std::string words = fmt::format(
      "A plan of {} x {} cells of {:g} m: {} safe start, {} buffer, {} obstacle, {} goal cells.",
      plan.grid.nx, plan.grid.ny, plan.grid.cell_m, percent(share(regions.free, n)),
      percent(share(regions.buffer, n)), percent(share(regions.obstacle, n)), regions.goal);
  if (regions.unreachable > 0) {
    words +=
        fmt::format(" {} safe-start cells ({} of them) cannot reach the goal and have no command.",
                    regions.unreachable, percent(share(regions.unreachable, regions.free)));
  }
  return words;
}

void add_cost(json& summary, const StageClock& clock) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  summary["wall_s"] = clock.total_s();
  summary["stage_wall_s"] = clock.json();
  summary["peak_rss_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
  summary["threads"] =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

std::string cost_words(const json& summary) {
  const auto threads = summary["threads"].get<std::size_t>();
  return fmt::format("It took {:.2f} s on {} thread{} and {:.0f} MB at the peak.",
                     summary["wall_s"].get<double>(), threads, threads == 1 ? "" : "s",
                     summary["peak_rss_bytes"].get<double>() / 1e6);
}

}  // namespace fairway
