#include "fairway/map/cells_in_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fairway {
namespace {

/// In cells from the grid's corner.
double in_cells(double coordinate_m, double origin_m, double cell_m) {
  constexpr double slack = 1e-9;
  const double cells = (coordinate_m - origin_m) / cell_m;
  const double line = std::round(cells);
  return std::abs(cells - line) < slack ? line : cells;
}

struct Edge {
  Vec2 low, high;  ///< low.y <= high.y, in cells

  double x_at(double y) const {
    if (high.y == low.y) return low.x;
    return low.x + (y - low.y) / (high.y - low.y) * (high.x - low.x);
  }
};

std::vector<Edge> edges_of(const FencePolygon& polygon, const Grid& grid) {
  const auto point = [&](Vec2 p) {
    return Vec2{in_cells(p.x, grid.x0_m, grid.cell_m), in_cells(p.y, grid.y0_m, grid.cell_m)};
  };
  std::vector<Edge> edges;
  for (const std::vector<Vec2>& ring : polygon.rings_m) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = point(ring[i]);
      const Vec2 b = point(ring[(i + 1) % ring.size()]);
      edges.push_back(a.y <= b.y ? Edge{a, b} : Edge{b, a});
    }
  }
  return edges;
}

int clamped(double cells, int most) {
  return static_cast<int>(std::clamp(cells, 0.0, static_cast<double>(most)));
}

/// The rows that a stretch of y between two values meets with more than their borders.
std::pair<int, int> rows_of(const Edge& edge, int ny) {
  return {clamped(std::floor(edge.low.y), ny), clamped(std::ceil(edge.high.y), ny)};
}

/// Cells whose interior the edge meets are neither in nor out.
void cut(const Edge& edge, const Grid& grid, std::vector<std::uint8_t>& is_cut) {
  auto [first, last] = rows_of(edge, grid.ny);
  if (edge.low.y == edge.high.y && edge.low.y != std::floor(edge.low.y)) {
    last = clamped(std::floor(edge.low.y) + 1.0, grid.ny);
  }
  for (int iy = first; iy < last; ++iy) {
    const bool level = edge.low.y == edge.high.y;
    const double from = level ? edge.low.x : edge.x_at(std::max<double>(iy, edge.low.y));
    const double to = level ? edge.high.x : edge.x_at(std::min<double>(iy + 1, edge.high.y));
    const double low = std::floor(std::min(from, to));
    const double high = std::ceil(std::max(from, to));
    for (int ix = clamped(low, grid.nx); ix < clamped(high, grid.nx); ++ix) {
      is_cut[grid.index({ix, iy})] = 1;
    }
  }
}

/// Where the line through the middles of a row enters and leaves the polygon.
std::vector<double> crossings(const std::vector<Edge>& edges, double y) {
  std::vector<double> xs;
  for (const Edge& edge : edges) {
    if (edge.low.y <= y && y < edge.high.y) xs.push_back(edge.x_at(y));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

}  // namespace

void mark_cells_in(const FencePolygon& polygon, const Grid& grid,
                   std::vector<std::uint8_t>& cells) {
  const std::vector<Edge> edges = edges_of(polygon, grid);
  std::vector<std::uint8_t> is_cut(grid.size());
  for (const Edge& edge : edges) cut(edge, grid, is_cut);
  // A cell that no edge cuts is in or out as a whole: its middle tells.
  std::vector<std::vector<Edge>> by_row(static_cast<std::size_t>(grid.ny));
  for (const Edge& edge : edges) {
    const auto [first, last] = rows_of(edge, grid.ny);
    for (int iy = first; iy < last; ++iy) by_row[static_cast<std::size_t>(iy)].push_back(edge);
  }
  for (int iy = 0; iy < grid.ny; ++iy) {
    const std::vector<double> xs = crossings(by_row[static_cast<std::size_t>(iy)], iy + 0.5);
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const int first = clamped(std::ceil(xs[i] - 0.5), grid.nx);
      const int last = clamped(std::floor(xs[i + 1] - 0.5) + 1.0, grid.nx);
      for (int ix = first; ix < last; ++ix) {
        const std::size_t cell = grid.index({ix, iy});
        if (is_cut[cell] == 0) cells[cell] = 1;
      }
    }
  }
}

}  // namespace fairway
