#include "check/plan_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace fairway_check {
namespace {

using nlohmann::json;

/// The commands of a plan's further modes: an array that few plans have.
constexpr const char* modes_name = "mode_heading_rad";

bool is_command(float rad) {
  return std::isnan(rad) || (rad > -std::numbers::pi && rad <= std::numbers::pi);
}

void require_geometry(const Geometry& g) {
  const auto in = [](double x, double least, double most) { return x >= least && x <= most; };
  const double far = std::min(1e15, 1e9 * g.cell_m);
  require(in(g.cell_m, 1e-15, 1e15) && in(g.x0_m, -far, far) && in(g.y0_m, -far, far) &&
              in(g.speed_mps, 1e-15, 1e15) && g.units == 0x1p32,
          "geometry: expected finite numbers in proportion, and 2^32 units in a side");
  require(g.turn_radius_m > 0.0 && g.turn_radius_m <= 1e9 * g.cell_m,
          "geometry: the cells are far smaller than the turning radius");
}

/// Whether two records place their grids alike; without a frame, the grid places itself.
bool same_frame(const json& a, const json& b) {
  const auto said = [](const json& record, const std::string& place) {
    const json frame = record.value("frame", json());
    const json none = place.starts_with("/world") ? json(0.0) : json();
    return frame.is_null() ? none : frame.value(json::json_pointer(place), none);
  };
  for (const char* place :
       {"/world_from_grid/x_m", "/world_from_grid/y_m", "/world_from_grid/yaw_rad",
        "/georeference/latitude_deg", "/georeference/longitude_deg", "/georeference/worst_error_m",
        "/projected_crs"}) {
    if (said(a, place) != said(b, place)) return false;
  }
  return true;
}

/// Whether [low, low + cell_m] lies in [from, to]; where that depends on rounding, the claim
/// decides.
bool lies_within(double low, double cell_m, double from, double to, bool claimed) {
  const double least = std::min(low - from, to - (low + cell_m));
  return std::abs(least) > 0x1p-49 * (std::abs(low) + cell_m) ? least > 0.0 : claimed;
}

/// To hold is claimed where the plan's mission is out of reach, if the plan has holding places.
void require_holding(const TensorFile& file, const TensorFile& plan) {
  if (!file.tensors.contains("holding")) return;
  const std::vector<std::uint64_t>& grid = file.tensors.at("region").shape;
  const auto holding = values<std::uint8_t>(file, "holding", "U8", grid);
  const auto cost = values<float>(plan, "cost_m", "F32", grid);
  const auto region = values<std::int8_t>(plan, "region", "I8", grid);
  bool same = plan.record.contains("holding_places") && !plan.record["holding_places"].empty();
  for (std::size_t i = 0; i < holding.size(); ++i) {
    same = same && holding[i] == (region[i] != 1 && !std::isfinite(cost[i]) ? 1 : 0);
  }
  require(same, "holding: is not where the plan holds");
}

}  // namespace

void take_plan_arrays(const TensorFile& file, Geometry& geometry, Loop& loop,
                      std::vector<std::int8_t>& region) {
  require(file.tensors.contains("region"), "does not have the arrays of a certificate", unreadable);
  const std::vector<std::uint64_t> grid = file.tensors.at("region").shape;
  require(grid.size() == 2 && grid[0] > 0 && grid[1] > 0 && grid[0] < 1U << 30 &&
              grid[1] < (1U << 30) / grid[0],
          "region: is not a grid", unreadable);
  loop.ny = static_cast<int>(grid[0]);
  loop.nx = static_cast<int>(grid[1]);
  loop.command_rad = values<float>(file, "heading_rad", "F32", grid);
  region = values<std::int8_t>(file, "region", "I8", grid);
  loop.kind = values<std::uint8_t>(file, "cell_kind", "U8", grid);
  const auto numbers = values<double>(file, "geometry", "F64", {6});
  geometry = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
  require_geometry(geometry);
}

