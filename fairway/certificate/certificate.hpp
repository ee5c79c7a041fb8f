// A certificate: what was proved about a plan, with everything queries and the checker need.
//
// Properties that always hold: those of plan.hpp for the arrays taken from the plan; kind follows
// from region and region_of_interest (cell_kinds); those of section_verdicts.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"
#include "fairway/map/region.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/proof_view.hpp"
#include "fairway/verify/region_of_interest.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

struct Certificate {
  Grid grid;
  Vehicle vehicle;
  RegionOfInterest region_of_interest;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<CellKind> kind;      ///< [iy][ix]
  /// [iy][ix], 1 out of the mission's reach, where the plan holds (holding_cells); empty: nowhere.
  /// A state that is proved `trapped` is told to `hold` there.
  std::vector<std::uint8_t> holding;
  SectionVerdicts sections;  ///< of the first mode
  /// Commands of further modes, [mode - 1][iy][ix], and what is proved of them, one after another
  /// (proof_view.hpp); empty: none.
  std::vector<float> mode_heading_rad;
  SectionVerdicts mode_sections;
  PlanDigests plan;            ///< which plan it belongs to
  std::optional<Frame> frame;  ///< where the plan's grid lies; none when the plan did not say
  /// How it was found and its overall results, one JSON object: program, options, volumes, levels.
  std::string evidence_json = "{}";

  Flow flow() const {
    return {grid, vehicle, heading_rad.data(), kind.data(),
            holding.empty() ? nullptr : holding.data()};
  }
  int further_modes() const {
    return grid.size() == 0 ? 0 : static_cast<int>(mode_heading_rad.size() / grid.size());
  }
  /// For lookups; refers to this certificate.
  ProofView view() const {
    return {flow(), sections.view(), further_modes(), mode_heading_rad.data(),
            mode_sections.view()};
  }
};

/// Everything in a certificate's file except its arrays, one JSON object with sorted keys.
[[nodiscard]] std::string record_text(const Certificate& certificate);

}  // namespace fairway
