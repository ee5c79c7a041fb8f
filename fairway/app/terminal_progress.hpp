// One line on a terminal's stderr: the stage, the time so far and the time left. Nothing when
// stderr is not a terminal.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "fairway/run/progress.hpp"

namespace fairway {

class TerminalProgress {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress();  ///< clears the line
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// What to hand to the work; empty when nothing is shown.
  Progress progress();

 private:
  using Clock = std::chrono::steady_clock;
  void show_until_done();

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::string stage_;
  Clock::time_point begin_ = Clock::now();
  std::optional<Clock::time_point> end_estimate_;
  std::thread thread_;  // joinable only when something is shown
};

}  // namespace fairway
