#include "fairway/run/ceiling_summary.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"

namespace fairway {
namespace {

using nlohmann::json;

json bounds(const CeilingShare& share) { return {share.lower, share.upper}; }

// Rounded outwards.
std::string bounds_text(const CeilingShare& share) {
  return fmt::format("{} to {}", bound_text(share.lower, 1, -1), bound_text(share.upper, 1, +1));
}

Finding finding_of(const Ceiling& c, const ProvedShare& proved) {
  const std::string most = bound_text(c.all.upper, 1, +1);
  // Both are measured, each to its digits.
  constexpr double measured = 0.01;
  if (proved.of_all > c.all.upper + measured) {
    return {"", "",
            fmt::format("{} of all states {}, but no plan can keep more than {}: one of the two is "
                        "wrong, which is a fault of this program",
                        percent_text(proved.of_all, proved.decimals), proved.what, most)};
  }
  return {bound_text(share_of_ceiling(c, proved.of_all), proved.decimals, -1),
          "what any control could keep",
          fmt::format("is kept at least: {} of all states {}, and no plan can keep more than {}",
                      bound_text(proved.of_all, proved.decimals, -1), proved.what, most)};
}

}  // namespace

CeilingOptions ceiling_options(const VerifyLimits& limits) {
  CeilingOptions options;
  options.levels_max = 2;
  options.time_limit_s =
      limits.time_limit_s > 0.0 ? limits.time_limit_s : std::numeric_limits<double>::infinity();
  options.memory_limit_mb = limits.memory_limit_mb.value_or(options.memory_limit_mb);
  return options;
}

json json_of(const Ceiling& c) {
  return {{"ceiling", bounds(c.all)},
          {"ceiling_free", bounds(c.free)},
          {"ceiling_buffer", bounds(c.buffer)},
          {"cells", {c.grid.nx, c.grid.ny}},
          {"headings", c.headings},
          {"nodes_per_cell", c.nodes_per_cell},
          {"levels", c.levels},
          {"complete", c.complete}};
}

std::string words_of(const Ceiling& c) {
  std::string words;
  if (!c.complete) words = "A limit of time or memory came first. ";
  if (c.levels == 0) return words + "Nothing was found out.";
  return words + fmt::format(
                     "From {} of all states some control brings the vehicle to the "
                     "mission (safe starts {}, buffer {}); no plan can keep more.",
                     bounds_text(c.all), bounds_text(c.free), bounds_text(c.buffer));
}

double share_of_ceiling(const Ceiling& ceiling, double proved) {
  if (ceiling.all.upper <= 0.0) return 1.0;
  return std::min(1.0, proved / ceiling.all.upper);
}

ProvedShare proved_share(const Plan& plan, const Verification& made) {
  const VolumeFractions& volume = made.outcome.volume;
  return {volume.all[static_cast<std::size_t>(Verdict::reach)], decimals_of_sample(volume.samples),
          proved_to_reach(goal_of(plan, made.certificate.region_of_interest))};
}

std::optional<ProvedShare> proved_share(const Plan& plan, const ContractVerification& made) {
  if (made.following) return std::nullopt;
  const ContractShares& shares = made.survey.shares;
  return ProvedShare{shares.all[static_cast<std::size_t>(Verdict::reach)],
                     decimals_of_sample(shares.samples),
                     proved_to_reach(goal_of(plan, made.certificate.region_of_interest)) +
                         " whatever the vehicle does within its contract"};
}

void add_ceiling(json& summary, std::vector<Finding>& found, const Ceiling& c,
                 const ProvedShare& proved) {
  summary["ceiling"] = bounds(c.all);
  summary["ceiling_free"] = bounds(c.free);
  summary["ceiling_buffer"] = bounds(c.buffer);
  summary["ceiling_levels"] = c.levels;
  summary["share_of_ceiling"] = share_of_ceiling(c, proved.of_all);
  if (c.levels > 0 && c.all.upper > 0.0) found.push_back(finding_of(c, proved));
}

std::string words_of(const Ceiling& c, const ProvedShare& proved) {
  if (c.levels == 0 || c.all.upper <= 0.0) return words_of(c);
  const Finding kept = finding_of(c, proved);
  if (kept.share.empty()) return fmt::format("{} {}.", words_of(c), kept.what);
  return fmt::format("{} Of {} {} {}.", words_of(c), kept.of, kept.share, kept.what);
}

std::optional<std::string> limit_warning(const Ceiling& c) {
  if (c.complete) return std::nullopt;
  return c.levels == 0
             ? "What any control could keep is not known: a limit of time or memory came first."
             : "What any control could keep is known less closely than usual: a limit of time or "
               "memory came first.";
}

}  // namespace fairway
