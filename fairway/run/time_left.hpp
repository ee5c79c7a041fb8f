// When a proof will end, as far as its levels tell, and the words for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/run/progress.hpp"

namespace fairway {

/// The undecided share against time: near enough a straight line in logarithms, for a level takes
/// longer than the one before by about the same factor as it leaves less. One level may decide
/// nothing and the next half of what was left: the line goes through the last few. It bends, in
/// practice, so that estimates grow by a half or so as the work goes on.
class UndecidedTrend {
 public:
  explicit UndecidedTrend(double undecided_max) : undecided_max_(undecided_max) {}

  /// After a level: seconds from the start of the proof, growing, and the share left undecided.
  void add(double at_s, double undecided);

  /// Seconds from the start at which undecided_max will be met; nothing when that cannot be told:
  /// after less than three levels, when the share hardly falls, or when it would be so far away
  /// that the line does not reach there.
  [[nodiscard]] std::optional<double> end_s() const;

 private:
  struct Point {
    double log_at;
    double log_share;
  };
  double undecided_max_;
  std::vector<Point> points_;
};

/// ", about 40 s left", ", time limit in 12 s" or "": what will end the work first. `since_s`:
/// seconds since `left` was told.
[[nodiscard]] std::string time_left_words(const TimeLeft& left, double since_s);

/// "40 s", "2 min 05 s"; whole seconds, upwards.
[[nodiscard]] std::string duration_text(double seconds);

/// When a line is due after `so_far_s` of work where nobody watches a terminal: after 10 s, then at
/// twice the time each, and at last every ten minutes.
[[nodiscard]] double next_line_s(double so_far_s);

}  // namespace fairway
