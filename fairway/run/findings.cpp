#include "fairway/run/findings.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* all_states = "all states";
constexpr const char* usable_states = "states that the mission can use";
constexpr const char* commanded_starts = "safe starts with a command";

double share_of(const std::array<double, verdict_count>& volume, Verdict verdict) {
  return volume[static_cast<std::size_t>(verdict)];
}

/// What the states of this verdict do.
std::string done_by_states(Verdict verdict, const std::string& goal) {
  switch (verdict) {
    case Verdict::reach:
      return proved_to_reach(goal);
    case Verdict::follow:
      return "are proved to follow the " + goal;
    case Verdict::hold:
      return "are proved to hold: they circle for ever in a holding place, clear of obstacles";
    case Verdict::leave:
      return "are proved to leave the map";
    case Verdict::trapped:
      return "are proved to be trapped: they circle for ever";
    case Verdict::undecided:
      return "are undecided";
    case Verdict::collide:
      break;
  }
  return "are proved to collide";
}

std::string after(const char* mark, const std::string& words) {
  return words.empty() ? words : mark + words;
}

Finding random_finding(const OutcomeCounts& counts) {
  const SampledShare range = sampled_share(counts.of(Outcome::reach), counts.total());
  return {range.share, commanded_starts,
          fmt::format("reach in {} ({}){}", plural(counts.total(), "random flight"), range.interval,
                      after("; ", failure_words(counts)))};
}

Finding given_finding(const OutcomeCounts& counts, const std::string& goal) {
  const std::size_t reach = counts.of(Outcome::reach);
  return {grouped(reach), plural(counts.total(), "given start"),
          fmt::format("reach{} the {}{}", reach == 1 ? "es" : "", goal,
                      after(": ", failure_words(counts)))};
}

/// More than a tenth of the free cells.
bool is_mostly_cut_off(const RegionCells& cells) {
  constexpr std::size_t one_in = 10;
  return cells.free < one_in * cells.unreachable;
}

}  // namespace

std::string goal_of(const Plan& plan, const RegionOfInterest& region) {
  return region.kind == RegionOfInterest::Kind::goal ? goal_word(plan) : "region";
}

std::string proved_to_reach(const std::string& goal) {
  return (goal == "path" ? "are proved to touch the " : "are proved to reach the ") + goal;
}

std::vector<Finding> plan_findings(const Plan& plan) {
  const RegionCells cells = count_regions(plan);
  if (cells.unreachable == 0) return {};
  const std::size_t circles = plan.record.holding_places.size();
  return {{percent_text(cells.unreachable, cells.free), "free cells",
           fmt::format("are cut off from the {}, {} ({} of {})", goal_word(plan),
                       circles == 0 ? "without a command"
                                    : "with commands to " + plural(circles, "holding place"),
                       grouped(cells.unreachable), grouped(cells.free))}};
}

std::vector<Finding> findings(const Plan& plan, const Verification& v) {
  const VolumeFractions& volume = v.outcome.volume;
  const int decimals = decimals_of_sample(volume.samples);
  const std::string goal = goal_of(plan, v.certificate.region_of_interest);
  const auto line = [&](const auto& shares, Verdict verdict, const char* of) {
    return Finding{percent_text(share_of(shares, verdict), decimals), of,
                   done_by_states(verdict, goal)};
  };
  const bool is_goal = v.certificate.region_of_interest.kind == RegionOfInterest::Kind::goal;
  // Where much is cut off, as outside the walls of a race track, shares of all states say little.
  const bool of_usable = is_goal && is_mostly_cut_off(count_regions(plan));
  const auto& counted = of_usable ? volume.usable : volume.all;
  const char* of = of_usable ? usable_states : all_states;
  std::vector<Finding> found{line(counted, Verdict::reach, of)};
  if (const std::size_t modes = volume.reach_by_mode.size(); modes > 1 && !of_usable) {
    found.push_back({percent_text(volume.reach_by_mode.front(), decimals), of,
                     fmt::format("do so by the plan's own field, the rest by {}",
                                 plural(modes - 1, "further mode"))});
  }
  if (is_goal) {
    for (Finding& finding : plan_findings(plan)) found.push_back(std::move(finding));
  }
  for (const Verdict verdict : verdicts_in_order) {
    if (verdict == Verdict::reach || share_of(counted, verdict) <= 0.0) continue;
    found.push_back(line(counted, verdict, of));
  }
  if (const std::string words = stopped_words(v); !words.empty()) found.push_back({"", "", words});
  const auto some = [](double share) { return share > 0.0; };
  if (std::any_of(volume.commanded.begin(), volume.commanded.end(), some)) {
    found.push_back(line(volume.commanded, Verdict::reach, commanded_starts));
  }
  return found;
}

std::vector<Finding> findings(const Plan& plan, const BitmapVerification& v) {
  std::vector<Finding> found{
      {estimated_reach_text(v), all_states, "reach, estimated from border samples (not a proof)"}};
  for (Finding& finding : plan_findings(plan)) found.push_back(std::move(finding));
  return found;
}

std::vector<Finding> findings(const Plan& plan, const ScenarioFlights& flown) {
  std::vector<Finding> found;
  const OutcomeCounts random = count_outcomes(flown.random_results());
  const OutcomeCounts given = count_outcomes(flown.given_results());
  if (random.total() > 0) found.push_back(random_finding(random));
  if (given.total() > 0) found.push_back(given_finding(given, goal_word(plan)));
  return found;
}

json findings_json(const std::vector<Finding>& findings) {
  json lines = json::array();
  for (const Finding& finding : findings) {
    lines.push_back({{"share", finding.share}, {"of", finding.of}, {"what", finding.what}});
  }
  return lines;
}

std::string findings_table(const std::vector<Finding>& findings) {
  std::size_t share_width = 0;
  std::size_t of_width = 0;
  for (const Finding& finding : findings) {
    share_width = std::max(share_width, finding.share.size());
    of_width = std::max(of_width, finding.of.size());
  }
  std::string text;
  for (const Finding& finding : findings) {
    text += finding.of.empty()
                ? fmt::format("{:>{}}  {}\n", finding.share, share_width, finding.what)
                : fmt::format("{:>{}}  of {:<{}}  {}\n", finding.share, share_width, finding.of,
                              of_width, finding.what);
  }
  return text;
}

}  // namespace fairway
