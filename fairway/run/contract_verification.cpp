#include "fairway/run/contract_verification.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/at_risk_search.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/version.hpp"
#include "fairway/vehicle/contract_defect.hpp"

namespace fairway {
namespace {

using nlohmann::json;

json chokes_json(const ContractVerification& made) {
  const Grid& grid = made.certificate.grid;
  json chokes = json::array();
  for (const Choke& choke : made.survey.chokes) {
    const Vec2 at = grid.center(choke.cell);
    chokes.push_back({{"x_m", at.x},
                      {"y_m", at.y},
                      {"cell", {choke.cell.ix, choke.cell.iy}},
                      {"reason", reason_of(choke.why)},
                      {"share", choke.share}});
  }
  return chokes;
}

json evidence_of(const ContractVerifyOptions& options, const ContractVerification& made) {
  json levels = json::array();
  for (const InclusionLevel& level : made.levels) {
    levels.push_back({{"level", level.level},
                      {"leaves", level.leaves},
                      {"undecided_leaves", level.undecided},
                      {"undecided_sides", level.undecided_share}});
  }
  const ContractShares& s = made.survey.shares;
  const auto shares = [&](const std::array<double, verdict_count>& of) {
    json by_name = shares_json(of);
    if (!made.following || made.certificate.follow->hold) return by_name;
    by_name[name_of(Verdict::follow)] = by_name[name_of(Verdict::reach)];
    by_name.erase(name_of(Verdict::reach));
    return by_name;
  };
  json evidence = {
      {"program", program_version},
      {"options",
       {{"time_limit_s",
         options.limits.time_limit_s > 0.0 ? json(options.limits.time_limit_s) : json()},
        {"memory_limit_mb",
         options.limits.memory_limit_mb ? json(*options.limits.memory_limit_mb) : json()},
        {"samples", options.samples},
        {"seed", options.seed}}},
      {"volume_fraction", shares(s.all)},
      {"volume_fraction_free", shares(s.free)},
      {"volume_fraction_buffer", shares(s.buffer)},
      {"volume_fraction_usable", shares(s.usable)},
      {"at_risk", made.searched ? json(s.at_risk) : json()},
      {"at_risk_free", made.searched ? json(s.at_risk_free) : json()},
      {"samples", s.samples},
      {"worst_time_s", s.worst_time_s},
      {"chokes", chokes_json(made)},
      {"levels", std::move(levels)},
      {"stopped_by", made.stopped_by_limit ? "limit" : "done"}};
  if (!s.reach_by_mode.empty()) evidence["reach_by_mode"] = s.reach_by_mode;
  // Only when the limit of time ended the search: of all else the share is counted.
  if (made.searched && made.searched_states < made.undecided_states) {
    evidence["at_risk_samples"] = made.searched_states;
  }
  return evidence;
}

/// Seconds so far, against a limit; 0 is none.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }
  bool is_within(double limit_s) const { return limit_s <= 0.0 || seconds() < limit_s; }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Coarser ones mix the commands of both sides of the line, finer ones prove hardly more and no
/// narrower tube.
int parts_to_follow(const Plan& plan) {
  constexpr double widest_part_radii = 0.14;
  const double cell_radii = plan.grid.cell_m / plan.vehicle.turn_radius_m;
  return std::max(2, static_cast<int>(std::ceil(cell_radii / widest_part_radii)));
}

/// What is to be proved, of nothing yet.
ContractCertificate question(const Plan& plan, const RegionOfInterest& region,
                             const VehicleContract& contract, int parts_per_cell) {
  ContractCertificate c;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.contract = contract;
  c.parts_per_cell =
      parts_per_cell > 0 ? parts_per_cell : usual_parts_per_cell(contract, plan.grid.cell_m);
  c.region_of_interest = region;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.holding = holding_cells(plan);
  c.kind = cell_kinds(plan.grid, plan.region, region);
  c.plan = plan_digests(plan);
  c.frame = plan.record.frame;
  return c;
}

void measure(const Plan& plan, std::span<const ContractMode> modes, const InclusionProver& prover,
             const ContractVerifyOptions& options, UndecidedStates& undecided,
             ContractVerification& made) {
  const ContractCertificate& c = made.certificate;
  std::vector<bool> is_free(c.grid.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = c.region[i] == Region::free;
  SurveyOptions sampled;
  sampled.samples = options.samples;
  sampled.seed = options.seed;
  // Nothing is claimed outside the walls of a track, and searches there would take minutes.
  sampled.search_all = !made.following;
  made.survey = survey(c.flow(), is_free, usable_cells(plan), modes, prover, c.least_speed_mps(),
                       sampled, undecided.gatherer());
}

/// Of a plan that has further modes. (Under a limit of time, all or none of them are proved.)
ProvedContractModes prove_further(const Plan& plan, const Parts& parts, InclusionLimits limits,
                                  const std::function<void(const std::string& doing)>& progress,
                                  ContractVerification& made) {
  ContractCertificate& c = made.certificate;
  if (plan.further_modes() == 0 || made.stopped_by_limit) return {};
  // Smaller leaves earn next to nothing: they lie along the edges of what is proved.
  limits.last_level = 2;
  limits.hand_over_level = 1;
  ContractModesProof proof = prove_contract_modes(
      c.flow(), plan.further_rad(), over_ground(c.contract), c.parts_per_cell,
      EstimateError::of(c.contract), {parts, c.verdicts}, limits, [&](int mode) {
        progress(
            fmt::format("verifying under the contract, mode {} of {}", mode, plan.further_modes()));
      });
  if (proof.stopped_by_limit) {
    made.stopped_by_limit = true;
    return {};
  }
  c.mode_heading_rad = plan.mode_heading_rad;
  c.mode_verdicts = joined(proof.further);
  return std::move(proof.further);
}

}  // namespace

int usual_parts_per_cell(const VehicleContract& contract, double cell_m) {
  const double rho = contract.command_error_m + contract.look_ahead_m;
  if (rho >= 0.25 * cell_m) return 1;
  return rho >= 0.1 * cell_m ? 2 : 4;
}

ContractVerification verify_contract(const Plan& plan, const std::string& where,
                                     const RegionOfInterest& region,
                                     const VehicleContract& contract,
                                     const ContractVerifyOptions& options,
                                     const std::function<void(const std::string& doing)>& progress,
                                     const EarlierContractProof* earlier) {
  if (!(plan.grid.cell_m < plan.vehicle.turn_radius_m)) {
    throw InputError(
        where, fmt::format("its cells of {:g} m are not smaller than the turning radius of {:g} m, "
                           "as verification requires",
                           plan.grid.cell_m, plan.vehicle.turn_radius_m));
  }
  require_contract(contract, plan.vehicle, where + ": contract");
  ContractVerification made;
  ContractCertificate& c = made.certificate;
  const int parts_asked = options.parts_per_cell == 0 && earlier
                              ? earlier->certificate.parts_per_cell
                              : options.parts_per_cell;
  c = question(plan, region, contract, parts_asked);
  if (PathFollower::is_asked(plan, region) && parts_asked == 0)
    c.parts_per_cell = parts_to_follow(plan);
  // Where most states are undecided, a search in each takes too long.
  const bool search = options.find_witnesses && wild_share(plan, contract) <= most_wild_unwarned;

  constexpr double share_of_the_proof = 0.8;
  const Stopwatch watch;
  const double limit_s = options.limits.time_limit_s;
  InclusionLimits limits;
  limits.memory_bytes =
      static_cast<std::size_t>(options.limits.memory_limit_mb.value_or(0.0) * 1e6);
  limits.go_on = [&] { return watch.is_within(search ? share_of_the_proof * limit_s : limit_s); };
  const ContractVerdicts* earlier_verdicts =
      earlier != nullptr ? &earlier->certificate.verdicts : nullptr;
  if (earlier != nullptr) {
    // One finer than before, down to the finest that leaves are cut to.
    constexpr int finest = std::bit_width(side_units) - 1;
    const int next = finest_level(earlier->certificate.verdicts) + 1;
    limits.last_level = std::clamp(next, limits.last_level, finest);
  }
  bool in_time = true;  // to prove the earlier leaves again
  const auto note = [&](const InclusionLevel& level) {
    if (made.levels.empty()) in_time = limits.go_on();
    made.levels.push_back(level);
    progress(fmt::format("verifying under the contract, {:.1f} % of sides undecided",
                         100.0 * level.undecided_share));
  };
  double proof_s = 0.0;
  UndecidedStates undecided;
  const auto survey_with = [&](std::span<const ContractMode> modes, const InclusionProver& prover) {
    proof_s = watch.seconds();
    progress("measuring shares of states");
    measure(plan, modes, prover, options, undecided, made);
  };
  // An earlier proof that a path is touched goes on as such.
  std::optional<PathFollower> follower;
  if (PathFollower::is_asked(plan, region) && (earlier == nullptr || earlier->certificate.follow)) {
    follower.emplace(plan, c, limits);
  }
  if (earlier != nullptr) {
    ContractCertificate now = c;
    if (follower) follower->fill_question(now);
    require_same_proof(*earlier, now);
  }
  if (follower) {
    progress("proving that the path is followed");
    made.no_tube = !follower->find_core();
    if (!made.no_tube) {
      made.stopped_by_limit = !follower->join(note, earlier_verdicts);
      follower->fill(c);
      made.following = follower->found();
      survey_with(std::array{ContractMode{follower->parts(), c.verdicts}}, follower->prover());
    }
  }
  if (made.no_tube && earlier != nullptr) {
    throw InputError(earlier->where,
                     "its tube was not proved again within the limit of time; cannot resume from "
                     "it");
  }
  if (made.no_tube && !options.or_touch) return made;
  if (!made.following) {
    const Parts parts = c.parts();
    InclusionProver prover(parts, limits);
    if (earlier_verdicts != nullptr) prover.start_from(*earlier_verdicts);
    made.stopped_by_limit = !prover.run(note);
    c.verdicts = prover.verdicts(c.least_speed_mps());
    const ProvedContractModes further = prove_further(plan, parts, limits, progress, made);
    std::vector<ContractMode> modes{{parts, c.verdicts}};
    for (const auto& mode : further) modes.push_back({mode->parts, mode->verdicts});
    survey_with(modes, prover);
  }
  if (earlier != nullptr) made.resumed = taken_over(*earlier, c.verdicts, in_time);
  if (search) {
    progress("searching for behaviours that fail");
    const std::vector<State> states = undecided.in_random_order(options.seed);
    // Measuring has not used up what is left for it.
    const double rest_s = std::max(limit_s - proof_s, (1.0 - share_of_the_proof) * limit_s);
    const FailureSearch failures(c);
    const Stopwatch search_watch;
    const RiskCount found =
        failures.count(states, options.seed, [&] { return search_watch.is_within(rest_s); });
    made.undecided_states = states.size();
    made.searched_states = found.asked;
    made.searched = add_at_risk(made.survey.shares, states.size(), found);
  }
  c.evidence_json = evidence_of(options, made).dump();
  return made;
}

}  // namespace fairway
