#include "tools/following/viable_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_set>

#include "fairway/base/heading.hpp"

namespace fairway::following {
namespace {

constexpr int steps_per_turn = 36;
constexpr double step_rad = two_pi / steps_per_turn;
constexpr double same_place_radii = 0.1;
constexpr double on_path_radii = 0.25;
constexpr double on_path_rad = 0.35;
constexpr std::size_t most_nodes = 60000;
constexpr double greed = 2.0;  // any way will do

}  // namespace

struct ViableStates::Node {
  Vec2 place;
  double heading_rad = 0.0;
  int turned = 0;  // since the start, in steps
  int steps = 0;
  double hope = 0.0;  // low: looked at early
};

ViableStates::ViableStates(const Plan& plan)
    : plan_(plan),
      path_(std::get<PathMission>(plan.record.mission.value())),
      r_(plan.vehicle.turn_radius_m) {}

/// Within an obstacle, by more than `cut_m` along the axes, or outside the grid.
bool ViableStates::is_blocked(Vec2 place, double cut_m) const {
  for (const Vec2 way : {Vec2{0.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
    const Cell cell = plan_.grid.cell_of(place + cut_m * way);
    if (plan_.grid.contains(cell) && plan_.region[plan_.grid.index(cell)] != Region::obstacle) {
      return false;
    }
    if (cut_m == 0.0) break;
  }
  return true;
}

ViableStates::Node ViableStates::after(const Node& from, int side, double share) const {
  const double turn = share * side * step_rad;
  const double chord_m =
      side == 0 ? share * step_rad * r_ : 2.0 * r_ * std::sin(0.5 * share * step_rad);
  Node to = from;
  to.place = from.place + chord_m * Heading::from_rad(from.heading_rad + 0.5 * turn).unit();
  to.heading_rad += turn;
  return to;
}

bool ViableStates::is_clear(const Node& from, int side, double cut_m) const {
  const int probes = 1 + static_cast<int>(8.0 * step_rad * r_ / plan_.grid.cell_m);
  for (int k = 1; k <= probes; ++k) {
    if (is_blocked(after(from, side, static_cast<double>(k) / probes).place, cut_m)) return false;
  }
  return true;
}

/// From the path's direction; pi and more away from the path.
double ViableStates::off_rad(const Node& node) const {
  const PathFrame frame = path_.frame(node.place);
  const double off =
      std::abs(Heading::of(frame.tangent).turn_to(Heading::from_rad(node.heading_rad)));
  if (frame.beyond_m > 0.0) return off + pi;
  return std::abs(frame.offset_m) < on_path_radii * r_ ? off : std::max(off, on_path_rad);
}

bool ViableStates::contains(const State& state, double cut_m) const {
  Node start;
  start.place = state.position_m;
  start.heading_rad = state.heading.rad();
  if (is_blocked(start.place, 0.0)) return false;
  const auto later = [](const Node& a, const Node& b) { return a.hope > b.hope; };
  std::priority_queue<Node, std::vector<Node>, decltype(later)> open(later);
  std::unordered_set<std::uint64_t> seen;
  open.push(start);
  while (!open.empty() && seen.size() < most_nodes) {
    const Node node = open.top();
    open.pop();
    for (const int side : {0, -1, 1}) {
      if (!is_clear(node, side, cut_m)) continue;
      Node to = after(node, side, 1.0);
      to.turned = (node.turned + side + steps_per_turn) % steps_per_turn;
      to.steps = node.steps + 1;
      const double off = off_rad(to);
      if (off < on_path_rad) return true;
      const auto x =
          static_cast<std::uint64_t>((to.place.x - plan_.grid.x0_m) / (same_place_radii * r_));
      const auto y =
          static_cast<std::uint64_t>((to.place.y - plan_.grid.y0_m) / (same_place_radii * r_));
      const std::uint64_t bin =
          ((x << 24U) + y) * steps_per_turn + static_cast<std::uint64_t>(to.turned);
      if (!seen.insert(bin).second) continue;
      const double way_m = plan_.cost_m[plan_.grid.index(plan_.grid.cell_of(to.place))];
      to.hope = to.steps + greed * std::max(off, way_m / r_) / step_rad;
      open.push(to);
    }
  }
  return false;
}

}  // namespace fairway::following
