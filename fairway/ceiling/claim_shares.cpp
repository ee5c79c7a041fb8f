#include "fairway/ceiling/claim_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr int around = 2;  // nodes whose claims are looked up
constexpr int width = 2 * around + 1;

/// The distances, in units rounded up, from the nodes about a node to the four places of its
/// square.
class Places {
 public:
  explicit Places(const BallLattice& l)
      : covers_(static_cast<int>(std::ceil(0.70711 * l.spacing * units_per_turn_radius))) {
    for (int place = 0; place < 4; ++place) {
      const double x = place % 2 == 0 ? -0.25 : 0.25;
      const double y = place / 2 == 0 ? -0.25 : 0.25;
      for (int q = 0; q < width * width; ++q) {
        const double away = std::hypot(q % width - around - x, q / width - around - y) * l.spacing;
        away_[static_cast<std::size_t>(place)][static_cast<std::size_t>(q)] =
            static_cast<int>(std::ceil((away + 1e-9) * units_per_turn_radius));
      }
    }
  }

  [[nodiscard]] bool whole(Radius claim) const { return claim >= covers_; }

  [[nodiscard]] int claimed(const Radius* node, std::ptrdiff_t stride) const {
    if (whole(*node)) return 4;
    int count = 0;
    for (const auto& away : away_) count += holds(node, stride, away) ? 1 : 0;
    return count;
  }

 private:
  using Distances = std::array<int, width * width>;
  static bool holds(const Radius* node, std::ptrdiff_t stride, const Distances& away) {
    for (int q = 0; q < width * width; ++q) {
      const Radius claim = node[(q / width - around) * stride + q % width - around];
      if (claim >= away[static_cast<std::size_t>(q)]) return true;
    }
    return false;
  }

  int covers_;
  std::array<Distances, 4> away_;
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
      body(bin, l.at(static_cast<int>(bin / count), iy * l.per_cell, ix * l.per_cell));
    }
  });
}

}  // namespace

std::vector<float> claimed_shares(const BallLattice& l, const CeilingCells& cells,
                                  const std::vector<Radius>& claims) {
  std::vector<float> shares(l.cell_bins(), 0.0F);
  const Places places(l);
  for_cell_bins(l, cells, [&](std::size_t bin, std::size_t corner) {
    int claimed = 0;
    for (int y = 0; y < l.per_cell; ++y) {
      for (int x = 0; x < l.per_cell; ++x) {
        claimed += places.claimed(&claims[corner] + y * l.stride + x, l.stride);
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
  for_cell_bins(l, cells, [&](std::size_t bin, std::size_t corner) {
    bool all_inside = true;
    bool all_lost = true;
    for (int y = 0; y < l.per_cell; ++y) {
      for (int x = 0; x < l.per_cell; ++x) {
        const std::size_t at = corner + static_cast<std::size_t>(y * l.stride + x);
        all_inside = all_inside && places.whole(inside[at]);
        all_lost = all_lost && places.whole(lost[at]);
      }
    }
    closed[bin] = all_inside || all_lost ? 1 : 0;
  });
  return closed;
}

}  // namespace fairway
