#include "fairway/ceiling/claim_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr int around = 2;  // nodes whose claims are looked up
constexpr int width = 2 * around + 1;

/// Where claims are looked up in the square of a node: one place in each quarter of it. Which one
/// changes from node to node and bin to bin, through all of a fine lattice: walls lie along the
/// nodes, so that the borders of claims do, and places that lay in the same rows everywhere would
/// count all of a border's strip, or none.
class Places {
 public:
  explicit Places(const BallLattice& l)
      : covers_(static_cast<int>(std::ceil(0.70711 * l.spacing * units_per_turn_radius))),
        away_(patterns) {
    for (int pattern = 0; pattern < patterns; ++pattern) {
      for (int place = 0; place < 4; ++place) {
        const double x = 0.5 * (place % 2 + (pattern % fine + 0.5) / fine) - 0.5;
        const double y = 0.5 * (place / 2 + (pattern / fine + 0.5) / fine) - 0.5;
        for (int q = 0; q < width * width; ++q) {
          const double away =
              std::hypot(q % width - around - x, q / width - around - y) * l.spacing;
          away_[static_cast<std::size_t>(pattern)][static_cast<std::size_t>(place)]
               [static_cast<std::size_t>(q)] =
                   static_cast<int>(std::ceil((away + 1e-9) * units_per_turn_radius));
        }
      }
    }
  }

  [[nodiscard]] bool whole(Radius claim) const { return claim >= covers_; }

  [[nodiscard]] int claimed(const BallLattice& l, const std::vector<Radius>& claims, int k, int y,
                            int x) const {
    const Radius* node = &claims[l.at(k, y, x)];
    if (whole(*node)) return 4;
    // Odd: along every axis all patterns take their turns.
    const int pattern = (11 * k + 37 * y + 19 * x) % patterns;
    int count = 0;
    for (const auto& away : away_[static_cast<std::size_t>(pattern)])
      count += holds(node, l.stride, away) ? 1 : 0;
    return count;
  }

 private:
  static constexpr int fine = 8;  // places across a quarter
  static constexpr int patterns = fine * fine;
  /// From the nodes about a node, in units, rounded up.
  using Distances = std::array<int, width * width>;
  static bool holds(const Radius* node, std::ptrdiff_t stride, const Distances& away) {
    for (int q = 0; q < width * width; ++q) {
      const Radius claim = node[(q / width - around) * stride + q % width - around];
      if (claim >= away[static_cast<std::size_t>(q)]) return true;
    }
    return false;
  }

  int covers_;
  std::vector<std::array<Distances, 4>> away_;  // [pattern][quarter]
};

template <typename Body>
void for_cell_bins(const BallLattice& l, const CeilingCells& cells, const Body& body) {
  for_ranges(l.cell_bins(), 256, [&](std::size_t from, std::size_t to) {
    const std::size_t count = cells.obstacle.size();
    for (std::size_t bin = from; bin < to; ++bin) {
      const std::size_t cell = bin % count;
      if (!cells.ordinary(cell)) continue;
      const int ix = static_cast<int>(cell) % l.cells_x;
      const int iy = static_cast<int>(cell) / l.cells_x;
      body(bin, static_cast<int>(bin / count), iy * l.per_cell, ix * l.per_cell);
    }
  });
}

}  // namespace

std::vector<float> claimed_shares(const BallLattice& l, const CeilingCells& cells,
                                  const std::vector<Radius>& claims) {
  std::vector<float> shares(l.cell_bins(), 0.0F);
  const Places places(l);
  for_cell_bins(l, cells, [&](std::size_t bin, int k, int y0, int x0) {
    int claimed = 0;
    for (int y = y0; y < y0 + l.per_cell; ++y) {
      for (int x = x0; x < x0 + l.per_cell; ++x) {
        claimed += places.claimed(l, claims, k, y, x);
      }
    }
    shares[bin] = static_cast<float>(claimed) / static_cast<float>(4 * l.per_cell * l.per_cell);
  });
  return shares;
}

std::vector<std::uint8_t> closed_cell_bins(const BallLattice& l, const CeilingCells& cells,
                                           const std::vector<Radius>& inside,
                                           const std::vector<Radius>& lost) {
  std::vector<std::uint8_t> closed(l.cell_bins(), 1);
  const Places places(l);
  for_cell_bins(l, cells, [&](std::size_t bin, int k, int y0, int x0) {
    bool all_inside = true;
    bool all_lost = true;
    for (int y = y0; y < y0 + l.per_cell; ++y) {
      for (int x = x0; x < x0 + l.per_cell; ++x) {
        const std::size_t at = l.at(k, y, x);
        all_inside = all_inside && places.whole(inside[at]);
        all_lost = all_lost && places.whole(lost[at]);
      }
    }
    closed[bin] = all_inside || all_lost ? 1 : 0;
  });
  return closed;
}

}  // namespace fairway
