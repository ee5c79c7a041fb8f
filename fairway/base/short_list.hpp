// A list of at most `most` items, kept in place: no heap, and nothing is done for places not used.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

namespace fairway {

template <typename T, int most>
class ShortList {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  ShortList() {}  // NOLINT: the places stay as they are

  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool is_full() const { return size_ == most; }
  /// False, and nothing done, when it is full.
  bool add(const T& item) {
    if (size_ == most) return false;
    ::new (static_cast<void*>(places_ + size_)) T(item);
    ++size_;
    return true;
  }
  /// One more, to be filled in place: its members have their defaults. Not full.
  T& grow() {
    T* place = ::new (static_cast<void*>(places_ + size_)) T;
    ++size_;
    return *place;
  }
  void drop_last() { --size_; }
  /// Removes the last; not empty.
  T take() { return places_[--size_]; }
  const T& operator[](int i) const { return places_[i]; }
  const T* begin() const { return places_; }
  const T* end() const { return places_ + size_; }

 private:
  union {
    T places_[most];
  };
  int size_ = 0;
};

}  // namespace fairway
