// The tube about a path that whoever follows it is proved never to leave, as an outline to draw.
#pragma once

#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/follow_proof.hpp"

namespace fairway {

/// Closed lines, each repeating its first vertex at the end: the tube's places lie to their left,
/// so that filling them all leaves its holes out. Approximated on a lattice of `step_m`, or coarser
/// when the tube is more than 1500 steps across; off by less than a step but where the tube's width
/// jumps. Cost: a search for the nearest point of the path at every place of the lattice.
[[nodiscard]] std::vector<std::vector<Vec2>> tube_outline(const FollowProof& proof, double step_m);

/// The tube's largest distance from the line that is followed.
[[nodiscard]] double widest_m(const FollowProof& proof);

}  // namespace fairway
