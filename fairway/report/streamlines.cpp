#include "fairway/report/streamlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr double least_agreement = 0.3;
constexpr double closest_share = 0.5;  // d_test / d_sep of the paper

/// The points drawn so far, in buckets of one separation, so that a neighbour search reads nine.
class Crowd {
 public:
  Crowd(const Grid& grid, double separation_m)
      : low_{grid.x0_m, grid.y0_m},
        side_m_(separation_m),
        columns_(1 + static_cast<int>(grid.width_m() / separation_m)),
        rows_(1 + static_cast<int>(grid.height_m() / separation_m)),
        buckets_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(Vec2 p) { buckets_[place(column(p), row(p))].push_back(p); }

  /// `distance_m` <= separation.
  bool has_near(Vec2 p, double distance_m) const {
    for (int r = std::max(0, row(p) - 1); r <= std::min(rows_ - 1, row(p) + 1); ++r)
      for (int c = std::max(0, column(p) - 1); c <= std::min(columns_ - 1, column(p) + 1); ++c)
        for (const Vec2 q : buckets_[place(c, r)])
          if (norm2(q - p) < distance_m * distance_m) return true;
    return false;
  }

 private:
  int column(Vec2 p) const {
    return std::clamp(static_cast<int>((p.x - low_.x) / side_m_), 0, columns_ - 1);
  }
  int row(Vec2 p) const {
    return std::clamp(static_cast<int>((p.y - low_.y) / side_m_), 0, rows_ - 1);
  }
  std::size_t place(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c);
  }

  Vec2 low_;
  double side_m_;
  int columns_;
  int rows_;
  std::vector<std::vector<Vec2>> buckets_;
};

bool has_command(const Plan& plan, Cell cell) {
  if (!plan.grid.contains(cell)) return false;
  const std::size_t i = plan.grid.index(cell);
  return plan.region[i] != Region::obstacle && std::isfinite(plan.heading_rad[i]);
}

/// One step of the midpoint rule, with (+1) or against (-1) the field.
std::optional<Vec2> step_from(const Plan& plan, Vec2 p, double signed_step_m) {
  const auto first = field_direction(plan, p);
  if (!first) return {};
  const auto middle = field_direction(plan, p + 0.5 * signed_step_m * *first);
  if (!middle) return {};
  const Vec2 next = p + signed_step_m * *middle;
  return field_direction(plan, next) ? std::optional<Vec2>(next) : std::nullopt;
}

class Weaver {
 public:
  Weaver(const Plan& plan, double separation_m)
      : plan_(plan),
        separation_m_(separation_m),
        step_m_(
            std::max(0.02 * separation_m, std::min(0.5 * plan.grid.cell_m, 0.2 * separation_m))),
        crowd_(plan.grid, separation_m) {}

  std::vector<std::vector<Vec2>> weave() {
    // Seeds half a separation apart, for parts of the field that no neighbouring line leads to.
    const Grid& grid = plan_.grid;
    const int columns = static_cast<int>(std::ceil(2.0 * grid.width_m() / separation_m_));
    const int rows = static_cast<int>(std::ceil(2.0 * grid.height_m() / separation_m_));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const Vec2 seed{grid.x0_m + (column + 0.5) / columns * grid.width_m(),
                        grid.y0_m + (row + 0.5) / rows * grid.height_m()};
        if (draw_through(seed)) spread();
      }
    return std::move(lines_);
  }

 private:
  /// Adds lines next to lines, until there is no room left next to any of them.
  void spread() {
    for (std::size_t line = lines_.size() - 1; line < lines_.size(); ++line) {
      for (std::size_t i = 0; i < lines_[line].size(); ++i) {
        const Vec2 p = lines_[line][i];
        const auto along = field_direction(plan_, p);
        if (!along) continue;
        draw_through(p + separation_m_ * left_of(*along));
        draw_through(p - separation_m_ * left_of(*along));
      }
    }
  }

  bool draw_through(Vec2 seed) {
    // Slightly less than the separation: seeds next to a straight line are one separation away.
    if (!field_direction(plan_, seed) || crowd_.has_near(seed, 0.999 * separation_m_)) return false;
    std::deque<Vec2> line{seed};
    while (const auto p = step_from(plan_, line.back(), step_m_)) {
      if (is_crowded(*p, line, true)) break;
      line.push_back(*p);
    }
    while (const auto p = step_from(plan_, line.front(), -step_m_)) {
      if (is_crowded(*p, line, false)) break;
      line.push_front(*p);
    }
    if (static_cast<double>(line.size() - 1) * step_m_ < separation_m_) return false;
    for (const Vec2 p : line) crowd_.add(p);
    lines_.emplace_back(line.begin(), line.end());
    return true;
  }

  /// Too near to another line, or to a part of its own that lies more than two separations back
  /// along it (a spiral, a closed loop).
  bool is_crowded(Vec2 p, const std::deque<Vec2>& line, bool at_back) const {
    const double near_m = closest_share * separation_m_;
    if (crowd_.has_near(p, near_m)) return true;
    const auto skipped = static_cast<std::size_t>(2.0 * separation_m_ / step_m_);
    const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(0.2 * near_m / step_m_));
    for (std::size_t k = skipped; k < line.size(); k += stride) {
      const Vec2 q = at_back ? line[line.size() - 1 - k] : line[k];
      if (norm2(q - p) < near_m * near_m) return true;
    }
    return false;
  }

  const Plan& plan_;
  double separation_m_;
  double step_m_;
  Crowd crowd_;
  std::vector<std::vector<Vec2>> lines_;
};

}  // namespace

std::optional<Vec2> field_direction(const Plan& plan, Vec2 point_m) {
  const Grid& grid = plan.grid;
  const Cell home = grid.cell_of(point_m);
  if (!has_command(plan, home)) return {};
  const double fx = (point_m.x - grid.x0_m) / grid.cell_m - 0.5;
  const double fy = (point_m.y - grid.y0_m) / grid.cell_m - 0.5;
  const int ix = static_cast<int>(std::floor(fx));
  const int iy = static_cast<int>(std::floor(fy));
  Vec2 sum;
  double weights = 0.0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const Cell cell{ix + dx, iy + dy};
      if (!has_command(plan, cell)) continue;
      const double w = (1.0 - std::abs(fx - cell.ix)) * (1.0 - std::abs(fy - cell.iy));
      const double heading = plan.heading_rad[grid.index(cell)];
      sum = sum + w * Vec2{std::cos(heading), std::sin(heading)};
      weights += w;
    }
  const double length = norm(sum);
  if (length <= least_agreement * weights) return {};
  return 1.0 / length * sum;
}

std::vector<std::vector<Vec2>> evenly_spaced_streamlines(const Plan& plan, double separation_m) {
  require(separation_m > 0.0, "streamlines have a positive separation");
  if (plan.grid.size() == 0) return {};
  return Weaver(plan, separation_m).weave();
}

}  // namespace fairway
