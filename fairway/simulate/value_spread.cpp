#include "fairway/simulate/value_spread.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

/// The place, from 1, of the value that 95 % of `count` do not exceed.
std::uint64_t rank_95(std::uint64_t count) { return count - count / 20; }

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  double sum = 0.0;
  for (const double value : values) sum += value;
  std::sort(values.begin(), values.end());
  return {values.size(), sum / static_cast<double>(values.size()),
          values[rank_95(values.size()) - 1], values.back()};
}

void SpreadCounter::add(double value) {
  require(value >= 0.0 && std::isfinite(value), "a counted value is finite and >= 0");
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);  // [0.5, 1), of a power of two
  std::size_t bin = 0;
  if (value > 0.0 && exponent >= least_exponent) {
    const int power = std::min(exponent - least_exponent, exponents - 1);
    bin = static_cast<std::size_t>(power * parts) + 1 +
          static_cast<std::size_t>((mantissa - 0.5) * 2.0 * parts);
  }
  ++bins_[bin];
  ++count_;
  sum_ += value;
  worst_ = std::max(worst_, value);
}

void SpreadCounter::merge(const SpreadCounter& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  sum_ += other.sum_;
  worst_ = std::max(worst_, other.worst_);
}

Spread SpreadCounter::spread() const {
  if (count_ == 0) return {};
  std::uint64_t left = rank_95(count_);
  std::size_t bin = 0;
  while (bins_[bin] < left) left -= bins_[bin++];
  double upper = std::ldexp(1.0, least_exponent - 1);
  if (bin > 0) {
    const auto power = static_cast<int>((bin - 1) / parts);
    const auto part = static_cast<double>((bin - 1) % parts + 1);
    upper = std::ldexp(0.5 + 0.5 * part / parts, least_exponent + power);
  }
  return {count_, sum_ / static_cast<double>(count_), std::min(upper, worst_), worst_};
}

}  // namespace fairway
