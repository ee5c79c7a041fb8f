#include "fairway/app/terminal_progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace fairway {
namespace {

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.0f} s", std::ceil(seconds));
  return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet) {
  if (!quiet && ::isatty(STDERR_FILENO) == 1) {
    thread_ = std::thread([this] { show_until_done(); });
  }
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
  return [this](std::string_view stage, double left_s) {
    const std::scoped_lock lock(mutex_);
    stage_ = stage;
    end_estimate_.reset();
    if (left_s < 0.0) return;
    end_estimate_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(std::min(left_s, 1e6)));
  };
}

void TerminalProgress::show_until_done() {
  constexpr auto step = std::chrono::milliseconds(200);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, step, [this] { return done_; })) {
    const auto now = Clock::now();
    const double so_far_s = std::chrono::duration<double>(now - begin_).count();
    std::string left;
    if (end_estimate_) {
      const double left_s = std::chrono::duration<double>(*end_estimate_ - now).count();
      left = left_s > 1.0 ? ", about " + duration(left_s) + " left" : ", almost done";
    }
    fmt::print(stderr, "\r\033[K{}  {} so far{}", stage_, duration(so_far_s), left);
    std::fflush(stderr);
  }
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace fairway
