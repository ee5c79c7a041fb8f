#include "fairway/compare/comparison_table.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/compare/state_verdicts.hpp"
#include "fairway/run/path_follower.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Adds the lines of a comparison one by one.
class Table {
 public:
  Table(std::span<const ComparedPlan> plans, std::span<const StatesUnderPlan> states,
        Comparison& comparison)
      : plans_(plans), states_(states), comparison_(comparison) {}

  std::string group;  ///< of the lines that follow

  /// A line of ratios: `totals(k)` of plan k.
  void add(ComparedMeasure line, const std::function<RateTotals(std::size_t)>& totals) {
    RateTotals first;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      RateTotals its = totals(k);
      line.value.push_back(ratio_of_totals(its.part, its.of));
      if (k == 0) first = its;
      line.difference_from_first.push_back(
          difference_of_ratios(first.part, first.of, its.part, its.of));
    }
    push(std::move(line));
  }

  /// A share of the states that count: those for which `has(verdict)`.
  void add_share(ComparedMeasure line, Knowledge of, const std::function<bool(Verdict)>& has,
                 const std::function<bool(std::size_t k, std::size_t state)>& counts) {
    line.unit = "%";
    const auto& verdicts = comparison_.verdicts[static_cast<std::size_t>(of)];
    add(std::move(line), [&](std::size_t k) {
      return share_totals(
          verdicts[k].size(), [&](std::size_t i) { return has(verdicts[k][i]); },
          [&](std::size_t i) { return comparison_.ground.is_counted(i) && counts(k, i); });
    });
  }

  /// A line of values without paired errors.
  void add_values(ComparedMeasure line, const std::function<SampledValue(std::size_t)>& value) {
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      line.value.push_back(value(k));
      const double difference = line.value[k].value - line.value[0].value;
      line.difference_from_first.push_back(
          {difference, k == 0 ? 0.0 : unknown, line.value[k].states});
    }
    push(std::move(line));
  }

 private:
  void push(ComparedMeasure line) {
    line.group = group;
    comparison_.table.push_back(std::move(line));
  }

  std::span<const ComparedPlan> plans_;
  std::span<const StatesUnderPlan> states_;
  Comparison& comparison_;
};

SampledValue of_quantile(const QuantileEstimate& q) {
  constexpr double widths = 2.0 * 1.959963984540054;
  return {q.value, (q.high - q.low) / widths, q.states};
}

void add_known(Table& table, const Comparison& c, Knowledge of) {
  const std::string key = of == Knowledge::exact ? "" : "contract_";
  const std::string found = of == Knowledge::exact && !c.is_proved ? "seen" : "proved";
  const auto everywhere = [](std::size_t, std::size_t) { return true; };
  table.group = of == Knowledge::exact
                    ? fmt::format("of all {} states", grouped(c.ground.counted))
                    : fmt::format("of all {} states, to {}", grouped(c.ground.counted), c.does[1]);
  table.add_share({key + "fails", "", found + " to fail", "", -1, {}, {}}, of, fails, everywhere);
  if (found == "proved") {
    table.add_share(
        {key + "undecided", "", "undecided", "", -1, {}, {}}, of,
        [](Verdict v) { return v == Verdict::undecided; }, everywhere);
  }
  bool holds = false;
  for (const auto& verdicts : c.verdicts[static_cast<std::size_t>(of)]) {
    for (const Verdict v : verdicts) holds = holds || v == Verdict::hold;
  }
  if (holds) {
    table.add_share(
        {key + "hold", "", found + " to hold for ever", "", 0, {}, {}}, of,
        [](Verdict v) { return v == Verdict::hold; }, everywhere);
  }
  table.add_share({key + "proved", "", c.known_to(of), "", 1, {}, {}}, of, is_kept, everywhere);
}

/// Each plan's own cells are other ground: more of less is not better.
void add_known_in_cells(Table& table, std::span<const ComparedPlan> plans, const Comparison& c) {
  const auto add = [&](const std::string& key, Region region) {
    const auto counts = [&, region](std::size_t k, std::size_t i) {
      return is_in(plans[k].plan, c.ground.states[i], region);
    };
    table.add_share({key + "_proved", "", c.known_to(Knowledge::exact), "", 0, {}, {}},
                    Knowledge::exact, is_kept, counts);
    if (!c.has_contract) return;
    table.add_share({key + "_contract_proved", "", c.known_to(Knowledge::contract), "", 0, {}, {}},
                    Knowledge::contract, is_kept, counts);
  };
  table.group = "of the states in each plan's own safe-start cells";
  add("safe_start", Region::free);
  table.group = "of the states in each plan's own buffer cells";
  add("buffer", Region::buffer);
}

