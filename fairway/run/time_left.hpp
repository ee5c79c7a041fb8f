// Estimates when a proof will end from its levels, and puts it into words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/run/progress.hpp"

namespace fairway {

/// From levels that are done to those that are left: each leaves about the same part of what was
/// undecided, and takes longer than the one before by about the same factor. Single levels do
/// neither, so both are taken over the last few; a guess, then, that may be off by half.
class UndecidedTrend {
 public:
  explicit UndecidedTrend(double undecided_max) : undecided_max_(undecided_max) {}

  /// After a level: seconds from the start of the proof, growing, and the share left undecided.
  void add(double at_s, double undecided);

  /// Seconds from the start at which the level will end that meets undecided_max; nothing when that
  /// cannot be estimated: after less than three levels, when the share hardly falls, or when it
  /// would be more than ten times as far as what is done.
  [[nodiscard]] std::optional<double> end_s() const;

 private:
  struct Level {
    double at_s;
    double log_share;
  };
  struct Pace {
    double took_s;  ///< the last level, by the trend
    double growth;  ///< factor to the next
  };
  [[nodiscard]] std::optional<Pace> pace() const;

  double undecided_max_;
  std::vector<Level> levels_;
};

/// ", about 40 s left", ", time limit in 12 s" or "": what will end the work first. `since_s`:
/// seconds since `left` was reported.
[[nodiscard]] std::string time_left_words(const TimeLeft& left, double since_s);

/// "40 s", "2 min 05 s"; whole seconds, upwards.
[[nodiscard]] std::string duration_text(double seconds);

/// When the next line is due after `so_far_s` of work without a terminal: after 10 s, then at
/// twice the time each, and at last every ten minutes.
[[nodiscard]] double next_line_s(double so_far_s);

}  // namespace fairway
