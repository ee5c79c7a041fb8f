// A list of at most `most` items, stored in place: no heap, and unused places are not touched.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

namespace fairway {

template <typename T, int most>
class ShortList {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  ShortList() {}  // NOLINT: the places stay uninitialised

  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool is_full() const { return size_ == most; }
  /// Returns false and does nothing when the list is full.
  bool add(const T& item) {
    if (size_ == most) return false;
    ::new (static_cast<void*>(places_ + size_)) T(item);
    ++size_;
    return true;
  }
  /// One more item, with default members, to be filled in place. The list is not full.
  T& grow() {
    T* place = ::new (static_cast<void*>(places_ + size_)) T;
    ++size_;
    return *place;
  }
  void drop_last() { --size_; }
  /// Removes the last item; the list is not empty.
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
