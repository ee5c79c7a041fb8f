#include "fairway/verify/certify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "fairway/verify/prove_modes.hpp"
#include "fairway/verify/prover.hpp"
#include "fairway/verify/undecided_sections.hpp"
#include "fairway/verify/volume_meter.hpp"

namespace fairway {
namespace {

using Clock = std::chrono::steady_clock;

/// The last levels decided almost nothing, or little for many more leaves: smaller leaves do not
/// make the rest any easier.
bool has_stalled(const std::vector<LevelRecord>& levels, int without_gain) {
  const auto since = [&](std::size_t n, double share, double growth) {
    if (levels.size() <= n) return false;
    const LevelRecord& then = levels[levels.size() - 1 - n];
    const LevelRecord& now = levels.back();
    return now.undecided_volume > share * then.undecided_volume &&
           static_cast<double>(now.undecided) > growth * static_cast<double>(then.undecided);
  };
  return since(static_cast<std::size_t>(without_gain), 0.999, 0.0) || since(3, 0.95, 3.0);
}

}  // namespace

const char* name_of(StoppedBy reason) {
  switch (reason) {
    case StoppedBy::undecided_max:
      return "undecided_max";
    case StoppedBy::time_limit:
      return "time_limit";
    case StoppedBy::memory_limit:
      return "memory_limit";
    case StoppedBy::last_level:
      return "last_level";
    case StoppedBy::stalled:
      return "stalled";
  }
  return "";
}

Certified certify(const Flow& flow, const std::vector<bool>& is_free, const CertifyOptions& options,
                  SectionVerdicts start, const CertifyProgress& progress,
                  std::span<const float* const> further_rad) {
  const auto began = Clock::now();
  const auto go_on = [&] {
    return options.time_limit_s <= 0.0 ||
           std::chrono::duration<double>(Clock::now() - began).count() < options.time_limit_s;
  };
  if (start.first.empty()) start = undecided_sections(flow, options.first_level);
  VolumeMeter meter(flow, is_free, options, !further_rad.empty());
  Prover prover(flow, start, options.most_crossings, go_on);
  start = {};
  Certified answer;
  for (int level = options.first_level;; ++level) {
    const double least_units = std::ldexp(1.0, 32 - level);
    const bool settled = prover.settle(least_units);
    answer.volume = meter.measure(prover);
    answer.levels.push_back(
        {level, prover.graph().leaves(), prover.graph().undecided(), answer.volume.all[0]});
    if (progress) progress(answer.levels.back());
    if (answer.volume.all[0] <= options.undecided_max) {
      answer.stopped_by = StoppedBy::undecided_max;
    } else if (!settled) {
      answer.stopped_by = StoppedBy::time_limit;
    } else if (options.memory_limit_bytes > 0 &&
               2 * prover.bytes() + meter.bytes() > options.memory_limit_bytes) {
      answer.stopped_by = StoppedBy::memory_limit;
    } else if (level >= options.last_level) {
      answer.stopped_by = StoppedBy::last_level;
    } else if (has_stalled(answer.levels, options.stall_levels)) {
      answer.stopped_by = StoppedBy::stalled;
    } else {
      continue;
    }
    answer.sections = prover.into_sections();
    break;
  }
  if (!further_rad.empty()) prove_modes(flow, further_rad, options, go_on, meter, answer);
  return answer;
}

}  // namespace fairway
