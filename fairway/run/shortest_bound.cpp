#include "fairway/run/shortest_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

namespace fairway {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

class Lines {
 public:
  explicit Lines(const Plan& plan)
      : grid_(plan.grid),
        points_x_(plan.grid.nx + 1),
        free_(plan.grid.size()),
        goal_(plan.grid.size()) {
    for (std::size_t i = 0; i < free_.size(); ++i) {
      free_[i] = plan.region[i] != Region::obstacle;
      goal_[i] = plan.region[i] == Region::goal;
    }
    way_.assign(static_cast<std::size_t>(points_x_) * static_cast<std::size_t>(grid_.ny + 1),
                infinite);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (goal_[i]) add_goal(grid_.cell_at(i));
    }
    spread();
  }

  double length_m(Vec2 place_m) const {
    const Vec2 p{(place_m.x - grid_.x0_m) / grid_.cell_m, (place_m.y - grid_.y0_m) / grid_.cell_m};
    const int ix = std::clamp(static_cast<int>(std::floor(p.x)), 0, grid_.nx - 1);
    const int iy = std::clamp(static_cast<int>(std::floor(p.y)), 0, grid_.ny - 1);
    if (goal_[grid_.index({ix, iy})]) return 0.0;
    double way = infinite;
    for (const auto& [dx, dy] : corners) way = std::min(way, way_[point(ix + dx, iy + dy)]);
    if (way == infinite) return infinite;
    double squared = infinite;
    for (const Cell goal : edge_) {
      const double dx = std::max({goal.ix - p.x, 0.0, p.x - (goal.ix + 1)});
      const double dy = std::max({goal.iy - p.y, 0.0, p.y - (goal.iy + 1)});
      squared = std::min(squared, dx * dx + dy * dy);
    }
    const double octile_of_line = 1.0 / std::cos(pi / 8.0);
    const double around = (way - 2.0 * std::numbers::sqrt2) / octile_of_line;
    return std::max(std::sqrt(squared), around) * grid_.cell_m;
  }

 private:
  static constexpr std::array<std::pair<int, int>, 4> corners{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
  static constexpr std::array<std::pair<int, int>, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

  std::size_t point(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(points_x_) +
           static_cast<std::size_t>(ix);
  }
  bool is_free(int ix, int iy) const {
    return grid_.contains({ix, iy}) && free_[grid_.index({ix, iy})];
  }

  void add_goal(Cell goal) {
    for (const auto& [dx, dy] : corners) way_[point(goal.ix + dx, goal.iy + dy)] = 0.0;
    bool inside = true;  // among goal cells on all sides: no place outside is nearest to it
    for (const auto& [dx, dy] : sides) {
      const Cell beside{goal.ix + dx, goal.iy + dy};
      inside = inside && grid_.contains(beside) && goal_[grid_.index(beside)];
    }
    if (!inside) edge_.push_back(goal);
  }

  /// Dijkstra's algorithm from the goal's points, along the sides and diagonals of free cells.
  void spread() {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t i = 0; i < way_.size(); ++i) {
      if (way_[i] == 0.0) queue.emplace(0.0, i);
    }
    while (!queue.empty()) {
      const auto [way, at] = queue.top();
      queue.pop();
      if (way > way_[at]) continue;
      const int x = static_cast<int>(at % static_cast<std::size_t>(points_x_));
      const int y = static_cast<int>(at / static_cast<std::size_t>(points_x_));
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if ((dx == 0 && dy == 0) || !is_open(x, y, dx, dy)) continue;
          const double longer = way + (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0);
          double& there = way_[point(x + dx, y + dy)];
          if (longer >= there) continue;
          there = longer;
          queue.emplace(longer, point(x + dx, y + dy));
        }
      }
    }
  }

  /// Whether a free cell has this move as its side or diagonal.
  bool is_open(int x, int y, int dx, int dy) const {
    const int ix = dx < 0 ? x - 1 : x;
    const int iy = dy < 0 ? y - 1 : y;
    if (dx != 0 && dy != 0) return is_free(ix, iy);
    return dx != 0 ? is_free(ix, y - 1) || is_free(ix, y) : is_free(x - 1, iy) || is_free(x, iy);
  }

  Grid grid_;
  int points_x_;
  std::vector<bool> free_;   // [iy][ix]
  std::vector<bool> goal_;   // [iy][ix]
  std::vector<double> way_;  // [ny + 1][nx + 1] grid points, in cells
  std::vector<Cell> edge_;   // goal cells with another cell beside them
};

}  // namespace

LengthBound line_around_obstacles(const Plan& plan) {
  return {"the shortest line around obstacles, at least",
          [lines = std::make_shared<const Lines>(plan)](const State& state) {
            return lines->length_m(state.position_m);
          }};
}

}  // namespace fairway
