// What was proved about a plan under a vehicle contract, with everything queries and the checker
// need.
//
// Properties that always hold: those of plan.hpp for the arrays taken from the plan; kind follows
// from region and region_of_interest (cell_kinds); those of contract_verdicts.hpp for the parts of
// the plan's cells (parts()).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/map/region.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct ContractCertificate {
  Grid grid;
  Vehicle vehicle;  ///< the plan's, which keeps the contract
  VehicleContract contract;
  int parts_per_cell = 1;
  RegionOfInterest region_of_interest;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<CellKind> kind;      ///< [iy][ix]
  /// [iy][ix], 1 out of the mission's reach, where the plan holds (holding_cells); empty: nowhere.
  /// A state that is proved `trapped` is told to `hold` there.
  std::vector<std::uint8_t> holding;
  ContractVerdicts verdicts;  ///< of the plan's own mode
  /// Commands of further modes, [mode - 1][iy][ix], and what is proved of them, joined
  /// (contract_modes.hpp). Empty: there are none, or they are not proved.
  std::vector<float> mode_heading_rad;
  ContractVerdicts mode_verdicts;
  /// That a path is followed: verdict reach of a leaf then says that its behaviours join the core.
  std::optional<FollowProof> follow;
  PlanDigests plan;            ///< which plan it belongs to
  std::optional<Frame> frame;  ///< where the plan's grid lies; none when the plan did not say
  /// How it was found and its overall results, one JSON object.
  std::string evidence_json = "{}";

  Flow flow() const {
    return {grid, vehicle, heading_rad.data(), kind.data(),
            holding.empty() ? nullptr : holding.data()};
  }
  /// Of the motions over ground that include all that keeps the contract (over_ground). Nothing is
  /// claimed of who comes to the end of an open path without having joined it.
  Parts parts() const;
  int further_modes() const {
    return grid.size() == 0 ? 0 : static_cast<int>(mode_heading_rad.size() / grid.size());
  }
  /// Those of a further mode, 1 or more.
  Parts parts_of_mode(int mode) const;
  ContractVerdictsView verdicts_of_mode(int mode) const {
    return mode_of_joined(mode_verdicts, verdicts.first.size() - 1, mode);
  }
  double least_speed_mps() const { return over_ground(contract).speed_mps.least; }
};

/// Everything in its file except its arrays, one JSON object with sorted keys.
[[nodiscard]] std::string record_text(const ContractCertificate& certificate);

}  // namespace fairway
