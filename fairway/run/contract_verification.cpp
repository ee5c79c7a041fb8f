#include "fairway/run/contract_verification.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/at_risk_search.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/summary.hpp"
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
  json evidence = {
      {"program", program_version},
      {"options",
       {{"time_limit_s",
         options.limits.time_limit_s > 0.0 ? json(options.limits.time_limit_s) : json()},
        {"memory_limit_mb",
         options.limits.memory_limit_mb ? json(*options.limits.memory_limit_mb) : json()},
        {"samples", options.samples},
        {"seed", options.seed}}},
      {"volume_fraction", shares_json(s.all)},
      {"volume_fraction_free", shares_json(s.free)},
      {"volume_fraction_buffer", shares_json(s.buffer)},
      {"at_risk", made.searched ? json(s.at_risk) : json()},
      {"at_risk_free", made.searched ? json(s.at_risk_free) : json()},
      {"samples", s.samples},
      {"worst_time_s", s.worst_time_s},
      {"chokes", chokes_json(made)},
      {"levels", std::move(levels)},
      {"stopped_by", made.stopped_by_limit ? "limit" : "done"}};
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
  c.kind = cell_kinds(plan.grid, plan.region, region);
  c.plan = plan_digests(plan);
  c.frame = plan.record.frame;
  return c;
}

void measure(const Parts& parts, const InclusionProver& prover,
             const ContractVerifyOptions& options, UndecidedStates& undecided,
             ContractVerification& made) {
  const ContractCertificate& c = made.certificate;
  std::vector<bool> is_free(c.grid.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = c.region[i] == Region::free;
  SurveyOptions sampled;
  sampled.samples = options.samples;
  sampled.seed = options.seed;
  made.survey = survey(c.flow(), is_free, parts, c.verdicts, prover, c.least_speed_mps(), sampled,
                       undecided.gatherer());
}

double share_of(const std::array<double, verdict_count>& shares, Verdict verdict) {
  return shares[static_cast<std::size_t>(verdict)];
}

}  // namespace

const char* reason_of(Trouble why) {
  switch (why) {
    case Trouble::gave_up:
      return "opposing commands: too many ways to turn";
    case Trouble::no_progress:
      return "no direction in which all move on";
    case Trouble::none:
    case Trouble::waits:
    case Trouble::mixed:
      break;
  }
  return "some behaviours may end otherwise than others";
}

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
  if (earlier != nullptr) require_same_proof(*earlier, c);
  // Where most states are undecided, a search in each takes too long.
  const bool search = options.find_witnesses && wild_share(plan, contract) <= most_wild_unwarned;

  constexpr double share_of_the_proof = 0.8;
  const Stopwatch watch;
  const double limit_s = options.limits.time_limit_s;
  InclusionLimits limits;
  limits.memory_bytes =
      static_cast<std::size_t>(options.limits.memory_limit_mb.value_or(0.0) * 1e6);
  limits.go_on = [&] { return watch.is_within(search ? share_of_the_proof * limit_s : limit_s); };
  if (earlier != nullptr) {
    // One finer than before, down to the finest that leaves are cut to.
    constexpr int finest = std::bit_width(side_units) - 1;
    const int next = finest_level(earlier->certificate.verdicts) + 1;
    limits.last_level = std::clamp(next, limits.last_level, finest);
  }
  const Parts parts = c.parts();
  InclusionProver prover(parts, limits);
  if (earlier != nullptr) prover.start_from(earlier->certificate.verdicts);
  bool in_time = true;  // to prove the earlier leaves again
  made.stopped_by_limit = !prover.run([&](const InclusionLevel& level) {
    if (made.levels.empty()) in_time = limits.go_on();
    made.levels.push_back(level);
    progress(fmt::format("verifying under the contract, {:.1f} % of sides undecided",
                         100.0 * level.undecided_share));
  });
  const double proof_s = watch.seconds();
  c.verdicts = prover.verdicts(c.least_speed_mps());
  if (earlier != nullptr) made.resumed = taken_over(*earlier, c.verdicts, in_time);
  progress("measuring shares of states");
  UndecidedStates undecided;
  measure(parts, prover, options, undecided, made);
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
  if (region.kind == RegionOfInterest::Kind::goal) {
    SurveyOptions sampled;
    sampled.samples = options.samples;
    sampled.seed = options.seed;
    made.following = prove_following(
        plan, over_ground(contract), c.parts_per_cell, sampled,
        [&] { return watch.is_within(limit_s); }, progress);
  }
  return made;
}

