// Where the claims of a ceiling are made: nodes on a lattice of places, for bins of headings.
//
// All lengths are in turn radii, so that an arc is as long as its turn is wide, and the speed is 1.
// A claim is a whole number of `units` (a radius): it says that something holds of every state of a
// bin of headings whose place is no farther than that from the node. Zero says nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fairway {

using Radius = std::int16_t;
inline constexpr int units_per_turn_radius = 2048;
inline constexpr int widest_claim = 3072;
/// Nodes are worked on in tiles: so many columns and rows, of one bin.
inline constexpr int tile_columns = 32;
inline constexpr int tile_rows = 8;

struct BallLattice {
  int cells_x = 0;
  int cells_y = 0;
  int per_cell = 1;   ///< nodes along a cell's side
  int headings = 36;  ///< bins; bin k holds the headings from k * bin_rad to (k + 1) * bin_rad
  int turn_bins = 2;  ///< bins that a full turn crosses in one step
  double spacing = 0.0;
  double bin_rad = 0.0;
  double step = 0.0;  ///< length of a step, and the widest turn in it
  int nx = 0;
  int ny = 0;
  int margin = 0;  ///< nodes stored beyond each side: whatever a step from the lattice may ask for
  int stride = 0;
  int tiles_x = 0;
  int tiles_y = 0;
  std::size_t plane = 0;  ///< nodes stored for each bin

  [[nodiscard]] std::size_t size() const { return plane * static_cast<std::size_t>(headings); }
  [[nodiscard]] std::size_t at(int k, int y, int x) const {
    return static_cast<std::size_t>(k) * plane +
           static_cast<std::size_t>(y + margin) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(x + margin);
  }
  [[nodiscard]] std::size_t tiles() const {
    return static_cast<std::size_t>(headings) * static_cast<std::size_t>(tiles_x * tiles_y);
  }
  [[nodiscard]] std::size_t tile(int k, int ty, int tx) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(tiles_y) +
            static_cast<std::size_t>(ty)) *
               static_cast<std::size_t>(tiles_x) +
           static_cast<std::size_t>(tx);
  }
  [[nodiscard]] std::size_t cell_bins() const {
    return static_cast<std::size_t>(headings) * static_cast<std::size_t>(cells_x) *
           static_cast<std::size_t>(cells_y);
  }
  [[nodiscard]] std::size_t cell_bin(int k, int iy, int ix) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells_y) +
            static_cast<std::size_t>(iy)) *
               static_cast<std::size_t>(cells_x) +
           static_cast<std::size_t>(ix);
  }
  [[nodiscard]] int bin(int k) const { return (k % headings + headings) % headings; }
};

/// The lattice of a level over cells of side `cell` (turn radii): every level has twice as many
/// bins as the one before, and nodes half as far apart.
[[nodiscard]] BallLattice ball_lattice(int cells_x, int cells_y, double cell, int level);

}  // namespace fairway
