// Handing over from one mode of a plan to an earlier one.
//
// A mode is a field of commands of its own over the same cells. The vehicle flies one mode and may
// change to an earlier one, never back. It may change where its states meet the section
// (section_flight.hpp): a leaf of a mode is handed over to an earlier mode when *all* states of the
// leaf, each flying by the earlier mode's commands from there, are proved to reach.
#pragma once

#include <cstdint>
#include <span>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/section_view.hpp"

namespace fairway {

struct ModeView {
  Flow flow;  ///< its commands; grid, vehicle and kinds as in every mode
  SectionView sections;
};

/// A set of modes, a bit for each; all of them.
using ModeSet = std::uint64_t;
static_assert(most_modes <= 64);
inline constexpr ModeSet every_mode = ~ModeSet{0};

struct HandOver {
  std::uint8_t mode = no_mode;  ///< the first of `earlier` that is proved to reach from all states
  double time_s = 0.0;          ///< bound of the time to reach, from here
  bool in_part = false;         ///< none is, but some states may be proved: a smaller leaf might be
  ModeSet worth_asking = 0;  ///< of parts of the leaf: the others are proved to reach from no state
};

/// What the leaf's states, which leave its cell by the command of `flow`, do under those earlier
/// modes that are `asked`.
[[nodiscard]] HandOver hand_over(const Flow& flow, LeafPlace leaf,
                                 std::span<const ModeView> earlier, int most_crossings,
                                 ModeSet asked = every_mode);

}  // namespace fairway
