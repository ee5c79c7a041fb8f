#include "fairway/compare/compare_plans.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/compare/comparison_table.hpp"
#include "fairway/compare/difference_map.hpp"
#include "fairway/compare/measure_plan.hpp"
#include "fairway/compare/require_alike.hpp"
#include "fairway/compare/state_verdicts.hpp"

namespace fairway {
namespace {

StatesUnderPlan measured(const ComparedPlan& plan, const CommonGround& ground,
                         const CompareOptions& options, StageClock& clock) {
  clock.begin("flying under " + plan.name, unknown_time);
  return states_under(plan, ground, options.bound(plan.plan));
}

/// Where others are proved to follow the path, who is only proved to touch it does not do the same.
void forget_touches(std::span<const ComparedPlan> plans, Comparison& c) {
  const auto follows = [](const ComparedPlan& p) { return p.contract->follow.has_value(); };
  if (std::none_of(plans.begin(), plans.end(), follows)) return;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (follows(plans[k])) continue;
    for (Verdict& verdict : c.verdicts[1][k]) {
      if (verdict == Verdict::reach) verdict = Verdict::undecided;
    }
    c.warnings.push_back(
        plans[k].name + ": under the contract nobody is proved to follow, only to touch the path.");
  }
}

/// Of states with two verdicts, how many are proved by one plan alone, by both, by none.
PairDifference difference_of(const Comparison& c, std::size_t second, Knowledge of) {
  const auto& verdicts = c.verdicts[static_cast<std::size_t>(of)];
  const std::vector<Verdict>& a = verdicts[0];
  const std::vector<Verdict>& b = verdicts[second];
  const auto share = [&](const auto& has) {
    const RateTotals totals = share_totals(
        a.size(), [&](std::size_t i) { return has(a[i], b[i]); },
        [&](std::size_t i) { return c.ground.is_counted(i); });
    return ratio_of_totals(totals.part, totals.of);
  };
  PairDifference d;
  d.second = second;
  d.of = of;
  d.only_first = share([](Verdict x, Verdict y) { return is_kept(x) && !is_kept(y); });
  d.only_second = share([](Verdict x, Verdict y) { return !is_kept(x) && is_kept(y); });
  d.only_first_failing = share([](Verdict x, Verdict y) { return is_kept(x) && fails(y); });
  d.only_second_failing = share([](Verdict x, Verdict y) { return fails(x) && is_kept(y); });
  d.both = share([](Verdict x, Verdict y) { return is_kept(x) && is_kept(y); });
  d.neither = share([](Verdict x, Verdict y) { return !is_kept(x) && !is_kept(y); });
  return d;
}

/// A proof that ended early decides nothing about the plan.
void warn_of_open_states(Comparison& c) {
  constexpr double most_unwarned = 0.02;
  constexpr auto undecided = static_cast<std::size_t>(Verdict::undecided);
  for (std::size_t k = 0; k < c.names.size(); ++k) {
    const SampledValue& open = c.measures[k].exact.all[undecided];
    if (open.value > most_unwarned) {
      c.warnings.push_back(fmt::format(
          "{}: {} of all states are undecided, and count as not proved; they may go either way. "
          "Verify longer (fairway verify, with --resume) to tell.",
          c.names[k], percent_text(open.value)));
    }
    if (!c.measures[k].contract) continue;
    const SampledValue& under = c.measures[k].contract->all[undecided];
    if (under.value > most_unwarned) {
      c.warnings.push_back(fmt::format(
          "{}: under the contract {} of all states are undecided, and count as not proved: from "
          "some of them a behaviour may fail, of others nothing is known. fairway verify tells how "
          "many are at risk.",
          c.names[k], percent_text(under.value)));
    }
  }
}

void fill_pairs(std::span<const ComparedPlan> plans, const CompareOptions& options,
                StageClock& clock, Comparison& c) {
  const auto add = [&](Knowledge of, int across, int headings) {
    clock.begin("mapping the differences", unknown_time);
    std::vector<DifferenceMap> maps = difference_maps(plans, c.ground, of, across, headings);
    for (std::size_t k = 1; k < plans.size(); ++k) {
      PairDifference& d = c.pairs.emplace_back(difference_of(c, k, of));
      d.map = std::move(maps[k - 1]);
    }
  };
  add(Knowledge::exact, options.map_across, options.map_headings);
  // Under a contract a state takes a hundred times as long.
  constexpr int contract_across = 64;
  constexpr int contract_headings = 12;
  if (c.has_contract) {
    add(Knowledge::contract, std::min(options.map_across, contract_across),
        std::min(options.map_headings, contract_headings));
  }
}

}  // namespace

Comparison compare_plans(std::span<const ComparedPlan> plans, const CompareOptions& options,
                         StageClock& clock) {
  require(plans.size() >= 2, "a comparison is of two plans at least");
  require(options.states >= 1000, "a comparison samples at least 1000 states");
  Comparison c;
  c.warnings = require_alike(plans);
  c.ground = common_ground(plans, options.states / 2, options.seed);
  if (c.ground.counted == 0) {
    throw InputError(plans[1].from.string(),
                     fmt::format("has no state in common with {}: nowhere are both free",
                                 plans[0].from.string()));
  }
  std::vector<StatesUnderPlan> states;
  const auto of_all = [&](const auto& has) { return std::all_of(plans.begin(), plans.end(), has); };
  c.is_proved = of_all([](const ComparedPlan& p) { return p.certificate.has_value(); });
  c.has_contract = of_all([](const ComparedPlan& p) { return p.contract.has_value(); });
  c.does[0] = does_of(plans[0], Knowledge::exact);
  if (c.has_contract) {
    const auto whole = std::find_if(plans.begin(), plans.end(), [](const ComparedPlan& p) {
      return p.contract->follow.has_value();
    });
    c.does[1] = does_of(whole == plans.end() ? plans[0] : *whole, Knowledge::contract);
  }
  for (const ComparedPlan& plan : plans) {
    c.names.push_back(plan.name);
    for (const std::string& warning : plan.warnings) {
      c.warnings.push_back(plan.name + ": " + warning);
    }
    states.push_back(measured(plan, c.ground, options, clock));
    c.measures.push_back(measures_of(plan, c.ground, states.back()));
    c.verdicts[0].push_back(states.back().exact);
    if (c.has_contract) c.verdicts[1].push_back(states.back().contract);
  }
  const bool any_contract = std::any_of(
      plans.begin(), plans.end(), [](const ComparedPlan& p) { return p.contract.has_value(); });
  warn_of_open_states(c);
  if (any_contract && !c.has_contract) {
    c.warnings.push_back(
        "Not every plan is proved under a contract: only the exact vehicle is compared.");
  }
  if (c.has_contract) forget_touches(plans, c);
  fill_table(plans, states, c);
  fill_pairs(plans, options, clock, c);
  return c;
}

PlanMeasures measure_plan(const ComparedPlan& plan, const CompareOptions& options,
                          StageClock& clock) {
  const CommonGround ground = common_ground({&plan, 1}, options.states / 2, options.seed);
  return measures_of(plan, ground, measured(plan, ground, options, clock));
}

}  // namespace fairway
