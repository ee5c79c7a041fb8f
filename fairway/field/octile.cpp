#include "fairway/field/octile.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();

// The eight neighbours of a cell that lie on the grid; axial ones first.
struct Neighbours {
  std::array<std::uint32_t, 8> index{};
  int axial = 0;  ///< index[0 .. axial) are axial, index[axial .. count) diagonal
  int count = 0;
};

Neighbours neighbours_of(std::uint32_t cell, int nx, int ny) {
  static constexpr std::array<std::array<int, 2>, 8> steps{
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
  const int ix = static_cast<int>(cell % static_cast<std::uint32_t>(nx));
  const int iy = static_cast<int>(cell / static_cast<std::uint32_t>(nx));
  Neighbours out;
  for (int k = 0; k < 8; ++k) {
    const int x = ix + steps[k][0];
    const int y = iy + steps[k][1];
    if (x < 0 || x >= nx || y < 0 || y >= ny) continue;
    out.index[out.count++] = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(nx) +
                             static_cast<std::uint32_t>(x);
    if (k < 4) out.axial = out.count;
  }
  return out;
}

// A path cost a + b sqrt(2) as two integers; compared in double, exact for all grids that fit.
struct Steps {
  std::int32_t axial = -1;  ///< -1: unreached
  std::int32_t diagonal = 0;
  double cost() const {
    return axial < 0 ? std::numeric_limits<double>::infinity()
                     : axial + diagonal * std::numbers::sqrt2;
  }
};

}  // namespace

std::vector<float> octile_distance(std::span<const std::uint8_t> inside, int nx, int ny,
                                   std::span<const std::uint32_t> sources) {
  require(nx >= 0 && ny >= 0, "octile_distance: sides are not negative");
  const std::size_t cells = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  require(inside.size() == cells, "octile_distance: one entry of `inside` per cell");

  std::vector<Steps> best(cells);
  std::array<std::vector<std::uint32_t>, 3> buckets;
  std::size_t waiting = 0;
  auto offer = [&](std::uint32_t cell, Steps steps) {
    const double old = best[cell].cost();
    const double cost = steps.cost();
    if (inside[cell] == 0 || !(cost < old)) return;
    best[cell] = steps;
    buckets[static_cast<std::size_t>(cost) % 3].push_back(cell);
    ++waiting;
  };
  for (const std::uint32_t source : sources) {
    require(source < cells, "octile_distance: sources lie on the grid");
    offer(source, {0, 0});
  }
  for (std::size_t wave = 0; waiting > 0; ++wave) {
    std::vector<std::uint32_t>& bucket = buckets[wave % 3];
    for (const std::uint32_t cell : bucket) {
      --waiting;
      const Steps here = best[cell];
      if (static_cast<std::size_t>(here.cost()) != wave) continue;  // lowered, and already done
      const Neighbours around = neighbours_of(cell, nx, ny);
      for (int k = 0; k < around.count; ++k) {
        const bool axial = k < around.axial;
        offer(around.index[k], {here.axial + (axial ? 1 : 0), here.diagonal + (axial ? 0 : 1)});
      }
    }
    bucket.clear();
  }
  std::vector<float> cost(cells);
  for (std::size_t i = 0; i < cells; ++i) cost[i] = static_cast<float>(best[i].cost());
  return cost;
}

std::vector<float> paper_wavefront(std::span<const std::uint8_t> inside, int nx, int ny,
                                   std::span<const std::uint32_t> sources, float first,
                                   int sweeps) {
  require(nx >= 0 && ny >= 0, "paper_wavefront: sides are not negative");
  const std::size_t cells = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  require(inside.size() == cells, "paper_wavefront: one entry of `inside` per cell");

  std::vector<float> number(cells, unreached);
  std::vector<std::uint32_t> latest;  // only neighbours of the last numbered cells can be next
  for (const std::uint32_t source : sources) {
    require(source < cells, "paper_wavefront: sources lie on the grid");
    if (number[source] == unreached) latest.push_back(source);
    number[source] = first;
  }
  std::vector<std::uint32_t> candidates;
  std::vector<std::uint8_t> listed(cells, 0);
  std::vector<float> next;
  for (int sweep = 0; !latest.empty() && (sweeps == 0 || sweep < sweeps); ++sweep) {
    candidates.clear();
    for (const std::uint32_t cell : latest) {
      const Neighbours around = neighbours_of(cell, nx, ny);
      for (int k = 0; k < around.count; ++k) {
        const std::uint32_t n = around.index[k];
        if (inside[n] == 0 || number[n] != unreached || listed[n] != 0) continue;
        listed[n] = 1;
        candidates.push_back(n);
      }
    }
    // Every candidate reads the map of the previous sweep; only then are the new numbers written.
    next.clear();
    for (const std::uint32_t cell : candidates) {
      const Neighbours around = neighbours_of(cell, nx, ny);
      float axial = unreached;
      float diagonal = unreached;
      for (int k = 0; k < around.count; ++k) {
        float& least = k < around.axial ? axial : diagonal;
        least = std::min(least, number[around.index[k]]);
      }
      next.push_back(axial != unreached ? axial + 1.0F : diagonal + 1.41F);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) number[candidates[i]] = next[i];
    std::swap(latest, candidates);
  }
  return number;
}

}  // namespace fairway
