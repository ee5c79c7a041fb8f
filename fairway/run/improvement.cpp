#include "fairway/run/improvement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/path_follower.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

/// How freely commands may be changed. Prices are in starts of the model.
struct Manner {
  std::int64_t tear_price;
  double most_bend_rad;
};

/// Bold ones first: they gain more of the model's starts, and more often their motion is too wild
/// for a proof. Under a contract the commands of a whole neighbourhood are mixed.
std::vector<Manner> manners(const ImprovementOptions& options, bool under_contract) {
  std::vector<Manner> all = under_contract
                                ? std::vector<Manner>{{4, 1.0}, {4, 0.5}, {8, 0.25}}
                                : std::vector<Manner>{{1, 4.0}, {4, 4.0}, {4, 1.0}, {8, 0.5}};
  if (options.most_bend_rad) {
    for (Manner& manner : all) manner.most_bend_rad = *options.most_bend_rad;
  }
  return all;
}

bool follows(const Plan& plan) { return PathFollower::is_asked(plan, {}); }

/// What the mission asks, in shares of all states. What a limit leaves open counts as not proved.
class Judge {
 public:
  Judge(const std::string& where, const ImprovementOptions& options)
      : where_(where), options_(options) {}

  SharesKept operator()(const Plan& plan, double limit_s) const {
    SharesKept proved;
    if (!follows(plan)) {
      CertifyOptions certify;
      certify.undecided_max = options_.undecided_max;
      certify.time_limit_s = limit_s;
      const auto shares = verify_plan(plan, where_, {}, certify).outcome.volume.all;
      proved.exact = of_mission(shares);
      proved.exact_at_most = proved.exact + shares[static_cast<std::size_t>(Verdict::undecided)];
    } else {
      // This proof goes on to its end.
      proved.exact = proved.exact_at_most = share_under(plan, nearly_exact(plan.vehicle), limit_s);
    }
    if (plan.record.contract) {
      proved.under_contract = share_under(plan, *plan.record.contract, limit_s);
    }
    return proved;
  }

 private:
  double share_under(const Plan& plan, const VehicleContract& contract, double limit_s) const {
    ContractVerifyOptions verify;
    verify.limits.time_limit_s = limit_s;
    verify.samples = 100000;
    verify.or_touch = false;
    verify.find_witnesses = false;
    const auto made =
        verify_contract(plan, where_, {}, contract, verify, [](const std::string&) {});
    return of_mission(made.survey.shares.all);
  }
  static double of_mission(const std::array<double, verdict_count>& shares) {
    return shares[static_cast<std::size_t>(Verdict::reach)] +
           shares[static_cast<std::size_t>(Verdict::follow)];
  }

  const std::string& where_;
  const ImprovementOptions& options_;
};

bool is_better(const SharesKept& now, const SharesKept& before) {
  return now.exact > before.exact_at_most &&
         now.under_contract.value_or(0.0) >= before.under_contract.value_or(0.0);
}

/// The plan with the commands that the model likes best.
Plan proposed(const Plan& plan, const Manner& manner, const ImprovementOptions& options,
              StageClock& clock) {
  const std::vector<CellKind> kinds = cell_kinds(plan.grid, plan.region, {});
  SampledFlowOptions model;
  model.reaches_aligned = follows(plan);
  SampledFlow flow({plan.grid, plan.vehicle, plan.heading_rad.data(), kinds.data()}, model);
  ImproveOptions improve;
  improve.sweeps = options.sweeps;
  improve.tear_price = manner.tear_price;
  improve.most_bend_rad = manner.most_bend_rad;
  improve_commands(flow, plan.grid, improve, holding_cells(plan), [&](const ImproveProgress& p) {
    if (p.tried % 256 == 0) {
      clock.rename(fmt::format("improving commands: sweep {}, {} of {} cells tried, {} changed",
                               p.sweep, p.tried, p.cells, p.changed));
      clock.tell(unknown_time);
    }
    return options.time_limit_s <= 0.0 || clock.seconds() < options.time_limit_s;
  });
  Plan improved = plan;
  for (std::size_t cell = 0; cell < plan.grid.size(); ++cell) {
    improved.heading_rad[cell] = flow.heading_rad(cell);
  }
  return improved;
}

