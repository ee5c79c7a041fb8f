// Shares as people read them: no digit that the error does not bear, and nothing rounded away.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace fairway {

/// "1,234,567".
[[nodiscard]] std::string grouped(std::size_t n);

/// "2 flights", "1 flight".
[[nodiscard]] std::string plural(std::size_t n, const char* noun);

/// "97.0 %" of `share` in [0, 1]. What is not nothing, or not all, never reads as it: "< 0.1 %",
/// "> 99.9 %"; exactly nothing and all have no decimals: "0 %", "100 %".
[[nodiscard]] std::string percent_text(double share, int decimals = 1);

/// The bound of an interval, rounded outwards: `towards` -1 down, +1 up; what is not nothing, or
/// not all, never reads as it.
[[nodiscard]] std::string bound_text(double share, int decimals, int towards);

/// Counted, not sampled: one decimal.
[[nodiscard]] std::string percent_text(std::size_t part, std::size_t whole);

/// Decimals in per cent of a share measured on `samples` draws: a unit of the last is not finer
/// than the worst 95 % error of such a share, and never finer than a tenth (docs/proved.md).
[[nodiscard]] int decimals_of_sample(std::size_t samples);

/// Wilson's interval for a share seen `hits` times in `count` draws, 95 %.
[[nodiscard]] std::array<double, 2> wilson_interval(std::size_t hits, std::size_t count);

struct SampledShare {
  std::string share;     ///< "99.3 %"
  std::string interval;  ///< "99.1 % to 99.5 %", that of 95 %
};
/// A share seen in draws. Its last digit is the first that the interval's half has; the interval is
/// rounded outwards, but never up to all or down to nothing.
[[nodiscard]] SampledShare sampled_share(std::size_t hits, std::size_t count);

}  // namespace fairway
