// A flat array of 64-bit words, initially zero, that can free its tail without being copied: a copy
// of a large bitmap would double the peak memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace fairway {

class BitmapWords {
 public:
  BitmapWords() = default;
  explicit BitmapWords(std::size_t count)
      : words_(static_cast<std::uint64_t*>(std::calloc(count > 0 ? count : 1, 8))), count_(count) {
    if (words_ == nullptr) throw std::bad_alloc();
  }
  BitmapWords(BitmapWords&& other) noexcept
      : words_(std::exchange(other.words_, nullptr)), count_(std::exchange(other.count_, 0)) {}
  BitmapWords& operator=(BitmapWords&& other) noexcept {
    std::swap(words_, other.words_);
    std::swap(count_, other.count_);
    return *this;
  }
  BitmapWords(const BitmapWords& other) : BitmapWords(other.count_) {
    if (count_ > 0) std::memcpy(words_, other.words_, 8 * count_);
  }
  BitmapWords& operator=(const BitmapWords& other) { return *this = BitmapWords(other); }
  ~BitmapWords() { std::free(words_); }

  std::size_t size() const { return count_; }
  std::uint64_t* data() { return words_; }
  const std::uint64_t* data() const { return words_; }
  std::uint64_t& operator[](std::size_t i) { return words_[i]; }
  std::uint64_t operator[](std::size_t i) const { return words_[i]; }

  /// Keeps the first `count` words, at most size().
  void shorten(std::size_t count) {
    void* moved = std::realloc(words_, 8 * (count > 0 ? count : 1));
    if (moved != nullptr) words_ = static_cast<std::uint64_t*>(moved);
    count_ = count;
  }

  friend bool operator==(const BitmapWords& a, const BitmapWords& b) {
    return a.count_ == b.count_ &&
           (a.count_ == 0 || std::memcmp(a.words_, b.words_, 8 * a.count_) == 0);
  }

 private:
  std::uint64_t* words_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace fairway
