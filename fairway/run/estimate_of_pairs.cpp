#include "fairway/run/estimate_of_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {

namespace {

/// A ratio of totals, and what each state adds to its error.
struct Linearised {
  Linearised(std::span<const double> part, std::span<const double> whole) {
    require(part.size() == whole.size() && part.size() % 2 == 0, "states come in pairs");
    double parts = 0.0;
    double wholes = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      parts += part[i];
      wholes += whole[i];
      states += whole[i] > 0.0 ? 1 : 0;
    }
    if (!(wholes > 0.0)) return;
    value = parts / wholes;
    residual.resize(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
      residual[i] = (part[i] - value * whole[i]) / wholes;
    }
  }

  double value = std::numeric_limits<double>::quiet_NaN();
  std::size_t states = 0;
  std::vector<double> residual;  // [state], empty without a ratio
};

double squared(double x) { return x * x; }

}  // namespace

SampledValue ratio_of_totals(std::span<const double> part, std::span<const double> whole) {
  const Linearised ratio(part, whole);
  double variance = 0.0;
  for (std::size_t i = 0; i < ratio.residual.size(); i += 2) {
    variance += squared(ratio.residual[i] - ratio.residual[i + 1]);
  }
  return {ratio.value, std::sqrt(variance), ratio.states};
}

SampledValue difference_of_ratios(std::span<const double> first_part,
                                  std::span<const double> first_whole,
                                  std::span<const double> second_part,
                                  std::span<const double> second_whole) {
  require(first_part.size() == second_part.size(), "ratios to compare are of the same states");
  const Linearised first(first_part, first_whole);
  const Linearised second(second_part, second_whole);
  SampledValue found;
  found.states = std::min(first.states, second.states);
  if (found.states == 0) return found;
  found.value = second.value - first.value;
  double variance = 0.0;
  for (std::size_t i = 0; i < first.residual.size(); i += 2) {
    variance += squared((second.residual[i] - first.residual[i]) -
                        (second.residual[i + 1] - first.residual[i + 1]));
  }
  found.standard_error = std::sqrt(variance);
  return found;
}

QuantileEstimate quantile_of(std::vector<double> values, double q) {
  require(q > 0.0 && q < 1.0, "a quantile is of a share between 0 and 1");
  QuantileEstimate found;
  found.states = values.size();
  if (values.empty()) return found;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto at = [&](double share) {  // nearest rank
    const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * n) - 1.0;
    return values[static_cast<std::size_t>(std::clamp(rank, 0.0, n - 1.0))];
  };
  constexpr double two_sided_95 = 1.959963984540054;
  const double half = two_sided_95 * std::sqrt(q * (1.0 - q) / n);
  found.value = at(q);
  found.low = at(q - half);
  found.high = at(q + half);
  return found;
}

}  // namespace fairway
