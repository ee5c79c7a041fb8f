// An array of plain entries that grows where it lies: a std::vector holds the old and the new
// entries at once while it grows, and leaves are most of what a proof holds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace fairway {

template <typename T>
class LeafArray {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  LeafArray() = default;
  LeafArray(const LeafArray& other) {
    resize(other.size_);
    std::copy(other.at_, other.at_ + other.size_, at_);
  }
  LeafArray(LeafArray&& other) noexcept
      : at_(std::exchange(other.at_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  LeafArray& operator=(LeafArray other) noexcept {
    std::swap(at_, other.at_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~LeafArray() { std::free(at_); }

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return at_[i]; }
  const T& operator[](std::size_t i) const { return at_[i]; }
  std::span<T> all() { return {at_, size_}; }
  std::size_t bytes() const { return size_ * sizeof(T); }

  /// New entries are those of T{}. Large blocks of memory are moved by their pages, not copied
  /// (glibc's realloc).
  void resize(std::size_t size) {
    if (size == size_) return;
    void* const grown = std::realloc(at_, std::max<std::size_t>(size, 1) * sizeof(T));
    if (grown == nullptr) throw std::bad_alloc();
    at_ = static_cast<T*>(grown);
    if (size > size_) std::uninitialized_fill(at_ + size_, at_ + size, T{});
    size_ = size;
  }

 private:
  T* at_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace fairway
