#include "fairway/inclusion/contract_hand_over.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/inclusion/part_pieces.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {
namespace {

/// Headings of an arc that point out over a side, grown: one range of them, or two.
struct OutwardHeadings {
  std::array<HeadingArc, 2> range;
  std::size_t count = 0;

  OutwardHeadings(const HeadingArc& arc, PartSide side, double grown_rad) {
    const double right = side_axes[static_cast<std::size_t>(side)].heading_rad - 0.5 * pi;
    double base = right + counted_from_zero(arc.lo_rad - right);
    for (int round = 0; round < 2; ++round, base -= whole_turn_rad) {
      const double lo = std::max(right, base);
      const double hi = std::min(right + pi, base + arc.width_rad);
      if (lo <= hi) range[count++] = HeadingArc{lo, hi - lo}.widened(grown_rad);
    }
  }
};

/// Of all states at a place of `set` where a flight may be that has not ended, with these headings.
double time_of_states(const ReachBoxes& mode, const ConvexSet& set, const HeadingArc& headings) {
  const Parts& parts = mode.parts();
  const auto [lowest, highest] = set.box();
  const auto below = [](double v) { return static_cast<int>(std::floor(v - place_slack)); };
  const auto above = [](double v) { return static_cast<int>(std::floor(v + place_slack)); };
  double worst_s = 0.0;
  for (int iy = below(lowest.y); iy <= above(highest.y); ++iy) {
    for (int ix = below(lowest.x); ix <= above(highest.x); ++ix) {
      const PartPlace part{ix, iy};
      const PartKind kind = parts.kind(part);
      // The vehicle is not in an obstacle: its flight would have ended. Nor in a goal.
      if (kind == PartKind::obstacle || kind == PartKind::outside || kind == PartKind::goal) {
        continue;
      }
      const ConvexSet piece = set.within(grown_box(part));
      if (piece.empty()) continue;
      if (kind != PartKind::ordinary) return ReachBoxes::not_proved;
      worst_s = std::max(worst_s, mode.time_s(part, piece, headings));
      if (worst_s == ReachBoxes::not_proved) return worst_s;
    }
  }
  return worst_s;
}

/// A hint: what is not so is hardly ever handed over.
bool may_hand_over(const ReachBoxes& mode, const std::array<PartPlace, 2>& parts,
                   const OutwardHeadings& headings) {
  for (std::size_t k = 0; k < headings.count; ++k) {
    const double middle = headings.range[k].lo_rad + 0.5 * headings.range[k].width_rad;
    for (const PartPlace part : parts) {
      if (mode.parts().kind(part) == PartKind::ordinary && !mode.may_reach(part, middle)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

ConvexSet grown_segment(const ConvexSet& segment, double by) {
  const auto [low, high] = segment.box();
  const double tip = by * 0.41421356237309515;  // tan(22.5 degrees), rounded up
  std::array<Vec2, 8> corners{{{low.x - tip, low.y - by},
                               {high.x + tip, low.y - by},
                               {high.x + by, low.y - tip},
                               {high.x + by, high.y + tip},
                               {high.x + tip, high.y + by},
                               {low.x - tip, high.y + by},
                               {low.x - by, high.y + tip},
                               {low.x - by, low.y - tip}}};
  return ConvexSet::hull(corners);
}

ContractHandOver hand_over(const Parts& own, PartPlace part, PartSide side, double lo, double hi,
                           const EstimateError& error, std::span<const ReachBoxes* const> earlier) {
  const double grown = 2.0 * error.place_m / own.part_m() + 4.0 * place_slack;
  const double grown_rad = 2.0 * error.heading_rad + 4.0 * heading_slack_rad;
  const ConvexSet segment = segment_of_side(part, side, lo, hi);
  const ConvexSet set = grown_segment(segment, grown);
  const OutwardHeadings headings(own.arc(part), side, grown_rad);
  // Most leaves that are not handed over are far from it: with an error of that size what is asked
  // about holds the middles of both parts, or nearly so.
  const bool hints_help = grown >= 0.5;
  const PartPlace beyond = part_beyond(part, side);
  for (std::size_t mode = 0; mode < earlier.size(); ++mode) {
    if (hints_help && !may_hand_over(*earlier[mode], {part, beyond}, headings)) continue;
    double worst_s = 0.0;
    // Most that fail do so at the leaf itself: one small set shows it.
    for (const ConvexSet* const asked : {&segment, &set}) {
      for (std::size_t k = 0; k < headings.count && worst_s < ReachBoxes::not_proved; ++k) {
        worst_s = std::max(worst_s, time_of_states(*earlier[mode], *asked, headings.range[k]));
      }
    }
    if (worst_s < ReachBoxes::not_proved) return {static_cast<std::uint8_t>(mode), worst_s};
  }
  return {};
}

}  // namespace fairway
