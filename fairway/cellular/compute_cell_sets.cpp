#include "fairway/cellular/compute_cell_sets.hpp"

#include "fairway/base/error.hpp"
#include "fairway/cellular/border_backward_set.hpp"
#include "fairway/cellular/border_forward_set.hpp"

namespace fairway {

CellSets compute_cell_sets(const Direction& command, const CellShape& shape, int places) {
  require(places >= 1, "cellular sets have at least one place");
  CellSets sets;
  sets.shape = shape;
  sets.command = command;
  for (int i = 0; i < places; ++i) sets.along_m.push_back(shape.cell_m * (i + 0.5) / places);
  for (const Side entry : all_sides) {
    for (const Side exit : all_sides) {
      CellSets::Row& theta =
          sets.theta[static_cast<std::size_t>(entry)][static_cast<std::size_t>(exit)];
      CellSets::Row& phi =
          sets.phi[static_cast<std::size_t>(entry)][static_cast<std::size_t>(exit)];
      for (const double along_m : sets.along_m) {
        theta.push_back(backward_headings_on_border(entry, along_m, command, shape, exit));
        phi.push_back(forward_headings(entry, exit, along_m, command, shape));
      }
    }
  }
  return sets;
}

}  // namespace fairway
