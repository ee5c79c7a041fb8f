// The spread of many values: their mean, 95th percentile and maximum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fairway {

struct Spread {
  std::size_t count = 0;
  double mean = 0.0;
  double p95 = 0.0;  ///< at least 95 % of the values are not above it (nearest rank)
  double worst = 0.0;
  friend bool operator==(const Spread&, const Spread&) = default;
};

/// All 0 when there are none. Values are finite.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// The same for more values than can be kept: they are counted in bins no wider than 1/64 of
/// themselves, so p95 is too large by that at most, and by 1e-6 near 0. The order in which values
/// come, or parts are merged, changes nothing but the last digits of the mean.
class SpreadCounter {
 public:
  /// Finite and >= 0.
  void add(double value);
  void merge(const SpreadCounter& other);
  [[nodiscard]] Spread spread() const;

 private:
  static constexpr int least_exponent = -19;  // 2^-20 is the upper edge of the first bin
  static constexpr int exponents = 60;
  static constexpr int parts = 64;  // of a power of two

  std::array<std::uint64_t, std::size_t{exponents} * parts + 1> bins_{};
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double worst_ = 0.0;
};

}  // namespace fairway
