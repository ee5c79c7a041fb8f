#include "fairway/steer/clear_approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/steer/fast_angle.hpp"

namespace fairway {
namespace {

struct Box {
  Vec2 low;
  Vec2 high;
  bool contains(Vec2 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
};

/// One part of a path: an arc about `centre_m` or a straight line.
struct Part {
  Vec2 begin_m;
  Vec2 end_m;
  Vec2 centre_m;
  double radius_m = 0.0;  ///< 0: straight
  double from_rad = 0.0;  ///< of the point that the arc's counter-clockwise way begins at, seen
                          ///< from the centre
  double sweep_rad = 0.0;

  /// Whether a point of the circle is on the arc, `slack_rad` beyond its ends included.
  bool passes(Vec2 p, double slack_rad) const {
    const double a = left_turn(Plane<double>{std::cos(from_rad), std::sin(from_rad)},
                               Plane<double>{p.x - centre_m.x, p.y - centre_m.y});
    return a <= sweep_rad + slack_rad || a >= two_pi - slack_rad;
  }
};

Part part_of(const State& begin, double length_m, int turn, double turn_radius_m) {
  const State end = driven(begin, length_m, turn / turn_radius_m);
  Part part{begin.position_m, end.position_m, {}, 0.0, 0.0, 0.0};
  if (turn == 0) return part;
  part.radius_m = turn_radius_m;
  const Vec2 left = left_of(fast_unit(begin.heading.rad()));
  part.centre_m = begin.position_m + (turn * turn_radius_m) * left;
  part.sweep_rad = length_m / turn_radius_m;
  // In a left turn the vehicle, seen from the centre, lies to the right of its heading. A right
  // turn is the same arc driven from its end.
  const double at = turn > 0 ? begin.heading.rad() - pi / 2 : end.heading.rad() + pi / 2;
  part.from_rad = std::remainder(at, two_pi);
  return part;
}

Box box_of(const Part& part) {
  Box box{{std::min(part.begin_m.x, part.end_m.x), std::min(part.begin_m.y, part.end_m.y)},
          {std::max(part.begin_m.x, part.end_m.x), std::max(part.begin_m.y, part.end_m.y)}};
  if (part.radius_m == 0.0) return box;
  for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
    const Vec2 p = part.centre_m + part.radius_m * axis;
    if (!part.passes(p, 1e-9)) continue;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

bool line_touches(const Part& part, const Box& box) {
  double first = 0.0;
  double last = 1.0;
  const Vec2 way = part.end_m - part.begin_m;
  const auto cut = [&](double at, double step, double low, double high) {
    if (step == 0.0) return at >= low && at <= high;
    const double a = (low - at) / step;
    const double b = (high - at) / step;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
    return first <= last;
  };
  return cut(part.begin_m.x, way.x, box.low.x, box.high.x) &&
         cut(part.begin_m.y, way.y, box.low.y, box.high.y);
}

/// An arc touches a square when an end is in it or it meets a side: an arc encloses nothing.
bool arc_touches(const Part& part, const Box& box) {
  if (box.contains(part.begin_m) || box.contains(part.end_m)) return true;
  const double r = part.radius_m;
  const Vec2 c = part.centre_m;
  const auto meets = [&](double offset, auto point, double low, double high) {
    const double square = r * r - offset * offset;
    if (square < 0.0) return false;
    for (const double half : {-std::sqrt(square), std::sqrt(square)}) {
      const auto [along, p] = point(half);
      if (along >= low && along <= high && part.passes(p, 1e-12)) return true;
    }
    return false;
  };
  for (const double x : {box.low.x, box.high.x}) {
    const auto point = [&](double half) { return std::pair{c.y + half, Vec2{x, c.y + half}}; };
    if (meets(x - c.x, point, box.low.y, box.high.y)) return true;
  }
  for (const double y : {box.low.y, box.high.y}) {
    const auto point = [&](double half) { return std::pair{c.x + half, Vec2{c.x + half, y}}; };
    if (meets(y - c.y, point, box.low.x, box.high.x)) return true;
  }
  return false;
}

bool is_clear(const Part& part, double turn_radius_m, const BlockedCells& cells) {
  const Grid& grid = cells.grid;
  const double farthest_m = std::abs(part.begin_m.x) + std::abs(part.begin_m.y);
  const double margin_m = 0x1p-30 * (grid.cell_m + turn_radius_m) + 0x1p-48 * farthest_m;
  const Vec2 margin{margin_m, margin_m};
  Box box = box_of(part);
  box = {box.low - margin, box.high + margin};
  const Vec2 corner{grid.x0_m, grid.y0_m};
  const Vec2 size{grid.width_m(), grid.height_m()};
  const Box world{corner + margin, corner + size - margin};
  if (cells.outside_blocked && !(world.contains(box.low) && world.contains(box.high))) return false;
  const auto place = [&](double at, double zero, int count) {
    return static_cast<int>(std::clamp(std::floor((at - zero) / grid.cell_m), 0.0, count - 1.0));
  };
  for (int iy = place(box.low.y, grid.y0_m, grid.ny); iy <= place(box.high.y, grid.y0_m, grid.ny);
       ++iy) {
    for (int ix = place(box.low.x, grid.x0_m, grid.nx); ix <= place(box.high.x, grid.x0_m, grid.nx);
         ++ix) {
      if (cells.blocked[grid.index({ix, iy})] == 0) continue;
      const Vec2 low = grid.corner({ix, iy});
      const Box square{low - margin, grid.corner({ix + 1, iy + 1}) + margin};
      if (part.radius_m == 0.0 ? line_touches(part, square) : arc_touches(part, square)) {
        return false;
      }
    }
  }
  return true;
}

DubinsPath single_part(const State& from, double turn_radius_m, int turn, double length_m) {
  DubinsPath path{from, turn_radius_m, DubinsWord::LSL, {}};
  if (turn < 0) path.word = DubinsWord::RSR;
  path.part_m[turn == 0 ? 1 : 0] = length_m;
  return path;
}

}  // namespace

bool is_clear(const DubinsPath& path, const BlockedCells& cells) {
  require(cells.blocked.size() == cells.grid.size(), "the cells are those of the grid");
  State at = path.start;
  if (!is_clear(part_of(at, 0.0, 0, path.turn_radius_m), path.turn_radius_m, cells)) return false;
  for (const auto& [length_m, turn, curvature_per_m] : parts_of(path)) {
    if (!(length_m > 0.0)) continue;
    if (!is_clear(part_of(at, length_m, turn, path.turn_radius_m), path.turn_radius_m, cells)) {
      return false;
    }
    at = driven(at, length_m, curvature_per_m);
  }
  return true;
}

std::optional<Approach> first_clear_approach(const State& from, const State& goal,
                                             double turn_radius_m, const BlockedCells& cells) {
  std::vector<DubinsPath> leads{single_part(from, turn_radius_m, 0, 0.0)};
  for (int k = 1; k <= 8; ++k) {
    leads.push_back(single_part(from, turn_radius_m, 0, 0.5 * k * turn_radius_m));
    for (const int turn : {1, -1}) {
      leads.push_back(single_part(from, turn_radius_m, turn, k * pi / 4 * turn_radius_m));
    }
  }
  std::vector<Approach> candidates;
  for (const DubinsPath& lead : leads) {
    if (!is_clear(lead, cells)) continue;
    for (const DubinsWord word : dubins_words) {
      const auto path = path_of_word(word, end_of(lead), goal, turn_radius_m);
      if (path) candidates.push_back({lead, *path});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Approach& a, const Approach& b) {
    return a.length_m() < b.length_m();
  });
  for (const Approach& candidate : candidates) {
    if (is_clear(candidate.path, cells)) return candidate;
  }
  return std::nullopt;
}

}  // namespace fairway
