// What an attack says while it goes on, and how it is told to end: a line on stderr every few
// seconds; after an interrupt (SIGINT) it ends soon, with the totals so far.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace fairway {

/// From now on an interrupt is noted; the second one kills.
void note_interrupts();
[[nodiscard]] bool is_interrupted();

/// Told how many flights are done and how many of them contradict; false: end now. Called by one
/// thread at a time.
using AttackProgress = std::function<bool(std::uint64_t flights, std::uint64_t wrong)>;
inline bool go_on_silently(std::uint64_t, std::uint64_t) { return true; }

/// Prints "NAME: N flights, R a second, W wrong" every few seconds, however many there are of these
/// one after another.
class ProgressLines {
 public:
  explicit ProgressLines(std::string name);
  bool operator()(std::uint64_t flights, std::uint64_t wrong);

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  Clock::time_point begun_ = Clock::now();
};

}  // namespace fairway
