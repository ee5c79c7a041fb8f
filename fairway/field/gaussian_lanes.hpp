// Vectors for the Gaussian filter: the compiler's vector types, working element by element like
// scalars, so that every width gives the same bits.
//
// Everything here is inlined into functions built for one width; nothing is called across widths.
#pragma once

#include <cstddef>
#include <utility>

namespace fairway::lanes {

/// Scratch memory is laid out in rows of this many floats, one cache line, for every width.
inline constexpr std::size_t line = 16;

template <std::size_t bytes>
struct Vector {
  using Float [[gnu::vector_size(bytes), gnu::may_alias]] = float;
  using Int [[gnu::vector_size(bytes), gnu::may_alias]] = int;
  using FloatAnywhere [[gnu::vector_size(bytes), gnu::aligned(4), gnu::may_alias]] = float;
  static constexpr std::size_t count = bytes / sizeof(float);
  using BytesAnywhere [[gnu::vector_size(count), gnu::aligned(1), gnu::may_alias]] = unsigned char;

  // Aligned to the vector.
  static const Float& at(const float* p) { return *reinterpret_cast<const Float*>(p); }
  static Float& at(float* p) { return *reinterpret_cast<Float*>(p); }
  static const Int& at(const int* p) { return *reinterpret_cast<const Int*>(p); }
  static Int& at(int* p) { return *reinterpret_cast<Int*>(p); }
  static const FloatAnywhere& anywhere(const float* p) {
    return *reinterpret_cast<const FloatAnywhere*>(p);
  }
  static FloatAnywhere& anywhere(float* p) { return *reinterpret_cast<FloatAnywhere*>(p); }
  static const BytesAnywhere& anywhere(const unsigned char* p) {
    return *reinterpret_cast<const BytesAnywhere*>(p);
  }
};

/// Swaps the off-diagonal blocks of two rows of a matrix that are `distance` apart.
template <typename V, std::size_t distance, std::size_t... lane>
[[gnu::always_inline]] inline void swap_blocks(typename V::Float& a, typename V::Float& b,
                                               std::index_sequence<lane...>) {
  constexpr std::size_t n = V::count;
  const typename V::Float top =
      __builtin_shufflevector(a, b, ((lane & distance) != 0 ? n + lane - distance : lane)...);
  b = __builtin_shufflevector(a, b, ((lane & distance) != 0 ? n + lane : lane + distance)...);
  a = top;
}

template <typename V, std::size_t distance>
[[gnu::always_inline]] inline void transpose_from(typename V::Float* row) {
  if constexpr (distance > 0) {
    for (std::size_t i = 0; i < V::count; ++i) {
      if ((i & distance) != 0) continue;
      swap_blocks<V, distance>(row[i], row[i + distance], std::make_index_sequence<V::count>());
    }
    transpose_from<V, distance / 2>(row);
  }
}

/// 16 x 16 floats from rows `from_stride` apart to rows `to_stride` apart, all aligned to vectors.
template <typename V>
[[gnu::always_inline]] inline void transpose_square(const float* from, std::size_t from_stride,
                                                    float* to, std::size_t to_stride) {
  for (std::size_t y = 0; y < line; y += V::count) {
    for (std::size_t x = 0; x < line; x += V::count) {
      typename V::Float row[V::count];
      for (std::size_t i = 0; i < V::count; ++i) row[i] = V::at(from + (y + i) * from_stride + x);
      transpose_from<V, V::count / 2>(row);
      for (std::size_t i = 0; i < V::count; ++i) V::at(to + (x + i) * to_stride + y) = row[i];
    }
  }
}

/// The least and the greatest element.
template <typename V, std::size_t distance, std::size_t... lane>
[[gnu::always_inline]] inline void fold(typename V::Int& least, typename V::Int& greatest,
                                        std::index_sequence<lane...> all) {
  if constexpr (distance > 0) {
    const typename V::Int a = __builtin_shufflevector(least, least, (lane ^ distance)...);
    const typename V::Int b = __builtin_shufflevector(greatest, greatest, (lane ^ distance)...);
    least = least < a ? least : a;
    greatest = greatest > b ? greatest : b;
    fold<V, distance / 2>(least, greatest, all);
  }
}

}  // namespace fairway::lanes
