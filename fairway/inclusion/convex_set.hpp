// A convex set of places, by its corners: what sets of behaviours fly as. Corners count
// counter-clockwise; a point and a segment are sets, too. No heap.
//
// Every operation gives a set that holds the exact one, but for rounding: corners are off by less
// than 2^-40 of the coordinates' size, which the slack of the inclusion swallows (inclusion.hpp).
#pragma once

#include <array>
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

  ConvexSet() = default;
  explicit ConvexSet(Vec2 point) : corner_{point}, size_(1) {}
  ConvexSet(Vec2 a, Vec2 b) : corner_{a, b}, size_(2) {}

  bool empty() const { return size_ == 0; }
  std::span<const Vec2> corners() const { return {corner_.data(), size_}; }

  /// What lies at a x + b y <= c.
  ConvexSet below(double a, double b, double c) const;
  /// What lies in the box.
  ConvexSet within(const Box& box) const;
  /// The smallest box around it; it is not empty.
  Box box() const;

  /// The hull of points; they are put in order.
  static ConvexSet hull(std::span<Vec2> points);

 private:
  friend ConvexSet sum(const ConvexSet& set, const ConvexSet& step);
  friend ConvexSet sum_of_ordered(const ConvexSet& set, const ConvexSet& step);
  bool turns_left() const;
  void add(Vec2 corner) { corner_[size_++] = corner; }
  static ConvexSet of_directions(std::span<const Vec2> points);
  std::size_t lowest_corner() const;

  std::array<Vec2, capacity> corner_;
  std::size_t size_ = 0;
};

/// All sums of a place of `set` and one of `step`.
ConvexSet sum(const ConvexSet& set, const ConvexSet& step);

}  // namespace fairway