void add_costs(Table& table, std::span<const StatesUnderPlan> states, Comparison& c) {
  std::vector<bool> all(c.ground.states.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = c.ground.is_counted(i);
    for (const StatesUnderPlan& under : states) all[i] = all[i] && under.flown.flights[i].succeeds;
  }
  const RateTotals share = share_totals(
      all.size(), [&](std::size_t i) { return all[i]; },
      [&](std::size_t i) { return c.ground.is_counted(i); });
  c.all_succeed = ratio_of_totals(share.part, share.of);
  const int decimals = decimals_of_sample(c.ground.counted);
  table.group = fmt::format("flown from the {} of all states that succeed under every plan",
                            percent_text(c.all_succeed.value, decimals));
  const auto add = [&](const CostRate& rate, const std::string& name, const std::string& unit) {
    table.add({rate.key, "", name, unit, -1, {}, {}},
              [&](std::size_t k) { return totals_of(rate, states[k].flown, all); });
  };
  add(cost_rate::time_s, "time, mean", "s");
  add(cost_rate::length_m, "length, mean", "m");
  add(cost_rate::length_ratio, "length, by a bound of the shortest", "");
  add(cost_rate::turned_rad_per_100m, "turns", "rad per 100 m");
  add(cost_rate::reversals_per_100m, "reversals of turn", "per 100 m");
  const auto add_clearance = [&](const char* key, const char* name, double q) {
    table.add_values({key, "", name, "m", 1, {}, {}}, [&](std::size_t k) {
      return of_quantile(quantile_of(clearances_of(states[k].flown, all), q));
    });
  };
  add_clearance("clearance_p05_m", "least clearance, 5 % come nearer", 0.05);
  add_clearance("clearance_median_m", "least clearance, median", 0.5);
}

void add_path(Table& table, const Comparison& c) {
  for (const PlanMeasures& m : c.measures) {
    if (!m.costs.path) return;
  }
  table.group = "flown along the path, under each plan from its own states";
  const auto add = [&](const char* key, const char* name, const char* unit, int better,
                       SampledValue PathCosts::*member) {
    table.add_values({key, "", name, unit, better, {}, {}},
                     [&](std::size_t k) { return (*c.measures[k].costs.path).*member; });
  };
  const auto add_plain = [&](const char* key, const char* name, double PathCosts::*member) {
    table.add_values({key, "", name, "m", -1, {}, {}}, [&](std::size_t k) {
      const PathCosts& path = *c.measures[k].costs.path;
      return SampledValue{path.joined.states == 0 ? unknown : path.*member, unknown,
                          path.joined.states};
    });
  };
  add("joined", "join it, of those that touch it", "%", 1, &PathCosts::joined);
  add("time_to_join_s", "time to join, mean", "s", -1, &PathCosts::time_to_join_s);
  add("path_distance_m", "distance from it, mean", "m", -1, &PathCosts::distance_m);
  add_plain("path_distance_p95_m", "distance from it, 95 % of the time",
            &PathCosts::distance_p95_m);
  add_plain("path_distance_worst_m", "distance from it, worst", &PathCosts::distance_worst_m);
}

}  // namespace

std::string does_of(const ComparedPlan& plan, Knowledge of) {
  const bool path = std::string(goal_word(plan.plan)) == "path";
  if (of == Knowledge::exact || !plan.contract) {
    const bool flown = !plan.certificate && is_loop_to_follow(plan.plan);
    return flown  ? "touch the path and fly on for a lap"
           : path ? "touch the path"
                  : "reach the goal";
  }
  const ContractCertificate& c = *plan.contract;
  const std::string does = c.follow && !c.follow->hold ? "join the path and follow it"
                           : c.follow                  ? "reach the goal and stay there"
                           : path                      ? "touch the path"
                                                       : "reach the goal";
  return does + (is_exact(c) ? "" : " within the contract");
}

void fill_table(std::span<const ComparedPlan> plans, std::span<const StatesUnderPlan> states,
                Comparison& comparison) {
  Table table(plans, states, comparison);
  add_known(table, comparison, Knowledge::exact);
  if (comparison.has_contract) add_known(table, comparison, Knowledge::contract);
  add_known_in_cells(table, plans, comparison);
  add_costs(table, states, comparison);
  add_path(table, comparison);
}

}  // namespace fairway
