#include "tests/falsify/progress.hpp"

#include <csignal>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

namespace fairway {
namespace {

constexpr double told_every_s = 5.0;

volatile std::sig_atomic_t interrupted = 0;

extern "C" void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void note_interrupts() { std::signal(SIGINT, note_interrupt); }

bool is_interrupted() { return interrupted != 0; }

ProgressLines::ProgressLines(std::string name) : name_(std::move(name)) {}

bool ProgressLines::operator()(std::uint64_t flights, std::uint64_t wrong) {
  const Clock::time_point now = Clock::now();
  static Clock::time_point told = begun_;
  const std::chrono::duration<double> since = now - told;
  if (since.count() >= told_every_s) {
    told = now;
    const std::chrono::duration<double> all = now - begun_;
    fmt::print(stderr, "{}: {} flights, {:.0f} a second, {} wrong\n", name_, flights,
               static_cast<double>(flights) / all.count(), wrong);
    std::fflush(stderr);
  }
  return !is_interrupted();
}

}  // namespace fairway
