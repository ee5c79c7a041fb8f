// Sets of headings as a few closed ranges on the circle: the values of the paper's Theta and Phi.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"

namespace fairway {

/// From `from_rad` counter-clockwise by `width_rad`, 0 .. 2 pi. Both ends belong to it.
struct HeadingRange {
  double from_rad = 0.0;
  double width_rad = 0.0;

  double to_rad() const { return from_rad + width_rad; }
  double middle_rad() const { return from_rad + 0.5 * width_rad; }
  /// How far counter-clockwise of the start a heading lies, [0, 2 pi).
  double from_start(double rad) const {
    const double d = std::fmod(rad - from_rad, two_pi);
    return d < 0.0 ? d + two_pi : d;
  }
  bool holds(double rad, double slack_rad = 0.0) const {
    const double d = from_start(rad);
    return d <= width_rad + slack_rad || d >= two_pi - slack_rad;
  }
};

/// Ranges in no particular order; they may touch.
struct HeadingSet {
  std::array<HeadingRange, 4> ranges{};
  std::size_t count = 0;

  bool empty() const { return count == 0; }
  const HeadingRange* begin() const { return ranges.data(); }
  const HeadingRange* end() const { return ranges.data() + count; }
  void add(HeadingRange range) {
    require(count < ranges.size(), "a set of headings has at most four ranges");
    ranges[count++] = range;
  }
  bool holds(double rad, double slack_rad = 0.0) const {
    return std::any_of(begin(), end(),
                       [&](const HeadingRange& r) { return r.holds(rad, slack_rad); });
  }
};

/// The intersection of two ranges: nothing, one range, or two.
inline HeadingSet common(const HeadingRange& a, const HeadingRange& b) {
  HeadingSet set;
  const double b_at = a.from_start(b.from_rad);
  if (b_at <= a.width_rad) set.add({a.from_rad + b_at, std::min(a.width_rad - b_at, b.width_rad)});
  const double over = b_at + b.width_rad - two_pi;  // where b ends after passing a's start
  if (over >= 0.0) set.add({a.from_rad, std::min(over, a.width_rad)});
  return set;
}

}  // namespace fairway
