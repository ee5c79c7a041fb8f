#include "fairway/inclusion/contract_hand_over.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/inclusion/contract_lookup.hpp"
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
/// `time_s(part, piece)`: of those in one ordinary part.
template <typename TimeOfPiece>
double time_of_states(const Parts& parts, const ConvexSet& set, const TimeOfPiece& time_s) {
  const auto [lowest, highest] = set.box();
  const auto below = [](double v) { return static_cast<int>(std::floor(v - place_slack)); };
  const auto above = [](double v) { return static_cast<int>(std::floor(v + place_slack)); };
  double worst_s = 0.0;
  const int last_x = std::min(above(highest.x), parts.nx() - 1);
  const int last_y = std::min(above(highest.y), parts.ny() - 1);
  for (int iy = std::max(below(lowest.y), 0); iy <= last_y; ++iy) {
    for (int ix = std::max(below(lowest.x), 0); ix <= last_x; ++ix) {
      const PartPlace part{ix, iy};
      const PartKind kind = parts.kind(part);
      // The vehicle is not in an obstacle: its flight would have ended. Nor in a goal, nor outside.
      if (kind == PartKind::obstacle || kind == PartKind::goal) continue;
      const ConvexSet piece = set.within(grown_box(part));
      if (piece.empty()) continue;
      if (kind != PartKind::ordinary) return ReachBoxes::not_proved;
      worst_s = std::max(worst_s, time_s(part, piece));
      if (worst_s == ReachBoxes::not_proved) return worst_s;
    }
  }
  return worst_s;
}

double distance_to(const ConvexSet& segment, Vec2 place) {
  const auto [low, high] = segment.box();
  return norm(place - Vec2{std::clamp(place.x, low.x, high.x), std::clamp(place.y, low.y, high.y)});
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
  // A little more than is needed: whoever checks flies other sets, and states that nearly fail
  // would be told otherwise.
  constexpr double spare_parts = 0.15;
  constexpr double spare_rad = 0.06;
  const double grown = 2.0 * error.place_m / own.part_m() + spare_parts;
  const double grown_rad = 2.0 * error.heading_rad + spare_rad;
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
        const auto time_s = [&](PartPlace in, const ConvexSet& piece) {
          return earlier[mode]->time_s(in, piece, headings.range[k]);
        };
        worst_s = std::max(worst_s, time_of_states(earlier[mode]->parts(), *asked, time_s));
      }
    }
    if (worst_s < ReachBoxes::not_proved) return {static_cast<std::uint8_t>(mode), worst_s};
  }
  return {};
}

ContractHandOver hand_over_near(const Parts& own, const ContractVerdictsView& verdicts, Vec2 place,
                                double heading_rad, const EstimateError& error, double in_time_s) {
  const double near = error.place_m / own.part_m() + place_slack;
  const HeadingArc heading{heading_rad, 0.0};
  const auto first_of = [near](double v) {
    return static_cast<int>(std::floor(v - near - place_slack));
  };
  const auto last_of = [near](double v) { return static_cast<int>(std::floor(v + near)); };
  ContractHandOver best{.time_s = in_time_s};
  for (int iy = std::max(first_of(place.y), 0); iy <= std::min(last_of(place.y), own.ny() - 1);
       ++iy) {
    for (int ix = std::max(first_of(place.x), 0); ix <= std::min(last_of(place.x), own.nx() - 1);
         ++ix) {
      const PartPlace part{ix, iy};
      if (own.kind(part) != PartKind::ordinary) continue;
      for (std::size_t side = 0; side < 4; ++side) {
        const auto to = static_cast<PartSide>(side);
        const OutwardHeadings headings(own.arc(part), to, error.heading_rad + heading_slack_rad);
        const auto holds = [&heading](const HeadingArc& a) { return a.meets(heading); };
        if (std::none_of(headings.range.begin(), headings.range.begin() + headings.count, holds)) {
          continue;
        }
        const std::size_t section = 4 * own.index(part) + side;
        for (std::size_t leaf = verdicts.first[section]; leaf < verdicts.first[section + 1];
             ++leaf) {
          const std::uint32_t group = verdicts.group[leaf];
          const auto time_s = static_cast<double>(verdicts.group_time_s[group]);
          if (verdicts.group_next_mode[group] == no_mode || time_s > best.time_s) continue;
          const bool is_last = leaf + 1 == verdicts.first[section + 1];
          const double hi = is_last ? 1.0 : verdicts.begin[leaf + 1] * 0x1p-32;
          const ConvexSet at = segment_of_side(part, to, verdicts.begin[leaf] * 0x1p-32, hi);
          if (distance_to(at, place) <= near) best = {verdicts.group_next_mode[group], time_s};
        }
      }
    }
  }
  return best;
}

double time_around(const Parts& parts, const ContractVerdictsView& verdicts, double speed_least_mps,
                   Vec2 place, double heading_rad, const EstimateError& error) {
  const double width_rad = 2.0 * (error.heading_rad + heading_slack_rad);
  if (width_rad >= pi) return ReachBoxes::not_proved;
  const HeadingArc headings{heading_rad - 0.5 * width_rad, width_rad};
  Vec2 point[]{place};
  const ConvexSet around =
      grown_segment(ConvexSet::hull(point), error.place_m / parts.part_m() + place_slack);
  // Where all have ended nothing is asked, and nothing is proved but that a goal is reached.
  const PartPlace middle{static_cast<int>(std::floor(place.x)),
                         static_cast<int>(std::floor(place.y))};
  bool anyone = parts.kind(middle) == PartKind::goal;
  const double worst_s = time_of_states(parts, around, [&](PartPlace part, const ConvexSet& piece) {
    anyone = true;
    const ContractAnswer answer =
        contract_answer(parts, verdicts, speed_least_mps, part, piece, headings);
    return answer.verdict == Verdict::reach ? answer.worst_time_s : ReachBoxes::not_proved;
  });
  return anyone ? worst_s : ReachBoxes::not_proved;
}

}  // namespace fairway
