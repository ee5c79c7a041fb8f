// Progress of a long run on stderr: the stage, the time so far and the time left. On a terminal one
// line is rewritten; elsewhere (in a log, for example) a new line is printed now and then.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
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

  /// The callback to pass to the work; empty when nothing is shown.
  Progress progress();

 private:
  using Clock = std::chrono::steady_clock;
  void show_until_done();
  void log_until_done();
  std::string line(Clock::time_point now, const char* between) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::string stage_;
  TimeLeft left_;
  Clock::time_point updated_;  // when `left_` was set
  Clock::time_point begin_ = Clock::now();
  std::thread thread_;  // joinable only when something is shown
};

}  // namespace fairway
