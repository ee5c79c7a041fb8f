#include "fairway/app/terminal_progress.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "fairway/app/session.hpp"
#include "fairway/run/time_left.hpp"

namespace fairway {
namespace {

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet) {
  if (quiet) return;
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  thread_ = std::thread([this, terminal] { terminal ? show_until_done() : log_until_done(); });
}

TerminalProgress::~TerminalProgress() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

Progress TerminalProgress::progress() {
  if (!thread_.joinable()) return {};
  return [this](std::string_view stage, const TimeLeft& left) {
    const std::scoped_lock lock(mutex_);
    stage_ = stage;
    left_ = left;
    updated_ = Clock::now();
  };
}

std::string TerminalProgress::line(Clock::time_point now, const char* between) const {
  return fmt::format("{}{}{} so far{}", stage_, between,
                     duration_text(std::floor(seconds(now - begin_))),
                     time_left_words(left_, seconds(now - updated_)));
}

void TerminalProgress::show_until_done() {
  constexpr auto step = std::chrono::milliseconds(200);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, step, [this] { return done_; })) {
    fmt::print(stderr, "\r\033[K{}", line(Clock::now(), "  "));
    std::fflush(stderr);
  }
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void TerminalProgress::log_until_done() {
  std::unique_lock lock(mutex_);
  double due_s = next_line_s(0.0);
  const auto due = [&] {
    return begin_ +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
  };
  while (!changed_.wait_until(lock, due(), [this] { return done_; })) {
    complain("fairway: " + line(Clock::now(), ", "));
    due_s = next_line_s(seconds(Clock::now() - begin_));
  }
}

}  // namespace fairway
