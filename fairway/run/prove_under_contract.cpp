#include "fairway/run/prove_under_contract.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/run/checker.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verify_progress.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int most_tries = 2;

double share_of(const std::array<double, verdict_count>& shares, Verdict verdict) {
  return shares[static_cast<std::size_t>(verdict)];
}

const char* checked_words(bool checked) {
  return checked ? "an independent program re-proved the certificate"
                 : "the certificate was NOT checked: fairway-check could not be run";
}

std::string time_words(const ContractShares& shares) {
  if (!(shares.worst_time_s > 0.0)) return {};
  return fmt::format("no sampled state that reaches takes longer than {:.1f} s",
                     shares.worst_time_s);
}

}  // namespace

std::optional<ProvedUnderContract> prove_under_contract(const Plan& plan, const Scenario& scenario,
                                                        const RegionOfInterest& region,
                                                        const fs::path& place, StageClock& clock,
                                                        std::vector<std::string>& warnings) {
  const std::optional<VehicleContract> contract = contract_to_prove(plan, region);
  if (!contract || scenario.verify.method != VerifyMethod::certified) return std::nullopt;
  if (is_wild_everywhere(plan, *contract)) {
    // A warning about the plan has said how wide it is, and what would do.
    warnings.push_back(
        "Nothing was proved under the contract: it is too wide for this plan at every cell.");
    return std::nullopt;
  }
  const fs::path file = place / product::contract_certificate;
  ContractVerifyOptions options;
  options.limits = scenario.verify.limits;
  options.seed = scenario.simulate.seed;
  options.or_touch = plan.record.contract.has_value();
  ProvedUnderContract proved;
  CheckRun check;
  // The prover's sets of states and the checker's overlap, but neither holds the other. Of a
  // certificate with a leaf for which that matters, another one, of finer parts, may do.
  for (int tries = 0; tries < most_tries; ++tries) {
    proved.verification = verify_contract(plan, scenario.file.string(), region, *contract, options,
                                          begin_verifying_contract(clock, options.limits));
    const ContractVerification& made = proved.verification;
    if (made.no_tube && !options.or_touch) {
      warnings.push_back("Nobody is proved to follow the path: " + no_tube_finding().what + ".");
      return std::nullopt;
    }
    write_contract_certificate(made.certificate, file, Existing::keep);
    clock.begin("checking the contract's certificate", unknown_time);
    check = run_checker({file.string(), "--quiet"}, true);
    if (check.exit_code != 1) break;
    fs::remove(file);
    options.parts_per_cell = made.certificate.parts_per_cell + 1;
  }
  if (check.exit_code == 1) {
    warnings.push_back(
        "Under the contract nothing is claimed: the separate program refused the certificate, "
        "which is a fault of Fairway. It says: " +
        check.output.substr(0, check.output.find('\n')));
    return std::nullopt;
  }
  proved.checked = check.exit_code == 0;
  return proved;
}

std::vector<Finding> findings(const Plan& plan, const ProvedUnderContract& proved) {
  const ContractShares& s = proved.verification.survey.shares;
  const int decimals = decimals_of_sample(s.samples);
  std::vector<Finding> found;
  const auto add = [&](double share, const std::string& what) {
    found.push_back({percent_text(share, decimals), "all states", what});
  };
  const ContractVerification& made = proved.verification;
  const bool exact = is_exact(made.certificate);
  const std::string within = exact ? "" : " whatever the vehicle does within its contract";
  add(share_of(s.all, Verdict::reach),
      (made.following && made.certificate.follow->hold
           ? "are proved to reach the goal and to stay there for ever"
       : made.following ? "are proved to join the path and to follow it"
                        : proved_to_reach(goal_of(plan, made.certificate.region_of_interest))) +
          within);
  if (const double holding = share_of(s.all, Verdict::hold); holding > 0.0) {
    add(holding, "are proved to hold" + (exact ? "" : "," + within));
  }
  double failing = 0.0;
  for (const Verdict verdict : verdicts_in_order) {
    if (fails(verdict)) failing += share_of(s.all, verdict);
  }
  if (failing > 0.0) add(failing, "are proved to fail" + (exact ? "" : "," + within));
  if (s.at_risk > 0.0) {
    add(s.at_risk, exact ? "are at risk: a flight is known that fails"
                         : "are at risk: a behaviour within the contract fails");
  }
  const double undecided = std::max(0.0, share_of(s.all, Verdict::undecided) - s.at_risk);
  if (undecided > 0.0) {
    add(undecided, exact ? "are undecided: to follow or not" : "are undecided under the contract");
  }
  return found;
}

std::string notes_of(const ProvedUnderContract& proved) {
  const ContractVerification& made = proved.verification;
  const std::string time = time_words(made.survey.shares);
  std::string notes = fmt::format(
      "{} {}{}{}.\n", is_exact(made.certificate) ? "Of following the path:" : "Under the contract",
      time, time.empty() ? "" : "; ", checked_words(proved.checked));
  const std::size_t shown = std::min<std::size_t>(made.survey.chokes.size(), 2);
  for (std::size_t i = 0; i < shown; ++i) {
    const Choke& choke = made.survey.chokes[i];
    const Vec2 at = made.certificate.grid.center(choke.cell);
    notes += fmt::format("{}{} of all states wait for ({:g}, {:g}): {}.\n",
                         i == 0 ? "What is not proved hangs on few places: " : "",
                         percent_text(choke.share, 2), at.x, at.y, reason_of(choke.why));
  }
  return notes;
}

std::string words_of(const Plan& plan, const ProvedUnderContract& proved) {
  std::string words;
  for (const Finding& finding : findings(plan, proved)) {
    words += fmt::format("{} of {} {}. ", finding.share, finding.of, finding.what);
  }
  const ContractShares& s = proved.verification.survey.shares;
  const std::string time = time_words(s);
  return words + fmt::format("Shares of {} sampled states, each proved or flown; {}{}{}.",
                             grouped(s.samples), time, time.empty() ? "" : "; ",
                             checked_words(proved.checked));
}

std::optional<std::string> limit_warning(const ProvedUnderContract& proved) {
  return limit_warning(proved.verification);
}

json json_of(const ProvedUnderContract& proved) {
  json summary = contract_verification_json(proved.verification.certificate);
  summary["checked"] = proved.checked;
  return summary;
}

}  // namespace fairway
