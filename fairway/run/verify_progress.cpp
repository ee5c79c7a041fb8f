#include "fairway/run/verify_progress.hpp"

#include <algorithm>
#include <memory>

#include "fairway/run/time_left.hpp"
#include "fairway/run/verification_summary.hpp"

namespace fairway {

CertifyProgress begin_verifying(StageClock& clock, const CertifyOptions& options, double after_s) {
  const double limit_s = options.time_limit_s > 0.0 ? options.time_limit_s : unknown_time;
  clock.begin("verifying", TimeLeft{unknown_time, limit_s});
  auto trend = std::make_shared<UndecidedTrend>(options.undecided_max);
  return [&clock, trend, limit_s, after_s](const LevelRecord& level) {
    const double now_s = clock.seconds();
    trend->add(now_s, level.undecided_volume);
    TimeLeft left;
    if (const auto end_s = trend->end_s()) left.estimate_s = *end_s - now_s + after_s;
    if (limit_s >= 0.0) left.limit_s = std::max(0.0, limit_s - now_s);
    clock.rename(level_words(level));
    clock.tell(left);
  };
}

std::function<void(const std::string& doing)> begin_verifying_contract(StageClock& clock,
                                                                       const VerifyLimits& limits) {
  const double limit_s = limits.time_limit_s > 0.0 ? limits.time_limit_s : unknown_time;
  clock.begin("verifying under the contract", TimeLeft{unknown_time, limit_s});
  return [&clock, limit_s](const std::string& doing) {
    TimeLeft left;
    const bool is_limited = !doing.starts_with("measuring");
    if (limit_s >= 0.0 && is_limited) left.limit_s = std::max(0.0, limit_s - clock.seconds());
    clock.rename(doing);
    clock.tell(left);
  };
}

}  // namespace fairway
