#include "fairway/field/mission_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

// Along a piece to its point nearest to p.
double along_to(const PathPiece& piece, Vec2 p) {
  return std::clamp(dot(p - piece.from, piece.tangent()), 0.0, piece.length_m);
}

int clamped_floor(double value, int low, int high) {
  return static_cast<int>(
      std::clamp(std::floor(value), static_cast<double>(low), static_cast<double>(high)));
}

// Cells of one piece, row by row: the stretch of the piece inside the row, widened only by the
// closed sides of the cells.
template <typename Visit>
void visit_cells(const Grid& g, const PathPiece& s, const Visit& visit) {
  const Vec2 a{(s.from.x - g.x0_m) / g.cell_m, (s.from.y - g.y0_m) / g.cell_m};
  const Vec2 b{(s.to.x - g.x0_m) / g.cell_m, (s.to.y - g.y0_m) / g.cell_m};
  const double low_y = std::min(a.y, b.y);
  const double high_y = std::max(a.y, b.y);
  if (high_y < 0.0 || low_y > g.ny) return;
  const int first = clamped_floor(std::ceil(low_y) - 1.0, 0, g.ny - 1);
  const int last = clamped_floor(high_y, 0, g.ny - 1);
  for (int iy = first; iy <= last; ++iy) {
    double x1 = a.x;
    double x2 = b.x;
    if (a.y != b.y) {
      const double t1 = std::clamp((iy - a.y) / (b.y - a.y), 0.0, 1.0);
      const double t2 = std::clamp((iy + 1 - a.y) / (b.y - a.y), 0.0, 1.0);
      x1 = a.x + t1 * (b.x - a.x);
      x2 = a.x + t2 * (b.x - a.x);
    }
    const double low_x = std::min(x1, x2);
    const double high_x = std::max(x1, x2);
    if (high_x < 0.0 || low_x > g.nx) continue;
    const int from = clamped_floor(std::ceil(low_x) - 1.0, 0, g.nx - 1);
    const int to = clamped_floor(high_x, 0, g.nx - 1);
    for (int ix = from; ix <= to; ++ix) visit(Cell{ix, iy});
  }
}

// Cells up to `beside` cells away from those that a piece crosses, each with the nearest piece.
std::vector<PathCell> nearest_pieces(const Grid& grid, const PathMission& path, int beside) {
  std::vector<PathCell> cells;
  double to_end_m = path.closed ? std::numeric_limits<double>::infinity() : length_of(path);
  for_pieces(path, [&](const PathPiece& piece) {
    visit_cells(grid, piece, [&](Cell crossed) {
      for (int dy = -beside; dy <= beside; ++dy) {
        for (int dx = -beside; dx <= beside; ++dx) {
          const Cell c{crossed.ix + dx, crossed.iy + dy};
          if (!grid.contains(c)) continue;
          const double t_m = along_to(piece, grid.center(c));
          const Vec2 nearest = piece.from + t_m * piece.tangent();
          cells.push_back({static_cast<std::uint32_t>(grid.index(c)), piece.tangent(),
                           norm(grid.center(c) - nearest), std::max(0.0, to_end_m - t_m)});
        }
      }
    });
    to_end_m -= piece.length_m;
  });
  // The piece nearest to a cell's centre gives the tangent; of equally near ones the first along
  // the path (the sort is stable).
  std::stable_sort(cells.begin(), cells.end(), [](const PathCell& a, const PathCell& b) {
    return a.index != b.index ? a.index < b.index : a.distance_m < b.distance_m;
  });
  const auto same = [](const PathCell& a, const PathCell& b) { return a.index == b.index; };
  cells.erase(std::unique(cells.begin(), cells.end(), same), cells.end());
  return cells;
}

}  // namespace

std::vector<std::uint32_t> cells_inside_disc(const Grid& grid, Vec2 center_m, double radius_m) {
  std::vector<std::uint32_t> cells;
  const auto near = [&](double c, double o, int n) {
    return std::pair{clamped_floor((c - radius_m - o) / grid.cell_m - 1.0, 0, n - 1),
                     clamped_floor((c + radius_m - o) / grid.cell_m + 1.0, 0, n - 1)};
  };
  const auto [x_first, x_last] = near(center_m.x, grid.x0_m, grid.nx);
  const auto [y_first, y_last] = near(center_m.y, grid.y0_m, grid.ny);
  for (int iy = y_first; iy <= y_last; ++iy) {
    for (int ix = x_first; ix <= x_last; ++ix) {
      const Vec2 low = grid.corner({ix, iy}) - center_m;
      const Vec2 high = grid.corner({ix + 1, iy + 1}) - center_m;
      const Vec2 farthest{std::max(std::fabs(low.x), std::fabs(high.x)),
                          std::max(std::fabs(low.y), std::fabs(high.y))};
      if (norm2(farthest) <= radius_m * radius_m) {
        cells.push_back(static_cast<std::uint32_t>(grid.index({ix, iy})));
      }
    }
  }
  return cells;
}

std::vector<PathCell> cells_on_path(const Grid& grid, const PathMission& path) {
  return nearest_pieces(grid, path, 0);
}

std::vector<PathCell> cells_near_path(const Grid& grid, const PathMission& path) {
  return nearest_pieces(grid, path, 1);
}

}  // namespace fairway
