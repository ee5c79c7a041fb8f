#include <cmath>

#include "fairway/compare/comparison_text.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/plan/plan_digests_json.hpp"
#include "fairway/run/flight_costs.hpp"

namespace fairway {
namespace {

using nlohmann::json;

json shares_json(const VerdictShares& shares) {
  json by_name = json::object();
  for (const Verdict verdict : verdicts_in_order) {
    const SampledValue& e = shares[static_cast<std::size_t>(verdict)];
    if (is_listed(verdict, e.value > 0.0)) by_name[name_of(verdict)] = estimate_json(e);
  }
  return by_name;
}

json shares_json(const ProvedShares& shares) {
  return {{"all", shares_json(shares.all)},
          {"safe_start", shares_json(shares.safe_start)},
          {"buffer", shares_json(shares.buffer)}};
}

json estimates_json(const std::vector<SampledValue>& estimates) {
  json all = json::array();
  for (const SampledValue& e : estimates) {
    json one = estimate_json(e);
    if (!std::isfinite(e.standard_error)) one["standard_error"] = json();
    all.push_back(std::move(one));
  }
  return all;
}

json pair_json(const PairDifference& d) {
  return {{"first", d.first},
          {"second", d.second},
          {"of", name_of(d.of)},
          {"only_first", estimate_json(d.only_first)},
          {"only_first_second_fails", estimate_json(d.only_first_failing)},
          {"only_second", estimate_json(d.only_second)},
          {"only_second_first_fails", estimate_json(d.only_second_failing)},
          {"both", estimate_json(d.both)},
          {"neither", estimate_json(d.neither)}};
}

}  // namespace

json comparison_json(std::span<const ComparedPlan> plans, const Comparison& c) {
  json of_plans = json::array();
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const PlanMeasures& m = c.measures[k];
    of_plans.push_back({{"name", plans[k].name},
                        {"from", plans[k].from.string()},
                        {"proofs", plans[k].proofs},
                        {"sha256", json::parse(json_text(plan_digests(plans[k].plan)))},
                        {"cells", {plans[k].plan.grid.nx, plans[k].plan.grid.ny}},
                        {"cell_m", plans[k].plan.grid.cell_m},
                        {"options", plans[k].plan.record.options_json.empty()
                                        ? json()
                                        : json::parse(plans[k].plan.record.options_json)},
                        {"is_proved", m.is_proved},
                        {"exact", shares_json(m.exact)},
                        {"contract", m.contract ? shares_json(*m.contract) : json()},
                        {"costs", flight_costs_json(m.costs)}});
  }
  json table = json::array();
  for (const ComparedMeasure& m : c.table) {
    table.push_back({{"measure", m.key},
                     {"of", m.group},
                     {"name", m.name},
                     {"unit", m.unit == "%" ? "1" : m.unit},
                     {"better", m.better},
                     {"value", estimates_json(m.value)},
                     {"difference_from_first", estimates_json(m.difference_from_first)}});
  }
  json pairs = json::array();
  for (const PairDifference& d : c.pairs) pairs.push_back(pair_json(d));
  return {{"plans", std::move(of_plans)},       {"states", c.ground.counted},
          {"is_proved", c.is_proved},           {"all_succeed", estimate_json(c.all_succeed)},
          {"differences", difference_lines(c)}, {"table", std::move(table)},
          {"pairs", std::move(pairs)},          {"warnings", c.warnings}};
}

}  // namespace fairway
