#include "fairway/compare/measure_plan.hpp"

#include "fairway/compare/state_verdicts.hpp"

namespace fairway {
namespace {

template <typename Counts>
VerdictShares shares_of(const std::vector<Verdict>& verdicts, const Counts& counts) {
  VerdictShares shares;
  for (const Verdict verdict : verdicts_in_order) {
    const RateTotals totals = share_totals(
        verdicts.size(), [&](std::size_t i) { return verdicts[i] == verdict; }, counts);
    shares[static_cast<std::size_t>(verdict)] = ratio_of_totals(totals.part, totals.of);
  }
  return shares;
}

ProvedShares proved_shares(const Plan& plan, const CommonGround& ground,
                           const std::vector<Verdict>& verdicts) {
  const auto counts_in = [&](Region region) {
    return [&, region](std::size_t i) {
      return ground.is_counted(i) && is_in(plan, ground.states[i], region);
    };
  };
  return {shares_of(verdicts, [&](std::size_t i) { return ground.is_counted(i); }),
          shares_of(verdicts, counts_in(Region::free)),
          shares_of(verdicts, counts_in(Region::buffer))};
}

}  // namespace

bool is_in(const Plan& plan, const State& state, Region region) {
  const Cell c = plan.grid.cell_of(state.position_m);
  return plan.grid.contains(c) && plan.region[plan.grid.index(c)] == region;
}

StatesUnderPlan states_under(const ComparedPlan& plan, const CommonGround& ground,
                             const LengthBound& bound,
                             const std::function<void(std::size_t)>& progress) {
  StatesUnderPlan found;
  found.flown = measure_flights(plan.plan, ground.states, ground.counts, bound, progress);
  found.exact = plan.certificate ? verdicts_of(*plan.certificate, ground.states)
                                 : seen_in(found.flown, plan.plan, ground.states);
  if (plan.contract) found.contract = verdicts_of(*plan.contract, ground.states);
  return found;
}

PlanMeasures measures_of(const ComparedPlan& plan, const CommonGround& ground,
                         const StatesUnderPlan& states) {
  PlanMeasures measures;
  measures.exact = proved_shares(plan.plan, ground, states.exact);
  measures.is_proved = plan.certificate.has_value();
  if (plan.contract) measures.contract = proved_shares(plan.plan, ground, states.contract);
  measures.costs = flight_costs(states.flown);
  return measures;
}

}  // namespace fairway
