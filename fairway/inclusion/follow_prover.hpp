// That behaviours join a path and follow it for ever: fixpoints on the graph of leaves.
//
// *Stay*: the greatest set of leaves from which every behaviour stays near the path and crosses
// into leaves of the set. *Core*: of these, what leads on from groups in which a behaviour may be
// for ever, because they have no direction in which all move on: the round trips. All others are on
// their way to them. *Go round*: in the core all headings lie within a right angle of the path's
// tangents, so that the nearest point of the path moves on at no less than a known speed; where the
// path bends too sharply for that, groups of leaves have a direction in which all move on. *Join*:
// the least fixpoint towards the core, as for a goal.
//
// Properties that always hold, when a core was found:
//   1. A behaviour from a leaf of the core is for ever no farther from the path than the profile
//      says, heads no farther from the tangent, and goes round once in lap_least_s to lap_most_s.
//   2. Verdict reach of a leaf says that its behaviours come to the core, within its group's time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fairway/inclusion/inclusion_prover.hpp"
#include "fairway/inclusion/tube.hpp"

namespace fairway {

struct FollowOptions {
  InclusionLimits limits;
  int stay_levels = 2;  ///< how often leaves near the path are halved
};

/// Between two stations of the path, of all that follow it.
struct TubeStretch {
  double distance_m = 0.0;  ///< from the path, at most
  double off_rad = 0.0;     ///< from the tangent, at most
};

struct Following {
  double tube_m = 0.0;   ///< largest distance of the profile
  double off_rad = 0.0;  ///< largest angle
  double lap_least_s = 0.0;
  double lap_most_s = 0.0;
  std::vector<TubeStretch> profile;  ///< equal stretches, from the path's first vertex
  std::size_t staying = 0;           ///< leaves from which behaviours stay near the path
  std::size_t core = 0;              ///< leaves
};

class FollowProver {
 public:
  /// Keeps references to both. The path of the tube is closed.
  FollowProver(const Parts& parts, const Tube& tube, const FollowOptions& options);

  /// None: no behaviour is proved to stay within the tube and to go round.
  std::optional<Following> find_core(SizeRange speed_mps);
  /// After find_core has found one: false when a limit stopped it.
  bool join(const std::function<void(const InclusionLevel&)>& progress);

  const InclusionProver& joining() const { return *joining_; }

 private:
  using Id = CrossingGraph::Id;

  void set_aside_far_leaves();
  std::vector<bool> near_path() const;
  void remove_leaks(std::vector<bool>& stays) const;
  std::vector<bool> core_of(const std::vector<bool>& stays) const;
  bool measure(const std::vector<bool>& core, SizeRange speed_mps, Following& found) const;
  bool passes_gates(const std::vector<bool>& core, double long_m) const;
  double least_lap_m(double aside_m) const;
  static void close_as_core(Leaf& leaf);
  static GroupRecord groups_to_core();
  double through_bends(const std::vector<bool>& core, const std::vector<bool>& bent,
                       std::size_t margin) const;
  template <typename Body>
  void for_targets(Id id, const Body& body) const;

  const Parts& parts_;
  const Tube& tube_;
  FollowOptions options_;
  CrossingGraph graph_;
  std::vector<std::uint32_t> part_of_;  // [leaves]
  std::vector<bool> core_;              // [leaves]
  std::optional<InclusionProver> joining_;
};

}  // namespace fairway
