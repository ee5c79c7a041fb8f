// How a convex set lies over parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

inline bool is_flown_over(PartKind kind) {
  return kind == PartKind::ordinary || kind == PartKind::wild;
}

/// The part with what lies within the slack of it.
inline Box grown_box(PartPlace p, double by = place_slack) {
  return {{p.ix - by, p.iy - by}, {p.ix + 1 + by, p.iy + 1 + by}};
}

/// Whether some of a set lies in the part by more than the slack.
inline bool is_inside(const ConvexSet& set, PartPlace p) {
  const Box inner = grown_box(p, -place_slack);
  Vec2 sum;
  for (const Vec2 corner : set.corners()) sum = sum + corner;
  const Vec2 middle = (1.0 / static_cast<double>(set.corners().size())) * sum;
  return (middle.x > inner.lowest.x && middle.x < inner.highest.x && middle.y > inner.lowest.y &&
          middle.y < inner.highest.y) ||
         !set.within(inner).empty();
}

/// Calls body(part, kind, piece) for parts that together hold the set. A part over which behaviours
/// fly is left out when the set only touches it, and lies within the slack of others there: a set
/// that came out of a part must not count as being in it. Not so beside an obstacle: who passes so
/// near its corner may have passed it.
template <typename Body>
void for_parts(const Parts& parts, const ConvexSet& set, const Body& body) {
  const auto [lowest, highest] = set.box();
  const auto below = [](double v) { return static_cast<int>(std::floor(v - place_slack)); };
  const auto above = [](double v) { return static_cast<int>(std::floor(v + place_slack)); };
  const int x0 = below(lowest.x);
  const int y0 = below(lowest.y);
  const int x1 = above(highest.x);
  const int y1 = above(highest.y);
  if (x0 == x1 && y0 == y1) {
    body(PartPlace{x0, y0}, parts.kind({x0, y0}), set);
    return;
  }
  constexpr std::size_t most = 64;
  const bool many = static_cast<std::size_t>(x1 - x0 + 1) * static_cast<std::size_t>(y1 - y0 + 1) >
                    most;  // then none is left out
  std::array<PartPlace, most> chosen;
  std::array<PartPlace, most> touched;
  std::array<PartPlace, most> ends;
  std::size_t ends_count = 0;
  std::size_t chosen_count = 0;
  std::size_t touched_count = 0;
  const auto choose = [&](PartPlace p, PartKind kind, const ConvexSet& grown) {
    body(p, kind, grown);
    if (many) return;
    if (is_flown_over(kind)) {
      chosen[chosen_count++] = p;
    } else {
      ends[ends_count++] = p;
    }
  };
  for (int ix = x0; ix <= x1; ++ix) {
    const ConvexSet column = set.within_x(ix - place_slack, ix + 1 + place_slack);
    if (column.empty()) continue;
    for (int iy = y0; iy <= y1; ++iy) {
      const PartPlace p{ix, iy};
      const ConvexSet grown = column.within_y(iy - place_slack, iy + 1 + place_slack);
      if (grown.empty()) continue;
      const PartKind kind = parts.kind(p);
      if (many || !is_flown_over(kind) || is_inside(grown, p)) {
        choose(p, kind, grown);
      } else {
        touched[touched_count++] = p;
      }
    }
  }
  for (std::size_t k = 0; k < touched_count; ++k) {
    const PartPlace p = touched[k];
    const ConvexSet sliver = set.within(grown_box(p, 0.0));
    const auto holds_it = [&](PartPlace q) {
      return std::all_of(sliver.corners().begin(), sliver.corners().end(), [&](Vec2 c) {
        return c.x >= q.ix - place_slack && c.x <= q.ix + 1 + place_slack &&
               c.y >= q.iy - place_slack && c.y <= q.iy + 1 + place_slack;
      });
    };
    const auto is_held = [&](const std::array<PartPlace, most>& parts_there, std::size_t count) {
      return std::any_of(parts_there.begin(),
                         parts_there.begin() + static_cast<std::ptrdiff_t>(count), holds_it);
    };
    if (!sliver.empty() && (is_held(ends, ends_count) || !is_held(chosen, chosen_count))) {
      choose(p, parts.kind(p), set.within(grown_box(p)));
    }
  }
}

}  // namespace fairway
