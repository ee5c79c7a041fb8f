// Plan of a path mission and contract -> the proof that the vehicle joins the path and follows it:
// what `fairway verify` under a contract proves of such missions.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/inclusion/contract_shares.hpp"
#include "fairway/inclusion/follow_prover.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {

class PathFollower {
 public:
  /// Whether flights should follow a path: that of the mission, or a circle at a goal to hold at.
  static bool is_asked(const Plan& plan, const RegionOfInterest& region);

  /// `question`: of nothing yet (contract_certificate.hpp).
  PathFollower(const Plan& plan, const ContractCertificate& question,
               const InclusionLimits& limits);
  PathFollower(const PathFollower&) = delete;
  PathFollower& operator=(const PathFollower&) = delete;

  /// False: no tube can be proved that is never left.
  bool find_core();
  /// False: a limit stopped it. `earlier`: FollowProver::join.
  bool join(const std::function<void(const InclusionLevel&)>& progress,
            const ContractVerdicts* earlier = nullptr);

  const Following& found() const { return *found_; }
  const Parts& parts() const { return prover_.joining_parts(); }
  const InclusionProver& prover() const { return prover_.joining(); }
  /// What the certificate is about: the line, and the cells that end flights.
  void fill_question(ContractCertificate& certificate) const;
  /// Makes it a certificate of following.
  void fill(ContractCertificate& certificate) const;

 private:
  PathLocator path_;
  std::vector<CellKind> kind_;
  Parts parts_;
  Tube tube_;
  SizeRange speed_mps_;
  FollowProver prover_;
  std::optional<Following> found_;
  std::optional<Vec2> goal_m_;  ///< where to hold
};

/// What includes the exact vehicle, and hardly more: where commands are all the same, arcs of a
/// single heading would be lost in rounding.
[[nodiscard]] VehicleContract nearly_exact(const Vehicle& vehicle);
/// Whether a proof is about hardly more than the exact vehicle.
inline bool is_exact(const ContractCertificate& c) { return c.contract == nearly_exact(c.vehicle); }

/// The contract to prove the plan under: the one it carries, or nearly_exact when it is to follow a
/// path; none when only the exact vehicle's verdicts are asked for.
[[nodiscard]] std::optional<VehicleContract> contract_to_prove(const Plan& plan,
                                                               const RegionOfInterest& region);

/// Cells from which the plan leads to its mission, [iy][ix].
[[nodiscard]] std::vector<bool> usable_cells(const Plan& plan);

/// The object "follow" of summary.json (docs/formats.md).
[[nodiscard]] nlohmann::json following_json(const FollowProof& proof);

/// "a lap takes 145 to 453 s", "it takes at most 20 s to its end": bounds, rounded outwards.
[[nodiscard]] std::string lap_words(const FollowProof& proof);

/// How near, and how fast round.
[[nodiscard]] std::vector<Finding> findings(const FollowProof& proof);

}  // namespace fairway
