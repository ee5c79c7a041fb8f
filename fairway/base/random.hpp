// Portable random draws: the same seed gives the same numbers on every machine and compiler.
//
// xoshiro256++ (Blackman and Vigna 2019) seeded by splitmix64. `stream` gives independent draws
// for item i of a batch, so results never depend on the order of work.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace fairway {

constexpr std::uint64_t splitmix64(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) word = splitmix64(seed);
  }
  static Random stream(std::uint64_t seed, std::uint64_t item) {
    std::uint64_t mixed = seed;
    const std::uint64_t a = splitmix64(mixed);
    mixed = a ^ (item * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL);
    return Random(splitmix64(mixed));
  }

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }
  /// Uniform in [0, 1), 53 bits.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in 0 .. n-1, n >= 1; without bias (Lemire's rejection).
  std::uint64_t below(std::uint64_t n) {
    const std::uint64_t threshold = (0 - n) % n;
    for (;;) {
      const auto wide = static_cast<unsigned __int128>(bits()) * n;
      if (static_cast<std::uint64_t>(wide) >= threshold)
        return static_cast<std::uint64_t>(wide >> 64);
    }
  }
  /// Standard normal (Marsaglia's polar method, one value kept).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    for (;;) {
      const double u = uniform(-1.0, 1.0);
      const double v = uniform(-1.0, 1.0);
      const double s = u * u + v * v;
      if (s >= 1.0 || s == 0.0) continue;
      const double f = std::sqrt(-2.0 * std::log(s) / s);
      spare_ = v * f;
      has_spare_ = true;
      return u * f;
    }
  }

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace fairway