std::vector<std::uint8_t> holding_of(const TensorFile& file,
                                     const std::vector<std::int8_t>& region) {
  if (!file.tensors.contains("holding")) return {};
  auto holding = values<std::uint8_t>(file, "holding", "U8", file.tensors.at("region").shape);
  for (std::size_t i = 0; i < holding.size(); ++i) {
    const bool may = region[i] == 0 || region[i] == -1;
    require(holding[i] <= (may ? 1 : 0), "holding: expected 0, or 1 in a free or a buffer cell");
  }
  return holding;
}

void require_digests(const TensorFile& file) {
  const json& claimed = file.record.at("sha256");
  const json& of_plan = file.record.at("plan_sha256");
  for (const auto& [name, tensor] : file.tensors) {
    require(claimed.at(name) == sha256(tensor.bytes),
            name + ": digest mismatch; the file was damaged or altered");
  }
  require(of_plan.at("heading_rad") == claimed.at("heading_rad") &&
              of_plan.at("region") == claimed.at("region"),
          "heading_rad and region are not those of the plan that it names");
}

void require_modes_of_plan(const TensorFile& file) {
  const json& of_plan = file.record.at("plan_sha256");
  const bool has_modes = file.tensors.contains(modes_name);
  require(of_plan.contains(modes_name) == has_modes &&
              (!has_modes || of_plan[modes_name] == file.record.at("sha256").at(modes_name)),
          "mode_heading_rad is not that of the plan that it names");
}

void require_plan(const TensorFile& file, const Geometry& g, const std::string& plan_path) {
  const json& of_plan = file.record.at("plan_sha256");
  const TensorFile plan = read_tensors(plan_path);
  const std::size_t arrays = of_plan.contains(modes_name) ? 4 : 3;
  bool same = plan.tensors.size() == arrays && of_plan.size() == arrays &&
              same_frame(plan.record, file.record);
  for (const auto& [name, tensor] : plan.tensors) {
    std::vector<std::uint64_t> shape = tensor.shape;
    if (name == modes_name && !shape.empty()) shape.erase(shape.begin());  // how many modes
    same = same && of_plan.at(name) == sha256(tensor.bytes) &&
           shape == file.tensors.at("region").shape;
  }
  const json& p = plan.record;
  same = same && p.at("origin_m") == json{g.x0_m, g.y0_m} && p.at("cell_m") == g.cell_m &&
         p.at("vehicle").at("turn_radius_m") == g.turn_radius_m &&
         p.at("vehicle").at("speed_mps") == g.speed_mps;
  require(same, "is not the certificate of the plan " + plan_path);
  require_holding(file, plan);
}

void require_cells(const Geometry& geometry, const Loop& loop,
                   const std::vector<std::int8_t>& region, const json& interest) {
  const bool of_goal = interest == "goal";
  const bool of_obstacles = interest == "obstacle";
  const bool of_cells = interest == "cells";
  const auto box = of_goal || of_obstacles || of_cells ? std::vector<double>(4)
                                                       : interest.get<std::vector<double>>();
  require(box.size() == 4, "region_of_interest: expected four numbers", unreadable);
  for (std::size_t i = 0; i < loop.kind.size(); ++i) {
    const double d = geometry.cell_m;
    const Cell cell = loop.cell_at(i);
    const double x = geometry.x0_m + cell.x * d;
    const double y = geometry.y0_m + cell.y * d;
    const bool said = loop.kind[i] == target;
    const bool is_target = of_goal        ? region[i] == 2
                           : of_obstacles ? region[i] == 1
                           : of_cells     ? region[i] != 1 && said
                                      : region[i] != 1 && lies_within(x, d, box[0], box[2], said) &&
                                            lies_within(y, d, box[1], box[3], said);
    const CellKind kind = is_target ? target : region[i] == 1 ? obstacle : ordinary;
    if (region[i] >= -1 && region[i] <= 2 && loop.kind[i] == kind &&
        is_command(loop.command_rad[i])) {
      continue;
    }
    throw Defect(1, fmt::format("cell ({}, {}): has an invalid command, region or cell_kind",
                                cell.x, cell.y));
  }
}

void require_commands(const Loop& loop) {
  require(std::all_of(loop.command_rad.begin(), loop.command_rad.end(), is_command),
          "mode_heading_rad: has an invalid command");
}

}  // namespace fairway_check
