// The core of a graph of leaves -> the stages of its lap (follow_proof.hpp), or none when it is not
// proved to go round.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fairway/inclusion/crossing_graph.hpp"
#include "fairway/inclusion/decide_groups.hpp"
#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/tube.hpp"

namespace fairway {

/// The leaves that follow, of a graph; [leaves] each.
struct LapCore {
  std::vector<std::uint32_t> part;
  std::vector<bool> in;
  std::vector<std::uint16_t> stage;  ///< found: from 1; 0: not in the core
  std::vector<std::uint32_t> group;  ///< found: core_group, or one that was added
};

/// The group of all that have come to the core: nothing remains to be done.
inline constexpr std::uint32_t core_group = 1;

/// Whoever comes to this leaf has come to the core.
void close_as_core(Leaf& leaf);
/// Group 0, as everywhere, and core_group.
[[nodiscard]] GroupRecord groups_to_core();

/// None: the core is not proved to go round. New groups are added to `groups`, groups_to_core()
/// before.
[[nodiscard]] std::optional<LapStages> find_lap_stages(const Parts& parts, const Tube& tube,
                                                       const CrossingGraph& graph,
                                                       SizeRange speed_mps, LapCore& core,
                                                       GroupRecord& groups);

}  // namespace fairway
