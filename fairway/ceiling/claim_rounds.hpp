// Claims that follow from each other, step by step, until nothing changes.
//
// Two kinds, told apart by `every`:
//   - some control (rising): a claim is made of states from which one constant turn leads to states
//     that are claimed already. It begins with what is certain and may stop at any time.
//   - every control (falling): everything is claimed that is not refuted, and a claim falls where
//     some control may lead to states that are not claimed. What is left once nothing falls any
//     more supports itself; before that it is worth nothing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fairway/ceiling/ball_lattice.hpp"
#include "fairway/ceiling/step_stencils.hpp"

namespace fairway {

inline constexpr int tile_nodes = tile_columns * tile_rows;
using TileClaims = std::array<Radius, tile_nodes>;

struct ClaimRounds {
  const BallLattice& lattice;
  const StepStencils& steps;
  bool every = false;
  std::vector<Radius> claims;       ///< lattice.size(): where rounds begin, and what they found
  std::vector<std::uint32_t> open;  ///< the tiles to work on, ascending; others keep their claims
  std::vector<TileClaims> least;    ///< [open]: claims that hold anyway
  std::vector<TileClaims> most;     ///< [open]: what following claims may be at most
};

/// What follows for the nodes of a tile from the claims at the ends of its steps.
[[nodiscard]] TileClaims claims_after_step(const ClaimRounds& rounds, std::uint32_t tile);

/// False when `stop` was true before nothing changed any more.
[[nodiscard]] bool settle(ClaimRounds& rounds, const std::function<bool()>& stop);

}  // namespace fairway
