// Where a step leads, as what it asks of claims about the states at its end.
//
// A step is flight over the lattice's `step`. From the states within distance a of a node it ends,
// in the bin that it leads to, within a + cost of the node that is `columns` and `rows` away. So a
// claim of a + cost there holds of all of them.
#pragma once

#include <vector>

#include "fairway/ceiling/ball_lattice.hpp"

namespace fairway {

struct StepEnd {
  int columns = 0;
  int rows = 0;
  Radius cost = 0;
};

/// [bin][turn_bins + bins turned]: the ends of all steps of a kind.
struct StepStencils {
  std::vector<std::vector<std::vector<StepEnd>>> ends;
  /// How far ends lie from their nodes, per bin: least and most columns, least and most rows.
  struct Reach {
    int left = 0;
    int right = 0;
    int down = 0;
    int up = 0;
  };
  std::vector<Reach> reach;
};

/// Of every control: whatever it is, the step ends in one of the bins. For what must hold for all.
[[nodiscard]] StepStencils steps_of_every_control(const BallLattice& lattice);
/// Of constant turns, one for each bin: for what needs one control.
[[nodiscard]] StepStencils steps_of_constant_turns(const BallLattice& lattice);

}  // namespace fairway
