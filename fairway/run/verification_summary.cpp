#include "fairway/run/verification_summary.hpp"

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;

double share_of(const std::array<double, verdict_count>& volume, Verdict verdict) {
  return volume[static_cast<std::size_t>(verdict)];
}

const char* goal_or_region(const Verification& v) {
  const bool is_goal = v.certificate.region_of_interest.kind == RegionOfInterest::Kind::goal;
  return is_goal ? "goal" : "region";
}

/// Why the proof stopped before its aim was met; empty when it was met.
std::string end_of_work(const Verification& v) {
  switch (v.outcome.stopped_by) {
    case StoppedBy::time_limit:
      return fmt::format("the proof stopped at the time limit of {:g} s", v.options.time_limit_s);
    case StoppedBy::memory_limit:
      return fmt::format("the proof stopped at the memory limit of {:g} MB",
                         static_cast<double>(v.options.memory_limit_bytes) / 1e6);
    case StoppedBy::last_level:
      return "the proof stopped at the finest refinement level";
    case StoppedBy::stalled:
      return "the proof stopped because further refinement decided no more states";
    case StoppedBy::undecided_max:
      break;
  }
  return "";
}

/// "91.0 % reach, 8.7 % collide, 0 % leave, 0 % are trapped, 0.3 % are undecided".
std::string shares_words(const std::array<double, verdict_count>& volume, int decimals) {
  std::string words;
  for (const Verdict verdict : verdicts_in_order) {
    if (!is_listed(verdict, share_of(volume, verdict) > 0.0)) continue;
    const bool is_state = verdict == Verdict::trapped || verdict == Verdict::undecided;
    words += fmt::format("{}{} {}{}", words.empty() ? "" : ", ",
                         percent_text(share_of(volume, verdict), decimals), is_state ? "are " : "",
                         name_of(verdict));
  }
  return words;
}

}  // namespace

json shares_json(const std::array<double, verdict_count>& share) {
  json by_name = json::object();
  for (const Verdict verdict : verdicts_in_order) {
    const double its = share_of(share, verdict);
    if (is_listed(verdict, its > 0.0)) by_name[name_of(verdict)] = its;
  }
  return by_name;
}

json verification_json(const Verification& v) {
  const Certificate& c = v.certificate;
  json summary = json::parse(record_text(c));
  summary["volume_fraction_free_commanded"] = shares_json(v.outcome.volume.commanded);
  summary["volume_fraction_usable"] = shares_json(v.outcome.volume.usable);
  summary["method"] = "certified";
  summary["cells"] = {c.grid.nx, c.grid.ny};
  summary["leaves"] = c.sections.leaves();
  if (c.further_modes() > 0) summary["mode_leaves"] = c.mode_sections.leaves();
  return summary;
}

std::string stopped_words(const Verification& v) {
  const std::string end = end_of_work(v);
  if (end.empty()) return end;
  const double undecided = share_of(v.outcome.volume.all, Verdict::undecided);
  // Of the first mode that was enough: the limit cut the further ones short.
  if (undecided <= v.options.undecided_max && v.certificate.further_modes() > 0) {
    return fmt::format("{}: what further modes would add is not all proved", end);
  }
  return fmt::format("{}: {} undecided (requested: at most {:g} %)", end,
                     percent_text(undecided, decimals_of_sample(v.outcome.volume.samples)),
                     100.0 * v.options.undecided_max);
}

std::optional<std::string> limit_warning(const Verification& v) {
  const StoppedBy by = v.outcome.stopped_by;
  if (by != StoppedBy::time_limit && by != StoppedBy::memory_limit) return std::nullopt;
  std::string words = stopped_words(v);
  words.front() = 'T';
  return words + "; raise the limit, or continue with `fairway verify --resume`.";
}

std::string proof_notes(const Verification& v) {
  std::string words = fmt::format(
      "All states: every heading at every place outside obstacles and {}; shares of {} sampled "
      "states, each proved.\nAssumed: the exact model, without wind or delay, and a map that does "
      "not change.",
      goal_or_region(v), grouped(v.outcome.volume.samples));
  if (v.outcome.volume.worst_time_s > 0.0) {
    words += fmt::format("\nNo sampled state that reaches takes longer than {:.1f} s.",
                         v.outcome.volume.worst_time_s);
  }
  return words;
}

std::string verification_words(const Verification& v) {
  const VolumeFractions& volume = v.outcome.volume;
  const int decimals = decimals_of_sample(volume.samples);
  std::string words = fmt::format(
      "Proved for every heading and place: of all states outside obstacles and {}, {}; of safe "
      "starts, {} reach; of safe starts with a command, {} (shares of volume, from {} sampled "
      "states, each proved).",
      goal_or_region(v), shares_words(volume.all, decimals),
      percent_text(share_of(volume.free, Verdict::reach), decimals),
      percent_text(share_of(volume.commanded, Verdict::reach), decimals), grouped(volume.samples));
  if (volume.worst_time_s > 0.0) {
    words += fmt::format(" No sampled state that reaches takes longer than {:.1f} s.",
                         volume.worst_time_s);
  }
  std::string stopped = stopped_words(v);
  if (!stopped.empty()) {
    stopped.front() = 'T';
    words += " " + stopped + ".";
  }
  return words +
         " Assumed: the exact kinematic model, without wind or delay, and a map that does not "
         "change.";
}

const std::vector<std::string>& proof_assumptions() {
  static const std::vector<std::string> sentences{
      "The vehicle follows the model: constant speed, exact turns at the turning radius towards "
      "the commanded heading, exact position and heading. No wind, no delay.",
      "The map is static and correct; obstacles are the cells that the plan marks as such.",
      "The processor computes IEEE 754 doubles and the compiler does not reorder floating-point "
      "operations."};
  return sentences;
}

std::string level_words(const LevelRecord& level) {
  return fmt::format("verifying, {:.2f} % undecided", 100.0 * level.undecided_volume);
}

}  // namespace fairway
