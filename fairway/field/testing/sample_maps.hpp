// Maps, turns and thread counts for the tests of this folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "fairway/base/grid.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway::samples {

/// A grid of booleans, [iy][ix].
struct Mask {
  int nx = 0;
  int ny = 0;
  std::vector<std::uint8_t> cells;

  Mask(int columns, int rows, std::uint8_t value = 0)
      : nx(columns),
        ny(rows),
        cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}
  std::uint8_t& at(int ix, int iy) { return cells[index(ix, iy)]; }
  std::uint8_t at(int ix, int iy) const { return cells[index(ix, iy)]; }
  std::uint32_t index(int ix, int iy) const {
    return static_cast<std::uint32_t>(iy) * static_cast<std::uint32_t>(nx) +
           static_cast<std::uint32_t>(ix);
  }
  Mask inverted() const {
    Mask out(nx, ny);
    for (std::size_t i = 0; i < cells.size(); ++i) out.cells[i] = cells[i] == 0 ? 1 : 0;
    return out;
  }
};

/// '#' is 1; the first line is the top row.
inline Mask drawn(const std::vector<std::string>& lines) {
  Mask out(static_cast<int>(lines.front().size()), static_cast<int>(lines.size()));
  for (int row = 0; row < out.ny; ++row) {
    for (int ix = 0; ix < out.nx; ++ix) {
      const char c = lines[static_cast<std::size_t>(row)][static_cast<std::size_t>(ix)];
      out.at(ix, out.ny - 1 - row) = c == '#' ? 1 : 0;
    }
  }
  return out;
}

/// Each cell is 1 with the given chance.
inline Mask speckled(Random& random, int nx, int ny, double density) {
  Mask out(nx, ny);
  for (auto& cell : out.cells) cell = random.unit() < density ? 1 : 0;
  return out;
}

/// Discs of 1 at random places with random radii, some cut by a thin wall.
inline Mask blobs(Random& random, int nx, int ny, int count, double largest_radius_cells) {
  Mask out(nx, ny);
  for (int k = 0; k < count; ++k) {
    const double x = random.uniform(0.0, nx);
    const double y = random.uniform(0.0, ny);
    const double radius = random.uniform(0.5, largest_radius_cells);
    for (int iy = 0; iy < ny; ++iy) {
      for (int ix = 0; ix < nx; ++ix) {
        const double dx = ix + 0.5 - x;
        const double dy = iy + 0.5 - y;
        if (dx * dx + dy * dy <= radius * radius) out.at(ix, iy) = 1;
      }
    }
  }
  return out;
}

inline ObstacleMap map_of(const Mask& obstacle, double cell_m, double x0_m = 0.0,
                          double y0_m = 0.0) {
  ObstacleMap map;
  map.grid = {obstacle.nx, obstacle.ny, x0_m, y0_m, cell_m};
  map.obstacle = obstacle.cells;
  return map;
}

/// An array [iy][ix] turned by +90 degrees: cell (ix, iy) goes to (ny - 1 - iy, ix).
template <typename T>
std::vector<T> quarter_turned(const std::vector<T>& in, int nx, int ny) {
  std::vector<T> out(in.size());
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      out[static_cast<std::size_t>(ix) * static_cast<std::size_t>(ny) +
          static_cast<std::size_t>(ny - 1 - iy)] =
          in[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
             static_cast<std::size_t>(ix)];
    }
  }
  return out;
}

/// An array [iy][ix] mirrored east for west.
template <typename T>
std::vector<T> mirrored(const std::vector<T>& in, int nx, int ny) {
  std::vector<T> out(in.size());
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const std::size_t row = static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx);
      out[row + static_cast<std::size_t>(nx - 1 - ix)] = in[row + static_cast<std::size_t>(ix)];
    }
  }
  return out;
}

/// body() on `threads` threads, as with the command's --threads.
template <typename Body>
auto on_threads(int threads, const Body& body) {
  const tbb::global_control bound(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(body);
}

}  // namespace fairway::samples
