// How aligned sets leave their parts, and what they come to.
#include <algorithm>
#include <cmath>

#include "fairway/inclusion/quick_flight.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {
namespace {

struct Range {
  double lo;
  double hi;
};
Range above(Range r, double by) { return {r.lo + by, r.hi + by}; }
Range below(double from, Range r) { return {from - r.hi, from - r.lo}; }

/// A set as one sees it who looks out over a side: places along it, counted from the right, how
/// deep inside they lie, and the sum and the difference of the two.
struct Outlook {
  Range along;
  Range depth;
  Range sum;
  Range difference;

  Outlook(const Octagon& o, PartPlace part, std::size_t side) {
    const double px = part.ix;
    const double py = part.iy;
    const Range x = above({o.lo[0], o.hi[0]}, -px);
    const Range s = above({o.lo[1], o.hi[1]}, -px - py);
    const Range y = above({o.lo[2], o.hi[2]}, -py);
    const Range d = above({o.lo[3], o.hi[3]}, px - py);
    switch (static_cast<PartSide>(side)) {
      case PartSide::east:
        *this = Outlook(y, below(1.0, x), above(d, 1.0), above(s, -1.0));
        break;
      case PartSide::north:
        *this = Outlook(below(1.0, x), below(1.0, y), below(2.0, s), d);
        break;
      case PartSide::west:
        *this = Outlook(below(1.0, y), x, below(1.0, d), below(1.0, s));
        break;
      case PartSide::south:
        *this = Outlook(x, y, s, below(0.0, d));
        break;
    }
    depth.lo = std::max(depth.lo, 0.0);
  }

  /// Bounds of along + slope depth.
  double least(double slope) const {
    const double steep = std::abs(slope);
    const double end = slope > 0.0 ? sum.lo : difference.lo;
    if (steep <= 1.0) return (1.0 - steep) * along.lo + steep * end;
    return end + (steep - 1.0) * (slope > 0.0 ? depth.lo : -depth.hi);
  }
  double most(double slope) const {
    const double steep = std::abs(slope);
    const double end = slope > 0.0 ? sum.hi : difference.hi;
    if (steep <= 1.0) return (1.0 - steep) * along.hi + steep * end;
    return end + (steep - 1.0) * (slope > 0.0 ? depth.hi : -depth.lo);
  }

 private:
  Outlook(Range a, Range b, Range c, Range d) : along(a), depth(b), sum(c), difference(d) {}
};

/// The tangent of a heading against a side's outward one, a little less (`sign` -1) or more; none
/// when others of the arc lead anywhere.
bool slope_of(Vec2 unit, std::size_t side, double sign, double& slope) {
  constexpr double least_outward = 0x1p-12;
  const Vec2 outward = side_axes[side].outward;
  const double out = dot(outward, unit);
  const double left = cross(outward, unit);
  if (!(out > 0.0)) return false;
  if (out <= least_outward) {
    if ((sign < 0.0) != (left > 0.0)) return false;
    slope = -sign / least_outward;
    return true;
  }
  slope = left / out;
  constexpr double rounding = 4e-7;  // of floats, and of headings counted as aligned
  const double more = 1.0 + std::abs(slope);
  slope += sign * rounding * more * more;
  return true;
}

}  // namespace

/// Whether what is aligned with the part comes to nothing that is not known by now.
bool QuickFlight::adds_nothing(const Met& met, double flown) const {
  const PartRecord& record = *met.record;
  return record.all_verdicts() == verdicts_ &&
         (flown + static_cast<double>(record.longest_way)) * options_.part_s +
                 table_.longest_time_s(met.part) <=
             worst_time_s_;
}

/// Aligned behaviours stay so until they leave the part.
void QuickFlight::leave_parts() {
  for (std::size_t k = 0; k < aligned_count_ && !is_undecided(); ++k) {
    const Aligned& one = aligned_[k];
    if (!one.is_told && !adds_nothing(one.met, one.flown)) leave(one);
  }
  aligned_count_ = 0;
}

void QuickFlight::leave(const Aligned& aligned) {
  leave_over<0>(aligned);
  leave_over<1>(aligned);
  leave_over<2>(aligned);
  leave_over<3>(aligned);
}

template <std::size_t side>
void QuickFlight::leave_over(const Aligned& aligned) {
  const PartRecord& record = *aligned.met.record;
  if (!record.is_crossed(side)) return;
  const double flown_s =
      (aligned.flown + static_cast<double>(record.longest_way)) * options_.part_s;
  if (record.verdicts(side) == verdicts_ &&
      flown_s + table_.longest_time_s(aligned.met.part, side) <= worst_time_s_) {
    return;  // nothing that is not known by now
  }
  const Outlook seen(aligned.set, aligned.met.part, side);
  double lo = 0.0;
  double hi = 1.0;
  double slope = 0.0;
  constexpr double rounding = 0x1p-30;
  if (slope_of(record.lowest(), side, -1.0, slope)) {
    lo = seen.least(slope) - rounding * (1.0 + std::abs(slope));
  }
  if (slope_of(record.highest(), side, 1.0, slope)) {
    hi = seen.most(slope) + rounding * (1.0 + std::abs(slope));
  }
  if (lo > 1.0 || hi < 0.0) return;
  const auto found = table_.find(aligned.met.part, side, std::max(lo, 0.0), std::min(hi, 1.0));
  verdicts_ |= found.verdicts;
  worst_time_s_ = std::max(worst_time_s_, flown_s + found.time_s);
}

}  // namespace fairway
