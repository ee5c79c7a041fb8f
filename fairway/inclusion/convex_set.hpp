// A convex set of places, by its corners: what sets of behaviours fly as. Corners count
// counter-clockwise; a point and a segment are sets, too. No heap.
//
// Every operation gives a set that holds the exact one, but for rounding: corners are off by less
// than 2^-40 of the coordinates' size, which the slack of the inclusion swallows (inclusion.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "fairway/base/vec2.hpp"

namespace fairway {

struct Box {
  Vec2 lowest;
  Vec2 highest;
};

class ConvexSet {
 public:
  /// Beyond `simple` corners the hull is that of sixteen directions.
  static constexpr std::size_t simple = 24;
  static constexpr std::size_t capacity = 32;

  ConvexSet() {}  // NOLINT: the corners stay uninitialised
  explicit ConvexSet(Vec2 point) { add(point); }
  ConvexSet(Vec2 a, Vec2 b) {
    add(a);
    add(b);
  }
  ConvexSet(const ConvexSet& other) : size_(other.size_) {
    std::copy_n(other.corner_, size_, corner_);
  }
  ConvexSet& operator=(const ConvexSet& other) {
    size_ = other.size_;
    std::copy_n(other.corner_, size_, corner_);
    return *this;
  }

  bool empty() const { return size_ == 0; }
  std::span<const Vec2> corners() const { return {corner_, size_}; }

  /// What lies at lo <= x <= hi.
  ConvexSet within_x(double lo, double hi) const;
  /// What lies at lo <= y <= hi.
  ConvexSet within_y(double lo, double hi) const;
  /// What lies in the box.
  ConvexSet within(const Box& box) const {
    return within_x(box.lowest.x, box.highest.x).within_y(box.lowest.y, box.highest.y);
  }
  /// The smallest box around it; it is not empty.
  Box box() const;

  /// Of corners in their order, at most `simple`.
  static ConvexSet of_ordered(std::span<const Vec2> corners, bool counter_clockwise);
  /// The hull of points; they are put in order.
  static ConvexSet hull(std::span<Vec2> points);

 private:
  friend ConvexSet sum(const ConvexSet& set, const ConvexSet& step);
  friend ConvexSet sum_of_ordered(const ConvexSet& set, const ConvexSet& step);
  bool turns_left() const;
  template <double Vec2::*along>
  void keep_above(double least);
  template <double Vec2::*along>
  void keep_below(double most);
  template <typename Off>
  void keep_inside(const Off& off);
  void add(Vec2 corner) { corner_[size_++] = corner; }
  static ConvexSet of_directions(std::span<const Vec2> points);
  std::size_t lowest_corner() const;

  union {
    Vec2 corner_[capacity];
  };
  std::size_t size_ = 0;
};

/// All sums of a place of `set` and one of `step`.
ConvexSet sum(const ConvexSet& set, const ConvexSet& step);

}  // namespace fairway