std::vector<std::size_t> differing_cells(const Plan& a, const Plan& b) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < a.grid.size(); ++cell) {
    const bool none = std::isnan(a.heading_rad[cell]) && std::isnan(b.heading_rad[cell]);
    if (!none && a.heading_rad[cell] != b.heading_rad[cell]) cells.push_back(cell);
  }
  return cells;
}

ImprovedRecord record_of(const Plan& plan, const Improvement& made) {
  ImprovedRecord record{
      plan_digests(plan).heading_rad, made.changed.size(), {made.before.exact, made.after.exact}};
  if (made.before.under_contract) {
    record.under_contract = {{*made.before.under_contract, *made.after.under_contract}};
  }
  return record;
}

}  // namespace

Improvement improved(const Plan& plan, const std::string& where, const ImprovementOptions& options,
                     StageClock& clock) {
  if (plan.grid.size() > SampledFlow::most_cells() / 2) {
    throw InputError(
        where, fmt::format("has {} cells, and at most {} can be improved",
                           grouped(plan.grid.size()), grouped(SampledFlow::most_cells() / 2)));
  }
  const Judge judge(where, options);
  Improvement made;
  clock.begin("proving the plan as it is", unknown_time);
  made.before = made.after = judge(plan, 0.0);
  made.plan = plan;
  const double limit_s = std::max(20.0, 5.0 * clock.seconds());
  for (const Manner& manner : manners(options, plan.record.contract.has_value())) {
    clock.begin("improving commands", unknown_time);
    Plan candidate = proposed(plan, manner, options, clock);
    if (differing_cells(plan, candidate).empty()) continue;
    clock.begin("proving the improved plan", unknown_time);
    const SharesKept proved = judge(candidate, limit_s);
    ++made.attempts;
    if (!is_better(proved, made.before)) continue;
    made.after = proved;
    made.plan = std::move(candidate);
    made.changed = differing_cells(plan, made.plan);
    made.plan.record.improved = record_of(plan, made);
    break;
  }
  clock.end();
  return made;
}

std::vector<Finding> findings(const Plan& before, const Improvement& made) {
  std::size_t commanded = 0;
  for (const float heading_rad : before.heading_rad) commanded += std::isnan(heading_rad) ? 0 : 1;
  if (made.changed.empty()) {
    return {{"", "",
             fmt::format(
                 "No better commands were found: of {} tried, none is proved to save more states",
                 made.attempts == 1 ? "one set" : fmt::format("{} sets", made.attempts))}};
  }
  const std::string goal = goal_word(before);
  const std::string what = !follows(before) ? proved_to_reach(goal)
                           : goal == "path"
                               ? "are proved to join the path and to follow it for ever"
                               : "are proved to reach the goal and to stay there";
  const auto gain = [&](double now, double was, const std::string& whom) {
    return Finding{percent_text(now), "all states",
                   fmt::format("{}{}, {} before", what, whom, percent_text(was))};
  };
  std::vector<Finding> lines{gain(made.after.exact, made.before.exact, "")};
  if (made.after.under_contract) {
    lines.push_back(
        gain(*made.after.under_contract, *made.before.under_contract, " under the contract"));
  }
  lines.push_back({percent_text(made.changed.size(), commanded), "cells with a command",
                   fmt::format("got another heading ({} of {})", grouped(made.changed.size()),
                               grouped(commanded))});
  return lines;
}

std::string changes_csv(const Plan& before, const Improvement& made) {
  std::string text = "x_m,y_m,before_rad,after_rad\n";
  for (const std::size_t cell : made.changed) {
    const Vec2 at = before.grid.center(before.grid.cell_at(cell));
    text += fmt::format("{},{},{},{}\n", at.x, at.y, before.heading_rad[cell],
                        made.plan.heading_rad[cell]);
  }
  return text;
}

}  // namespace fairway
