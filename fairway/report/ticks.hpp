// Round numbers along an axis: steps of 1, 2 or 5 times a power of ten.
#pragma once

#include <string>
#include <vector>

namespace fairway {

struct Ticks {
  double step = 1.0;
  std::vector<double> values;  ///< rising, all within the range asked for
};

/// About `wanted` >= 1 ticks (at most 2.5 times as many) in low <= high, finite. An empty range has
/// one tick at most.
[[nodiscard]] Ticks ticks_between(double low, double high, int wanted);

/// With as many decimals as the step needs; in scientific notation where there would be too many.
[[nodiscard]] std::string tick_label(double value, double step);

/// The largest 1, 2 or 5 times a power of ten that is at most `length` > 0.
[[nodiscard]] double round_length_below(double length);

}  // namespace fairway
