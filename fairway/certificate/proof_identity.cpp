#include "fairway/certificate/proof_identity.hpp"

#include <span>

#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/base/frame_json.hpp"

namespace fairway {
namespace {

/// Of a region of cells those that are its targets count: obstacles never are.
nlohmann::json region_identity(const RegionOfInterest& interest, const Grid& grid,
                               const std::vector<Region>& region) {
  nlohmann::json known = {static_cast<int>(interest.kind), interest.rectangle_m};
  if (interest.kind != RegionOfInterest::Kind::cells) return known;
  if (interest.cells.size() != grid.size()) {  // of another grid: of no proof about this one
    known.push_back(interest.cells.size());
  } else {
    const std::vector<std::uint8_t> target = target_cells(grid, region, interest);
    known.push_back(sha256_hex(std::as_bytes(std::span(target))));
  }
  return known;
}

std::string identity(const Grid& grid, const Vehicle& vehicle, const std::optional<Frame>& frame,
                     const nlohmann::json& region, const PlanDigests& arrays) {
  nlohmann::json all = {
      {"cells", {grid.nx, grid.ny}},
      {"geometry", {grid.x0_m, grid.y0_m, grid.cell_m, vehicle.turn_radius_m, vehicle.speed_mps}},
      {"frame", json_of(frame.value_or(Frame{}))},
      {"region_of_interest", region},
      {"arrays", {arrays.heading_rad, arrays.cost_m, arrays.region}}};
  if (!arrays.mode_heading_rad.empty()) all["arrays"].push_back(arrays.mode_heading_rad);
  const std::string text = all.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return sha256_hex(std::as_bytes(std::span(text)));
}

}  // namespace

std::string proof_identity(const Certificate& c) {
  return identity(c.grid, c.vehicle, c.frame,
                  region_identity(c.region_of_interest, c.grid, c.region), c.plan);
}

std::string proof_identity(const Plan& plan, const RegionOfInterest& region) {
  return identity(plan.grid, plan.vehicle, plan.record.frame,
                  region_identity(region, plan.grid, plan.region), plan_digests(plan));
}

}  // namespace fairway
