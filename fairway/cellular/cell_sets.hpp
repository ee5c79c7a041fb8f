// Paper 2's cellular sets of one cell under its command, tabulated: Theta and Phi of every pair of
// borders, at places spread evenly along a border.
//
// Theta of (entry, exit) at a place of `entry`: the headings that enter there and lead out by
// `exit` (section III.C). Phi of (entry, exit) at a place of `exit`: the headings with which a
// vehicle that came in anywhere on `entry` can leave there (section IV). Headings between the
// tabulated places come from the formulas, not from the table.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fairway/cellular/border_heading_set.hpp"
#include "fairway/vehicle/cell_motion.hpp"
#include "fairway/vehicle/cell_shape.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

inline constexpr std::array<Side, 4> all_sides{Side::right, Side::top, Side::left, Side::bottom};

constexpr const char* name_of(Side side) {
  constexpr std::array<const char*, 4> names{"right", "top", "left", "bottom"};
  return names[static_cast<std::size_t>(side)];
}

struct CellSets {
  using Row = std::vector<HeadingSet>;              ///< [places], along +x or +y
  using Table = std::array<std::array<Row, 4>, 4>;  ///< [entry][exit]

  CellShape shape;
  Direction command;
  std::vector<double> along_m;  ///< [places]: the middles of equal pieces of a side
  Table theta;
  Table phi;

  const Row& theta_of(Side entry, Side exit) const { return at(theta, entry, exit); }
  const Row& phi_of(Side entry, Side exit) const { return at(phi, entry, exit); }

 private:
  static const Row& at(const Table& table, Side entry, Side exit) {
    return table[static_cast<std::size_t>(entry)][static_cast<std::size_t>(exit)];
  }
};

}  // namespace fairway
