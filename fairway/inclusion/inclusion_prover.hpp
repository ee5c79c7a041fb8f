// Plan and contract -> a verdict for every leaf (contract_verdicts.hpp).
//
// Round by round: fresh leaves are flown, groups are decided from the ends backwards
// (decide_groups.hpp), and of what is left, leaves are cut in halves where that may help: where
// their image meets something decided, or themselves, or is unknown.
//
// Properties that always hold: every verdict is proved (docs/trust.md); more work only turns
// undecided into proved; the result depends on the plan, the contract and the options alone, not on
// threads, unless a limit of time stopped the work.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_hand_over.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/crossing_graph.hpp"
#include "fairway/inclusion/decide_groups.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

struct InclusionLimits {
  int first_level = 1;  ///< a side starts as 2^first_level leaves
  int last_level = 6;   ///< no leaf is shorter than a side / 2^last_level
  int faint_level = 4;  ///< nor than a side / 2^faint_level where hope is faint
  /// No leaf shorter than a side / 2^hand_over_level is asked whether it is handed over: the error
  /// of the vehicle's estimate is added to all of them.
  int hand_over_level = 2;
  std::size_t memory_bytes = 0;  ///< 0: none
  /// A level that decides less than this share of all sides is the last.
  double least_gain = 0.0005;
  std::function<bool()> go_on = [] { return true; };  ///< asked by several threads at once
  BehaviourOptions flight;
};

struct InclusionLevel {
  int level = 0;
  std::size_t leaves = 0;
  std::size_t undecided = 0;
  double undecided_share = 0.0;  ///< of the length of all sides that are crossed
};

class InclusionProver {
 public:
  /// Keeps a reference to `parts`.
  InclusionProver(const Parts& parts, const InclusionLimits& limits);

  /// Goes on from a graph with leaves that are decided, and their groups.
  InclusionProver(const Parts& parts, const InclusionLimits& limits, CrossingGraph graph,
                  GroupRecord groups)
      : parts_(parts), limits_(limits), graph_(std::move(graph)), groups_(std::move(groups)) {}

  /// Proves a further mode: leaves may be handed over to these, the modes before it, in order. What
  /// is pointed to has to outlive the proof. Before run().
  void hand_over_to(std::vector<const ReachBoxes*> earlier, const EstimateError& error,
                    double speed_least_mps) {
    earlier_ = std::move(earlier);
    error_ = error;
    speed_least_mps_ = speed_least_mps;
  }

  /// Leaves begin as in an earlier proof of the same parts, whose verdicts are found again. Before
  /// run().
  void start_from(const ContractVerdicts& earlier) { graph_.begin_as(earlier); }

  /// False: a limit stopped it.
  bool run(const std::function<void(const InclusionLevel&)>& progress);

  const CrossingGraph& graph() const { return graph_; }
  const Deciding& last() const { return last_; }  ///< why leaves are undecided
  [[nodiscard]] ContractVerdicts verdicts(double speed_least_mps) const;

 private:
  InclusionLevel level_now(int level) const;
  std::vector<bool> to_cut(int level) const;
  void cut(const std::vector<bool>& which);
  void hand_over_fresh();

  const Parts& parts_;
  InclusionLimits limits_;
  CrossingGraph graph_;
  GroupRecord groups_;
  Deciding last_;
  std::vector<const ReachBoxes*> earlier_;
  EstimateError error_;
  double speed_least_mps_ = 0.0;  ///< that the times of earlier modes were found with
  std::map<std::pair<std::uint8_t, float>, std::uint32_t> group_handed_;  ///< by mode and length
};

}  // namespace fairway