json contract_verification_json(const ContractVerification& made) {
  const ContractCertificate& c = made.certificate;
  json summary = json::parse(record_text(c));
  summary["method"] = "contract";
  summary["cells"] = {c.grid.nx, c.grid.ny};
  summary["leaves"] = c.verdicts.leaves();
  if (made.following) summary["follow"] = following_json(*made.following);
  return summary;
}

std::vector<Finding> findings(const Plan& plan, const ContractVerification& made) {
  const ContractShares& s = made.survey.shares;
  const int decimals = decimals_of_sample(s.samples);
  const bool is_goal = made.certificate.region_of_interest.kind == RegionOfInterest::Kind::goal;
  const std::string goal = is_goal ? goal_word(plan) : "region";
  constexpr const char* all = "all states";
  std::vector<Finding> found{
      {percent_text(share_of(s.all, Verdict::reach), decimals), all,
       "are proved to reach the " + goal + " whatever the vehicle does within its contract"}};
  if (is_goal) {
    for (Finding& finding : plan_findings(plan)) found.push_back(std::move(finding));
  }
  const auto add = [&](double share, const std::string& what) {
    if (share > 0.0) found.push_back({percent_text(share, decimals), all, what});
  };
  add(share_of(s.all, Verdict::collide), "are proved to collide, whatever it does");
  add(s.at_risk, "are at risk: a behaviour within the contract fails");
  add(share_of(s.all, Verdict::leave), "are proved to leave the map, whatever it does");
  add(share_of(s.all, Verdict::trapped), "are proved to be trapped: they circle for ever");
  add(share_of(s.all, Verdict::undecided) - s.at_risk, "are undecided");
  if (made.stopped_by_limit) found.push_back({"", "", "the proof stopped at its limit"});
  if (share_of(s.free, Verdict::reach) > 0.0) {
    found.push_back({percent_text(share_of(s.free, Verdict::reach), decimals), "safe starts",
                     "are proved to reach the " + goal});
  }
  if (made.following) {
    for (Finding& finding : findings(*made.following)) found.push_back(std::move(finding));
  }
  return found;
}

std::optional<std::string> limit_warning(const ContractVerification& made) {
  std::string words;
  if (made.stopped_by_limit) {
    words =
        "The proof under the contract stopped at its limit of time or memory: raise the limit, or "
        "a share of the states stays undecided.";
  }
  if (made.searched_states < made.undecided_states) {
    words += fmt::format(
        "{}The limit of time left no time to search for behaviours that fail from all undecided "
        "states: {}.",
        words.empty() ? "" : " ",
        made.searched ? fmt::format("the share at risk is that of {} of {}",
                                    grouped(made.searched_states), grouped(made.undecided_states))
                      : "which of them are at risk is not known");
  }
  return words.empty() ? std::nullopt : std::optional(std::move(words));
}

std::string contract_notes(const ContractVerification& made) {
  const ContractShares& s = made.survey.shares;
  std::string words = fmt::format(
      "The vehicle {}.\nShares of {} sampled states, each proved or flown; a map that does not "
      "change.",
      contract_words(made.certificate.contract), grouped(s.samples));
  if (s.worst_time_s > 0.0) {
    words +=
        fmt::format("\nNo sampled state that reaches takes longer than {:.1f} s.", s.worst_time_s);
  }
  const std::size_t shown = std::min<std::size_t>(made.survey.chokes.size(), 5);
  for (std::size_t i = 0; i < shown; ++i) {
    const Choke& choke = made.survey.chokes[i];
    const Vec2 at = made.certificate.grid.center(choke.cell);
    words += fmt::format("\n{}{} of all states wait for ({:g}, {:g}): {}",
                         i == 0 ? "What is not proved hangs on few places:\n" : "",
                         percent_text(choke.share, 2), at.x, at.y, reason_of(choke.why));
  }
  return words;
}

}  // namespace fairway
