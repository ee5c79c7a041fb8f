// Wall time per stage, and progress reports.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/run/progress.hpp"

namespace fairway {

class StageClock {
 public:
  explicit StageClock(const Progress& progress) : progress_(progress) {}

  /// Ends the stage before, begins this one. `left_s`: estimate for it and all that follow.
  void begin(const std::string& stage, double left_s) { begin(stage, TimeLeft{left_s}); }
  void begin(const std::string& stage, const TimeLeft& left) {
    end();
    stage_ = stage;
    told_.clear();
    begin_ = Clock::now();
    tell(left);
  }
  /// Another name for the stage under way, as it is reported; its time is kept under the old one.
  void rename(std::string told) { told_ = std::move(told); }
  void tell(double left_s) const { tell(TimeLeft{left_s}); }
  void tell(const TimeLeft& left) const {
    if (progress_) progress_(told_.empty() ? stage_ : told_, left);
  }
  /// Of the stage that is under way.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  void end() {
    if (!stage_.empty()) stages_.emplace_back(std::exchange(stage_, {}), seconds());
  }

  double total_s() const {
    double sum = 0.0;
    for (const auto& [stage, seconds] : stages_) sum += seconds;
    return sum;
  }
  nlohmann::json json() const {
    nlohmann::json by_stage = nlohmann::json::object();
    for (const auto& [stage, seconds] : stages_) by_stage[stage] = seconds;
    return by_stage;
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  std::string stage_;
  std::string told_;
  Clock::time_point begin_;
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace fairway
