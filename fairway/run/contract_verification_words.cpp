// What is told of a proof under a contract.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {
namespace {

using nlohmann::json;

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

json contract_verification_json(const ContractCertificate& c) {
  json summary = json::parse(record_text(c));
  summary["method"] = "contract";
  summary["cells"] = {c.grid.nx, c.grid.ny};
  summary["leaves"] = c.verdicts.leaves();
  if (c.follow) summary["follow"] = following_json(*c.follow);
  return summary;
}

std::vector<Finding> findings(const Plan& plan, const ContractVerification& made) {
  const ContractShares& s = made.survey.shares;
  const int decimals = decimals_of_sample(s.samples);
  const bool is_goal = made.certificate.region_of_interest.kind == RegionOfInterest::Kind::goal;
  const std::string goal = is_goal ? goal_word(plan) : "region";
  constexpr const char* all = "all states";
  const bool holds = made.following && made.certificate.follow->hold;
  const std::string proved = holds            ? "are proved to reach the goal and to stay there"
                             : made.following ? "are proved to join the path and to follow it"
                                              : proved_to_reach(goal);
  const bool exact = is_exact(made.certificate);
  const std::string ever =
      made.following && made.certificate.follow->path.closed ? " for ever" : "";
  const std::string whatever = exact ? "" : ", whatever it does";
  std::vector<Finding> found;
  if (made.no_tube) found.push_back(no_tube_finding());
  found.push_back({percent_text(share_of(s.all, Verdict::reach), decimals), all,
                   proved + ever +
                       (exact ? ""
                              : std::string(ever.empty() ? "" : ",") +
                                    " whatever the vehicle does within its contract")});
  if (const std::size_t modes = s.reach_by_mode.size(); modes > 1) {
    found.push_back({percent_text(s.reach_by_mode.front(), decimals), all,
                     fmt::format("do so by the plan's own field, the rest by {}",
                                 plural(modes - 1, "further mode"))});
  }
  if (is_goal || made.following) {
    for (Finding& finding : plan_findings(plan)) found.push_back(std::move(finding));
  }
  const auto add = [&](double share, const std::string& what) {
    if (share > 0.0) found.push_back({percent_text(share, decimals), all, what});
  };
  add(share_of(s.all, Verdict::hold), "are proved to hold" + whatever);
  add(share_of(s.all, Verdict::collide), "are proved to collide" + whatever);
  add(s.at_risk, exact ? "are at risk: a flight is known that fails"
                       : "are at risk: a behaviour within the contract fails");
  add(share_of(s.all, Verdict::leave), "are proved to leave the map" + whatever);
  add(share_of(s.all, Verdict::trapped), "are proved to be trapped: they circle for ever");
  add(share_of(s.all, Verdict::undecided) - s.at_risk, "are undecided");
  if (made.stopped_by_limit) found.push_back({"", "", "the proof stopped at its limit"});
  if (share_of(s.free, Verdict::reach) > 0.0) {
    found.push_back(
        {percent_text(share_of(s.free, Verdict::reach), decimals), "safe starts", proved});
  }
  if (made.following) {
    const double usable = share_of(s.usable, Verdict::reach);
    found.push_back({percent_text(usable, decimals_of_sample(s.usable_samples)),
                     "states that the mission can use", proved});
    for (Finding& finding : findings(*made.certificate.follow)) {
      found.push_back(std::move(finding));
    }
  }
  return found;
}

Finding no_tube_finding() {
  return {
      "", "",
      "no tube is proved that the vehicle never leaves again: the shares say only that the path, "
      "or the goal, is touched"};
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
      "{}.\nShares of {} sampled states, each proved or flown; a map that does not "
      "change.",
      is_exact(made.certificate) ? "The vehicle flies as the model says, give or take 0.001 rad"
                                 : "The vehicle " + contract_words(made.certificate.contract),
      grouped(s.samples));
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
