#include "fairway/field/transition.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/distance_transform.hpp"

namespace fairway {
namespace {

// One kind of edge: the nearest edge cell of every cell, and the reach of its transition region.
struct Edge {
  const std::vector<std::uint32_t>* nearest;
  float mu;
  float width_cells;                              ///< sigma_* r
  const std::vector<PathCell>* fading = nullptr;  ///< an open path's cells: there it fades out
};

struct NearestEdge {
  std::uint32_t cell = no_feature;
  float distance_cells = 0.0F;
  const Edge* edge = nullptr;
};

NearestEdge nearest_edge(int nx, std::size_t i, const std::vector<Edge>& edges) {
  NearestEdge best;
  const auto n = static_cast<std::uint32_t>(nx);
  const auto self = static_cast<std::uint32_t>(i);
  for (const Edge& edge : edges) {
    const std::uint32_t to = (*edge.nearest)[i];
    if (to == no_feature) continue;
    const auto dx = static_cast<float>(static_cast<int>(to % n) - static_cast<int>(self % n));
    const auto dy = static_cast<float>(static_cast<int>(to / n) - static_cast<int>(self / n));
    const float distance = std::sqrt(dx * dx + dy * dy);
    if (best.edge == nullptr || distance < best.distance_cells) best = {to, distance, &edge};
  }
  return best;
}

// Turns (cx, cy) towards (ex, ey) by `share` of the angle between them; exactly opposite vectors
// turn left.
void turn_towards(float& cx, float& cy, float ex, float ey, float share, float angle_rad) {
  const float side = cx * ey - cy * ex >= 0.0F ? 1.0F : -1.0F;
  const float turn = side * share * angle_rad;
  const float c = std::cos(turn);
  const float s = std::sin(turn);
  const float x = c * cx - s * cy;  // Eq. 14
  cy = s * cx + c * cy;
  cx = x;
}

// Of a path's cells, ascending, the one at `index`.
const PathCell& path_cell_at(const std::vector<PathCell>& cells, std::uint32_t index) {
  return *std::lower_bound(cells.begin(), cells.end(), index,
                           [](const PathCell& c, std::uint32_t i) { return c.index < i; });
}

std::vector<std::uint32_t> nearest_path_cell(const Grid& grid, const CompleteMap& complete) {
  std::vector<std::uint8_t> on_path(grid.size(), 0);
  for (const PathCell& cell : complete.path_cells) on_path[cell.index] = 1;
  std::vector<std::uint32_t> nearest(grid.size());
  distance_transform(on_path, grid.nx, grid.ny, {{}, nearest});
  return nearest;
}

}  // namespace

float transition_share(float ratio, float angle_rad, float mu, Blend blend) {
  const float a = mu * ratio * angle_rad / static_cast<float>(pi);  // Eq. 16
  if (blend == Blend::paper) return 1.0F - a;
  return (1.0F - a) * (1.0F - std::pow(ratio, 1.0F / mu));
}

float share_near_open_end(double to_end_m, double cell_m, double turn_radius_m) {
  constexpr double length_radii = 0.5;
  // A path cell that holds the end is less than a cell from it.
  const double ratio = (to_end_m - cell_m) / (length_radii * turn_radius_m);
  return static_cast<float>(std::clamp(ratio, 0.0, 1.0));
}

VectorField transition_field(const Grid& grid, const CompleteMap& complete,
                             const BufferBorder& border, const VectorField& raw,
                             const Vehicle& vehicle, const FieldOptions& options) {
  const auto width_cells = [&](double sigma) {
    return static_cast<float>(sigma * vehicle.turn_radius_m / grid.cell_m);
  };
  std::vector<std::uint32_t> nearest_path;
  std::vector<Edge> edges;
  if (!complete.path_cells.empty() && options.sigma_path > 0.0) {
    nearest_path = nearest_path_cell(grid, complete);
    const bool fades =
        options.blend == Blend::continuous && std::isfinite(complete.path_cells.front().to_end_m);
    edges.push_back({&nearest_path, static_cast<float>(options.mu_path),
                     width_cells(options.sigma_path), fades ? &complete.path_cells : nullptr});
  }
  if (options.sigma_border > 0.0) {
    edges.push_back({&border.nearest, static_cast<float>(options.mu_border),
                     width_cells(options.sigma_border), nullptr});
  }
  VectorField out = raw;
  if (edges.empty()) return out;
  for_ranges(grid.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const float cx = raw.x[i];
      const float cy = raw.y[i];
      if (complete.region[i] == Region::obstacle || (cx == 0.0F && cy == 0.0F)) continue;
      const NearestEdge near = nearest_edge(grid.nx, i, edges);
      if (near.edge == nullptr || near.cell == i || near.distance_cells > near.edge->width_cells)
        continue;
      const float ex = raw.x[near.cell];
      const float ey = raw.y[near.cell];
      const float angle = std::acos(std::clamp(cx * ex + cy * ey, -1.0F, 1.0F));  // Eq. 17
      const float ratio = near.distance_cells / near.edge->width_cells;
      float share = transition_share(ratio, angle, near.edge->mu, options.blend);
      if (near.edge->fading != nullptr) {
        const PathCell& cell = path_cell_at(*near.edge->fading, near.cell);
        share *= share_near_open_end(cell.to_end_m, grid.cell_m, vehicle.turn_radius_m);
      }
      turn_towards(out.x[i], out.y[i], ex, ey, share, angle);
    }
  });
  return out;
}

}  // namespace fairway
