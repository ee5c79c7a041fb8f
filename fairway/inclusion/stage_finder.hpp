// How the stages of a lap are found (lap_stages.hpp): leaves are numbered, bends are left by groups
// (lap_stages.cpp), and what laps take is added up (lap_times.cpp).
#pragma once

#include <optional>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/lap_stages.hpp"

namespace fairway {

class StageFinder {
 public:
  StageFinder(const Parts& parts, const Tube& tube, const CrossingGraph& graph, SizeRange speed_mps,
              LapCore& core, GroupRecord& groups)
      : parts_(parts),
        tube_(tube),
        graph_(graph),
        speed_(speed_mps),
        core_(core),
        groups_(groups),
        count_(stages_at_first(tube.length_m(), parts.part_m())) {}

  std::optional<LapStages> run();

 private:
  using Id = CrossingGraph::Id;

  static long stages_at_first(double length_m, double part_m);
  template <typename Body>
  void for_links(const Body& body) const {
    for (Id id = 0; id < graph_.leaves(); ++id) {
      if (!core_.in[id]) continue;
      for (const CrossingLink& link : graph_.links(id)) body(id, link);
    }
  }
  /// From one stage to another, the shorter way round.
  long ahead(long from, long to) const {
    const long on = (to - from) % count_;
    return on > count_ / 2 ? on - count_ : on < (1 - count_) / 2 ? on + count_ : on;
  }

  bool number();
  void raise_behind();
  bool jumps_are_short() const;
  bool join_bends();
  bool leave_bends();
  bool leave_bends(int of_three);
  std::vector<HeadingArc> headings_of_stages(std::vector<bool>& used) const;
  void renumber(const std::vector<long>& now, long count);
  std::vector<Vec2> slowness() const;
  template <typename Body>
  void for_passings(const Body& body) const;
  void begin_where_all_pass_together();
  bool measure();

  const Parts& parts_;
  const Tube& tube_;
  const CrossingGraph& graph_;
  SizeRange speed_;
  LapCore& core_;
  GroupRecord& groups_;
  long count_;
  bool goes_back_ = false;
  std::vector<long> stage_;  // [leaves], from 0
  LapStages made_;
};

}  // namespace fairway
