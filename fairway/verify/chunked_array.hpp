// An array that grows without moving: what it holds lies in chunks. Growing never needs the old and
// the new array at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

template <typename T>
class ChunkedArray {
 public:
  static_assert(std::is_trivially_destructible_v<T>);

  std::uint32_t size() const { return static_cast<std::uint32_t>(size_); }
  T& operator[](std::size_t i) { return chunk_[i >> bits][i & mask]; }
  const T& operator[](std::size_t i) const { return chunk_[i >> bits][i & mask]; }
  /// The entries of a block, given its first one.
  T* block(std::size_t first) { return &chunk_[first >> bits][first & mask]; }
  const T* block(std::size_t first) const { return &chunk_[first >> bits][first & mask]; }

  /// Adds `count` contiguous entries, of no particular value; returns the number of the first.
  std::uint32_t add(std::size_t count) {
    if (count > chunk_.size() * chunk_size - size_) {
      size_ = chunk_.size() * chunk_size;
      const std::size_t chunks = (count + mask) >> bits;
      chunk_.push_back(std::make_unique_for_overwrite<T[]>(chunks * chunk_size));
      chunk_.resize(chunk_.size() + chunks - 1);  // parts of the one before
    }
    require(size_ + count < ~std::uint32_t{0}, "an array has fewer than 2^32 entries");
    const std::size_t first = size_;
    size_ += count;
    return static_cast<std::uint32_t>(first);
  }
  std::size_t bytes() const { return size_ * sizeof(T); }

 private:
  static constexpr std::size_t bits = 14;
  static constexpr std::size_t chunk_size = std::size_t{1} << bits;
  static constexpr std::size_t mask = chunk_size - 1;

  std::vector<std::unique_ptr<T[]>> chunk_;
  std::size_t size_ = 0;
};

}  // namespace fairway
