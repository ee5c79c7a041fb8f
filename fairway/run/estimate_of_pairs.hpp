// Estimates from states drawn in pairs, each pair from a stratum of its own (stratified_states):
// how many of them, how much on average, each with its standard error.
//
// Everything estimated is a ratio of two totals over the states: a share (how many do / how many
// there are), a mean over those that reach (their times / their number), a rate (turns / metres).
// Its error is linearised, and measured by how the two states of a pair differ (Cochran, Sampling
// Techniques, 1977, sections 5.3 and 6.11): no assumption about how states of different places
// differ is made.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace fairway {

struct SampledValue {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: there are no such states
  double standard_error = 0.0;  ///< with a handful of states, itself hardly known
  std::size_t states = 0;       ///< with something in the whole
};

/// The total of `part` by that of `whole`, [state], states 2 k and 2 k + 1 of one stratum; all
/// strata are alike in size. `whole` is >= 0.
[[nodiscard]] SampledValue ratio_of_totals(std::span<const double> part,
                                           std::span<const double> whole);

/// The second such ratio less the first, over the same states: where both have the same errors, the
/// difference is known better than either.
[[nodiscard]] SampledValue difference_of_ratios(std::span<const double> first_part,
                                                std::span<const double> first_whole,
                                                std::span<const double> second_part,
                                                std::span<const double> second_whole);

/// A quantile of a sample.
struct QuantileEstimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();  ///< with `high`: a 95 % interval
  double high = std::numeric_limits<double>::quiet_NaN();
  std::size_t states = 0;
};

/// The value below which the share `q` of the values lies, (0, 1); its interval is that of draws
/// without strata, which is too wide rather than too narrow. NaN when there are no values; some may
/// be infinite.
[[nodiscard]] QuantileEstimate quantile_of(std::vector<double> values, double q);

}  // namespace fairway
