// What is proved of a plan with all its modes, for lookups: a view that owns nothing, so that it
// can refer to a mapped file.
//
// A mode is a field of commands over the plan's cells (hand_over.hpp). The first one, 0, is the
// mission's; further ones are flown from states that it does not bring, until it does.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"

namespace fairway {

struct ProofView {
  Flow flow;                           ///< of the first mode
  SectionView sections;                ///< of the first mode
  int further = 0;                     ///< modes after the first
  const float* further_rad = nullptr;  ///< [further][iy][ix]
  /// Of the further modes, one after another: section s of mode k is number 4 cells (k - 1) + s.
  SectionView further_sections;

  int modes() const { return further + 1; }
  Flow flow_of(int mode) const {
    if (mode == 0) return flow;
    Flow of = flow;
    of.heading_rad = further_rad + static_cast<std::size_t>(mode - 1) * flow.grid.size();
    of.holding = nullptr;
    return of;
  }
  SectionView sections_of(int mode) const {
    if (mode == 0) return sections;
    SectionView of = further_sections;
    of.first += static_cast<std::size_t>(mode - 1) * 4 * flow.grid.size();
    return of;
  }
};

}  // namespace fairway
