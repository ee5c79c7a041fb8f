// Open leaves -> groups, from the ends backwards, and which of them are decided.
//
// A group is a strongly connected component of the open leaves. It is decided when all that comes
// after it is, with one verdict, and its behaviours cannot stay in it: because none comes back, or
// because all headings on the way lie within a right angle of one direction, along which they move
// on. A group without any end, all of whose crossings lie in itself or in trapped leaves, is
// trapped. Within a group that has an end, every leaf may come to that end, so that no part of it
// is trapped: the greatest fixpoint is found on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/inclusion/crossing_graph.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

/// Why a leaf is not decided.
enum class Trouble : std::uint8_t {
  none,
  waits,        ///< for another leaf
  mixed,        ///< several ends, or verdicts, are possible
  gave_up,      ///< too many sets, or a wild part
  no_progress,  ///< its group has no direction along which all move on
};

struct GroupRecord {
  std::vector<float> heading_rad;  ///< [groups], as in contract_verdicts.hpp
  std::vector<float> flown;        ///< [groups], in parts, at most, to the end
  /// As in contract_verdicts.hpp, of the first groups; of those after them: no_mode.
  std::vector<std::uint8_t> next_mode{};

  /// There is a group 0, that of nobody.
  void begin();
  std::uint32_t add(float group_heading_rad, float group_flown);
};

/// Whether the halves of a leaf that is not decided may be.
enum class CutHope : std::uint8_t {
  none,
  faint,  ///< it meets nothing decided but only itself, or gave up
  fair    ///< it meets something decided, besides what is not
};

struct Deciding {
  std::size_t decided = 0;    ///< leaves, this time
  std::vector<CutHope> hope;  ///< [slots], of open leaves
  /// [slots], of open leaves: the leaf that it waits for, itself if it is the trouble, and why.
  std::vector<CrossingGraph::Id> cause;
  std::vector<Trouble> trouble;
};

/// Decides what can be decided; new groups are added to `groups`.
[[nodiscard]] Deciding decide_groups(const Parts& parts, CrossingGraph& graph, GroupRecord& groups);

}  // namespace fairway
