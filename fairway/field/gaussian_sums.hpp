// Weighted sums along lines of cells: a line is 16 neighbours across the direction of the sum,
// which is taken over lines a stride apart. The same code runs along columns, where a line is a
// piece of a row, and along rows, once they are transposed.
//
// Between walls, wall cells are marked on their way through with the one float that no other cell
// may have, minus zero. A cell sees its k-th neighbour if the run of open cells up to the cell,
// including itself, is longer than k.
//
// Everything here is inlined into functions built for one vector width (gaussian_band.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "fairway/field/gaussian_lanes.hpp"

namespace fairway::lanes {

inline constexpr std::size_t abreast = 4;  // outputs that share loads
inline constexpr float marked_wall = -0.0F;
inline constexpr int far = std::numeric_limits<int>::max();

struct Freed {
  void operator()(void* p) const { ::operator delete (p, std::align_val_t{64}); }
};
template <typename T>
using Scratch = std::unique_ptr<T[], Freed>;  // not initialised
template <typename T>
[[nodiscard]] Scratch<T> scratch(std::size_t count) {
  return Scratch<T>(static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{64})));
}

/// The length of the run of open cells up to a cell, from either side; lines of 16 cells.
struct Sight {
  explicit Sight(std::size_t length)
      : from_below(scratch<int>(length * line)), from_above(scratch<int>(length * line)) {}
  Scratch<int> from_below;
  Scratch<int> from_above;
};

/// Counts open cells along `length` lines that lie `stride` floats apart.
template <typename V, std::size_t stride>
[[gnu::always_inline]] inline void look(const float* cells, std::size_t length, Sight& sight) {
  constexpr int wall = std::bit_cast<int>(marked_wall);
  const auto* marks = reinterpret_cast<const int*>(cells);  // read as vectors that may alias
  for (std::size_t x = 0; x < line; x += V::count) {
    typename V::Int below{};
    typename V::Int above{};
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t k = length - 1 - i;
      below = (below + 1) & (V::at(marks + i * stride + x) != wall);
      above = (above + 1) & (V::at(marks + k * stride + x) != wall);
      V::at(sight.from_below.get() + i * line + x) = below;
      V::at(sight.from_above.get() + k * line + x) = above;
    }
  }
}

/// weight[k] at distance k, 0 <= k <= reach.
struct Kernel {
  const float* weight;
  std::size_t reach;
};

/// The growing weighted sums of four outputs: the neighbours at distance k below and above every
/// output are kept, and one of each is loaded when k grows.
template <typename V, std::size_t stride>
struct Sums {
  using Float = typename V::Float;
  const float* middle;  // the first output's own cell
  const float* weight;
  std::array<Float, abreast> sum;
  std::array<Float, abreast> below;
  std::array<Float, abreast> above;

  [[gnu::always_inline]] inline Sums(const float* at, const float* w) : middle(at), weight(w) {
    for (std::size_t j = 0; j < abreast; ++j) {
      below[j] = above[j] = V::at(middle + j * stride);
      sum[j] = below[j] * weight[0];
    }
  }
  [[gnu::always_inline]] inline void to_distance(std::size_t k) {
    for (std::size_t j = abreast - 1; j > 0; --j) below[j] = below[j - 1];
    for (std::size_t j = 0; j + 1 < abreast; ++j) above[j] = above[j + 1];
    below[0] = V::at(middle - k * stride);
    above[abreast - 1] = V::at(middle + (k + abreast - 1) * stride);
  }
  [[gnu::always_inline]] inline void add_all(std::size_t first, std::size_t last) {
    for (std::size_t k = first; k <= last; ++k) {
      to_distance(k);
      for (std::size_t j = 0; j < abreast; ++j) sum[j] += (below[j] + above[j]) * weight[k];
    }
  }
  /// Only what is seen: the output's runs of open cells, including itself, are longer than k.
  [[gnu::always_inline]] inline void add_seen(std::size_t first, std::size_t last,
                                              const std::array<typename V::Int, abreast>& lower,
                                              const std::array<typename V::Int, abreast>& upper) {
    const Float zero{};
    for (std::size_t k = first; k <= last; ++k) {
      to_distance(k);
      const int distance = static_cast<int>(k);
      for (std::size_t j = 0; j < abreast; ++j) {
        const Float seen_below = lower[j] > distance ? below[j] : zero;
        const Float seen_above = upper[j] > distance ? above[j] : zero;
        sum[j] += (seen_below + seen_above) * weight[k];
      }
    }
  }
};

/// Four lines of outputs from lines `stride` floats apart; `i` is the first output's own line.
template <typename V, bool walls, std::size_t stride>
[[gnu::always_inline]] inline void four_lines(const Kernel& kernel, const float* cells,
                                              std::size_t i, const Sight& sight, float wall_value,
                                              float* out) {
  for (std::size_t x = 0; x < line; x += V::count) {
    Sums<V, stride> sums(cells + i * stride + x, kernel.weight);
    if constexpr (walls) {
      std::array<typename V::Int, abreast> lower;
      std::array<typename V::Int, abreast> upper;
      std::array<typename V::Int, abreast> open;
      typename V::Int least = typename V::Int{} + far;
      typename V::Int greatest{};
      for (std::size_t j = 0; j < abreast; ++j) {
        lower[j] = V::at(sight.from_below.get() + (i + j) * line + x);
        upper[j] = V::at(sight.from_above.get() + (i + j) * line + x);
        open[j] = lower[j] > 0;
        const typename V::Int less = lower[j] < upper[j] ? lower[j] : upper[j];
        const typename V::Int more = lower[j] > upper[j] ? lower[j] : upper[j];
        const typename V::Int here = open[j] != 0 ? less : typename V::Int{} + far;
        least = least < here ? least : here;
        greatest = greatest > more ? greatest : more;
      }
      fold<V, V::count / 2>(least, greatest, std::make_index_sequence<V::count>());
      // All outputs see both neighbours up to distance `both`; none sees any beyond `any`.
      const std::size_t any =
          std::min<std::size_t>(static_cast<std::size_t>(greatest[0]), kernel.reach + 1);
      const std::size_t both =
          std::min<std::size_t>(static_cast<std::size_t>(least[0]) - 1, kernel.reach);
      if (any > 0) {
        sums.add_all(1, both);
        sums.add_seen(both + 1, any - 1, lower, upper);
      }
      for (std::size_t j = 0; j < abreast; ++j) {
        V::at(out + j * line + x) =
            open[j] != 0 ? sums.sum[j] + 0.0F : wall_value - typename V::Float{};
      }
    } else {
      sums.add_all(1, kernel.reach);
      for (std::size_t j = 0; j < abreast; ++j) V::at(out + j * line + x) = sums.sum[j];
    }
  }
}

}  // namespace fairway::lanes
