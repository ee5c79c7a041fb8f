#include "fairway/run/verification_summary.hpp"

#include <fmt/format.h>

#include "fairway/certificate/certificate_file.hpp"
#include "fairway/run/version.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// The assumptions of proof_assumptions() that a reader of results needs.
constexpr const char* assumed =
    "Assumed: the exact kinematic model, without wind or delay, and a map that does not change.";

std::string percent(double share) { return fmt::format("{:.3f} %", 100.0 * share); }

double share_of(const std::array<double, verdict_count>& volume, Verdict verdict) {
  return volume[static_cast<std::size_t>(verdict)];
}

/// Places that the goal cannot be reached from count against no plan.
std::string commanded_words(const VolumeFractions& volume) {
  const double reach = share_of(volume.commanded, Verdict::reach);
  if (percent(reach) == percent(share_of(volume.free, Verdict::reach))) return "";
  return fmt::format(" ({} of those in cells from which the goal can be reached)", percent(reach));
}

/// "90.000 % reach, 5.000 % collide, ...; 0.200 % are undecided".
std::string shares_words(const std::array<double, verdict_count>& volume) {
  std::string words;
  for (const Verdict verdict : verdicts_in_order) {
    if (verdict == Verdict::undecided) continue;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", percent(share_of(volume, verdict)),
                         words_of(verdict));
  }
  return words + fmt::format("; {} are undecided", percent(share_of(volume, Verdict::undecided)));
}

const char* words_of(StoppedBy reason) {
  switch (reason) {
    case StoppedBy::time_limit:
      return " The time limit ended the work.";
    case StoppedBy::memory_limit:
      return " The memory limit ended the work.";
    case StoppedBy::last_level:
      return " The finest leaves ended the work.";
    case StoppedBy::stalled:
      return " Smaller leaves had stopped deciding more.";
    case StoppedBy::undecided_max:
      break;
  }
  return "";
}

}  // namespace

json shares_json(const std::array<double, verdict_count>& share) {
  json by_name = json::object();
  for (const Verdict verdict : verdicts_in_order) {
    by_name[name_of(verdict)] = share_of(share, verdict);
  }
  return by_name;
}

json verification_json(const Verification& v) {
  const Certificate& c = v.certificate;
  json summary = json::parse(record_text(c));
  summary["volume_fraction_free_commanded"] = shares_json(v.outcome.volume.commanded);
  summary["method"] = "certified";
  summary["cells"] = {c.grid.nx, c.grid.ny};
  summary["leaves"] = c.sections.leaves();
  return summary;
}

std::string verification_words(const Verification& v) {
  const VolumeFractions& volume = v.outcome.volume;
  std::string words = fmt::format(
      "Proved for every heading and place: of the safe-start states {} reach{}, of all states "
      "outside obstacles and target {} (shares of volume, from {} sampled states, each proved).",
      percent(share_of(volume.free, Verdict::reach)), commanded_words(volume),
      shares_words(volume.all), volume.samples);
  if (volume.worst_time_s > 0.0) {
    words += fmt::format(" No sampled state that reaches takes longer than {:.1f} s.",
                         volume.worst_time_s);
  }
  return words + words_of(v.outcome.stopped_by) + " " + assumed;
}

const std::vector<std::string>& proof_assumptions() {
  static const std::vector<std::string> sentences{
      "The vehicle follows the model: constant speed, exact turns at the turning radius towards "
      "the commanded heading, exact position and heading. No wind, no delay.",
      "The map is static and right; an obstacle is the cells that the plan calls so.",
      "The processor computes IEEE 754 doubles and the compiler does not reorder floating-point "
      "operations."};
  return sentences;
}

std::string level_words(const LevelRecord& level) {
  return fmt::format("verifying, {:.2f} % undecided", 100.0 * level.undecided_volume);
}

}  // namespace fairway
