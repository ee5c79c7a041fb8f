#include "fairway/run/summary.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include "fairway/base/share_text.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// "66 collide", "1 gets trapped".
std::string counted(Outcome outcome, std::size_t n) {
  static constexpr std::array<const char*, outcome_codes> one{
      "", "reaches", "collides", "leaves the map", "gets trapped", "", "holds"};
  static constexpr std::array<const char*, outcome_codes> many{
      "", "reach", "collide", "leave the map", "get trapped", "", "hold"};
  return grouped(n) + " " + (n == 1 ? one : many)[static_cast<std::size_t>(outcome)];
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
    if (!is_listed(outcome, counts.of(outcome))) continue;
    report["outcomes"][name_of(outcome)] = counts.of(outcome);
    report["share"][name_of(outcome)] = all == 0 ? json() : json(counts.share(outcome));
  }
  const auto [low, high] = wilson_interval(counts.of(Outcome::reach), all);
  report["reach_share_interval_95"] = {low, high};
  return report;
}

std::string outcome_words(const OutcomeCounts& counts) {
  const std::size_t reach = counts.of(Outcome::reach);
  const SampledShare share = sampled_share(reach, counts.total());
  std::string words = fmt::format("{} ({}; 95 % interval {})", counted(Outcome::reach, reach),
                                  share.share, share.interval);
  for (const Outcome outcome : outcomes_in_order) {
    const bool listed = is_listed(outcome, counts.of(outcome));
    if (outcome != Outcome::reach && listed) words += ", " + counted(outcome, counts.of(outcome));
  }
  return words;
}

std::string failure_words(const OutcomeCounts& counts) {
  std::string words;
  for (const Outcome outcome : outcomes_in_order) {
    const bool fails = outcome != Outcome::reach && outcome != Outcome::hold;
    if (!fails || counts.of(outcome) == 0) continue;
    words += (words.empty() ? "" : ", ") + counted(outcome, counts.of(outcome));
  }
  return words;
}

json plan_summary(const Scenario& scenario, const Plan& plan) {
  const RegionCells regions = count_regions(plan);
  json options = json::object();
  for (const char* table : {"map", "vehicle", "mission", "plan", "simulate"}) {
    options[table] = effective_values(scenario, table);
  }
  options["map"].erase("file");  // listed under "inputs", with its digest
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
  };
  if (!plan.record.modes.empty()) {
    summary["modes"] = json::parse(json_text(plan.record))["modes"];
  }
  if (plan.record.improved) {
    summary["improved"] = json::parse(json_text(plan.record))["improved"];
  }
  return summary;
}

std::string grid_words(const Plan& plan) {
  const RegionCells regions = count_regions(plan);
  const std::size_t n = plan.grid.size();
  std::string words =
      fmt::format("A plan of {} x {} cells of {:g} m: {} free, {} buffer, {} obstacle, {}.",
                  plan.grid.nx, plan.grid.ny, plan.grid.cell_m, percent_text(regions.free, n),
                  percent_text(regions.buffer, n), percent_text(regions.obstacle, n),
                  plural(regions.goal, "goal cell"));
  if (plan.record.contract) {
    words += fmt::format(" Its vehicle {}.", contract_words(*plan.record.contract));
  }
  if (const std::size_t modes = plan.record.modes.size(); modes > 0) {
    words += fmt::format(" It has {} for states that its own field does not bring.",
                         plural(modes, "further mode"));
  }
  if (const auto& improved = plan.record.improved) {
    words += fmt::format(
        " The commands of {} were improved: from {} of all states the exact vehicle was then "
        "proved to do what the mission asks, from {} before.",
        plural(improved->cells_changed, "cell"), percent_text(improved->exact[1]),
        percent_text(improved->exact[0]));
  }
  return words;
}

std::string plan_words(const Plan& plan) {
  std::string words = grid_words(plan);
  for (const Finding& finding : plan_findings(plan)) {
    words += fmt::format(" {} of {} {}.", finding.share, finding.of, finding.what);
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
  return fmt::format("Took {:.2f} s on {} thread{}; peak memory {:.0f} MB.",
                     summary["wall_s"].get<double>(), threads, threads == 1 ? "" : "s",
                     summary["peak_rss_bytes"].get<double>() / 1e6);
}

}  // namespace fairway
