// That behaviours join a path and follow it for ever: fixpoints on the graph of leaves.
//
// *Stay*: the greatest set of leaves from which every behaviour stays near the path and crosses
// into leaves of the set, or comes to the end of an open path. *Core*: of a closed path, what leads
// on from groups in which a behaviour may be for ever, because they have no direction in which all
// move on: the round trips. All others are on their way to them. Of an open path, what leads on
// from leaves beside the line. *Go round*: the core has stages (lap_stages.hpp), or groups that
// lead to the end. *Join*: the least fixpoint towards the core, as for a goal.
//
// Properties that always hold, when a core was found: those of follow_proof.hpp; and verdict reach
// of a leaf says that its behaviours come to the core, within its group's time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/inclusion/lap_stages.hpp"
#include "fairway/inclusion/tube.hpp"

namespace fairway {

struct FollowOptions {
  InclusionLimits limits;
  int stay_levels = 2;  ///< how often leaves near the path are halved
  bool laps = true;     ///< a closed path is gone round; else it is enough to stay near it
};

/// The core, in numbers.
struct Following {
  double tube_m = 0.0;   ///< largest distance of the tube
  double off_rad = 0.0;  ///< largest angle
  double lap_least_s = 0.0;
  double lap_most_s = 0.0;  ///< of an open path: to its end
  std::vector<TubeStretch> tube;
  std::size_t staying = 0;  ///< leaves from which behaviours stay near the path
  std::size_t core = 0;     ///< leaves
};

class FollowProver {
 public:
  /// Keeps references to both. The goal of the parts is the end of an open path; a closed one has
  /// none.
  FollowProver(const Parts& parts, const Tube& tube, const FollowOptions& options);

  /// None: no behaviour is proved to stay within the tube and to go round.
  std::optional<Following> find_core(SizeRange speed_mps);
  /// After find_core has found one: false when a limit stopped it. `earlier`: a proof of the same
  /// parts, to go on cutting where it ended; nothing of it is believed.
  bool join(const std::function<void(const InclusionLevel&)>& progress,
            const ContractVerdicts* earlier = nullptr);

  const InclusionProver& joining() const { return *joining_; }
  /// Of states that have not joined yet: nothing is claimed of those that come to the end of an
  /// open path without it.
  const Parts& joining_parts() const { return *joining_parts_; }
  struct Proved {
    ContractVerdicts verdicts;
    FollowProof proof;  ///< without its path
  };
  [[nodiscard]] Proved proved(double speed_least_mps) const;

 private:
  using Id = CrossingGraph::Id;

  void set_aside_far_leaves();
  std::vector<bool> near_path() const;
  void remove_leaks(std::vector<bool>& stays) const;
  std::vector<Id> round_trips(const std::vector<bool>& stays) const;
  std::vector<Id> beside_line(const std::vector<bool>& stays) const;
  void take_core(std::vector<Id> seeds);
  bool goes_on(SizeRange speed_mps);
  bool leads_to_end(SizeRange speed_mps);
  void take_one_stage(float time_s);
  void measure_tube(Following& found);
  template <typename Body>
  void for_targets(Id id, const Body& body) const;

  const Parts& parts_;
  const Tube& tube_;
  FollowOptions options_;
  CrossingGraph graph_;
  LapCore core_;
  LapStages stages_;
  std::vector<TubeStretch> stretches_;  ///< of the tube
  GroupRecord groups_;
  std::optional<Parts> joining_parts_;
  std::optional<InclusionProver> joining_;
};

}  // namespace fairway
