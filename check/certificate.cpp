#include "check/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "check/tensors.hpp"

namespace fairway_check {
namespace {

using nlohmann::json;
using Shape = std::vector<std::uint64_t>;

template <typename T>
std::vector<T> values(const TensorFile& file, const char* name, const char* type,
                      const Shape& shape) {
  const auto found = file.tensors.find(name);
  require(found != file.tensors.end() && found->second.type == type && found->second.shape == shape,
          fmt::format("{}: is missing, or its type or shape does not match the others", name),
          unreadable);
  require(reinterpret_cast<std::uintptr_t>(found->second.bytes.data()) % sizeof(T) == 0,
          fmt::format("{}: is not aligned to its element size", name), unreadable);
  std::vector<T> all(found->second.bytes.size() / sizeof(T));
  if (!all.empty()) std::memcpy(all.data(), found->second.bytes.data(), found->second.bytes.size());
  return all;
}

void take_arrays(const TensorFile& file, Certificate& c) {
  require(file.tensors.contains("region") && file.tensors.size() == 9,
          "does not have the arrays of a certificate", unreadable);
  const Shape grid = file.tensors.at("region").shape;
  require(grid.size() == 2 && grid[0] > 0 && grid[1] > 0 && grid[0] < 1U << 30 &&
              grid[1] < (1U << 30) / grid[0],
          "region: is not a grid", unreadable);
  c.loop.ny = static_cast<int>(grid[0]);
  c.loop.nx = static_cast<int>(grid[1]);
  c.loop.command_rad = values<float>(file, "heading_rad", "F32", grid);
  c.region = values<std::int8_t>(file, "region", "I8", grid);
  c.loop.kind = values<std::uint8_t>(file, "cell_kind", "U8", grid);
  c.first = values<std::uint32_t>(file, "section_first", "U32", {4 * c.loop.kind.size() + 1});
  const Shape leaves{c.first.back()};
  c.begin = values<std::uint32_t>(file, "leaf_begin", "U32", leaves);
  c.rank = values<std::uint32_t>(file, "leaf_rank", "U32", leaves);
  c.time_s = values<float>(file, "leaf_time_s", "F32", leaves);
  c.verdict = values<std::uint8_t>(file, "leaf_verdict", "U8", leaves);
  const auto numbers = values<double>(file, "geometry", "F64", {6});
  c.geometry = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

void require_geometry(const Geometry& g) {
  const auto in = [](double x, double least, double most) { return x >= least && x <= most; };
  const double far = std::min(1e15, 1e9 * g.cell_m);
  require(in(g.cell_m, 1e-15, 1e15) && in(g.x0_m, -far, far) && in(g.y0_m, -far, far) &&
              in(g.speed_mps, 1e-15, 1e15) && g.units == 0x1p32,
          "geometry: expected finite numbers in proportion, and 2^32 units in a side");
  require(g.cell_m < g.turn_radius_m && g.turn_radius_m <= 1e9 * g.cell_m,
          "geometry: the cells are not smaller than the turning radius, or are far too small");
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

/// Digests of the arrays in the file.
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

/// Requires that it belongs to this plan: arrays, vehicle, grid and frame.
void require_plan(const TensorFile& file, const Geometry& g, const std::string& plan_path) {
  const json& of_plan = file.record.at("plan_sha256");
  const TensorFile plan = read_tensors(plan_path);
  bool same =
      plan.tensors.size() == 3 && of_plan.size() == 3 && same_frame(plan.record, file.record);
  for (const auto& [name, tensor] : plan.tensors) {
    same = same && of_plan.at(name) == sha256(tensor.bytes) &&
           tensor.shape == file.tensors.at("region").shape;
  }
  const json& p = plan.record;
  same = same && p.at("origin_m") == json{g.x0_m, g.y0_m} && p.at("cell_m") == g.cell_m &&
         p.at("vehicle").at("turn_radius_m") == g.turn_radius_m &&
         p.at("vehicle").at("speed_mps") == g.speed_mps;
  require(same, "is not the certificate of the plan " + plan_path);
}

/// Whether [low, low + cell_m] lies in [from, to]; where that depends on rounding, the claim
/// decides.
bool lies_within(double low, double cell_m, double from, double to, bool claimed) {
  const double least = std::min(low - from, to - (low + cell_m));
  return std::abs(least) > 0x1p-49 * (std::abs(low) + cell_m) ? least > 0.0 : claimed;
}

/// `interest`: "goal", "obstacle", a rectangle, or "cells": those that cell_kind calls targets.
void require_cells(const Certificate& c, const json& interest) {
  const bool of_goal = interest == "goal";
  const bool of_obstacles = interest == "obstacle";
  const bool of_cells = interest == "cells";
  const auto box = of_goal || of_obstacles || of_cells ? std::vector<double>(4)
                                                       : interest.get<std::vector<double>>();
  require(box.size() == 4, "region_of_interest: expected four numbers", unreadable);
  for (std::size_t i = 0; i < c.loop.kind.size(); ++i) {
    const double d = c.geometry.cell_m;
    const Cell cell = c.loop.cell_at(i);
    const double x = c.geometry.x0_m + cell.x * d;
    const double y = c.geometry.y0_m + cell.y * d;
    const double h = c.loop.command_rad[i];
    const bool said = c.loop.kind[i] == target;
    const bool is_target = of_goal        ? c.region[i] == 2
                           : of_obstacles ? c.region[i] == 1
                           : of_cells
                               ? c.region[i] != 1 && said
                               : c.region[i] != 1 && lies_within(x, d, box[0], box[2], said) &&
                                     lies_within(y, d, box[1], box[3], said);
    const CellKind kind = is_target ? target : c.region[i] == 1 ? obstacle : ordinary;
    if (c.region[i] >= -1 && c.region[i] <= 2 && c.loop.kind[i] == kind &&
        (std::isnan(h) || (h > -std::numbers::pi && h <= std::numbers::pi))) {
      continue;
    }
    throw Defect(1, fmt::format("cell ({}, {}): has an invalid command, region or cell_kind",
                                cell.x, cell.y));
  }
}

void require_leaves(const Certificate& c) {
  require(c.first.front() == 0 && std::is_sorted(c.first.begin(), c.first.end()),
          "section_first: does not ascend from 0");
  for (std::size_t s = 0; s + 1 < c.first.size(); ++s) {
    const int side = static_cast<int>(s % 4);
    const bool has_leaves = c.loop.kind[s / 4] == ordinary &&
                            !std::isnan(c.loop.command_rad[s / 4]) &&
                            positive(into_frame(side, c.loop.direction[s / 4]).x) &&
                            c.loop.kind_at(c.loop.beyond(s)) == ordinary;
    require((c.first[s] < c.first[s + 1]) == has_leaves,
            "a section has leaves where it cannot have any, or none where it must");
    for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
      const double t = c.time_s[leaf];
      const bool in_order =
          leaf == c.first[s] ? c.begin[leaf] == 0 : c.begin[leaf - 1] < c.begin[leaf];
      const bool meaningful = c.verdict[leaf] == undecided ? c.rank[leaf] == 0 && t == 0.0
                              : c.verdict[leaf] == trapped
                                  ? c.rank[leaf] == 0 && t > std::numeric_limits<float>::max()
                                  : c.verdict[leaf] < trapped && t >= 0.0 && std::isfinite(t);
      if (in_order && meaningful) continue;
      require(false, c.name_of(leaf) + (in_order ? ": has an invalid verdict, rank or time"
                                                 : ": leaves do not ascend from the side's start"));
    }
  }
}

}  // namespace

std::size_t Certificate::section_of(std::size_t leaf) const {
  const auto next = std::upper_bound(first.begin(), first.end(), leaf);
  return static_cast<std::size_t>(next - first.begin()) - 1;
}

std::string Certificate::name_of(std::size_t leaf) const {
  const std::size_t s = section_of(leaf);
  const Cell cell = loop.cell_at(s / 4);
  return fmt::format("leaf {} ({} on side {} of cell ({}, {}))", leaf, leaf - first[s], s % 4,
                     cell.x, cell.y);
}

Certificate read_certificate(const std::string& path, const std::string& plan) {
  const TensorFile file = read_tensors(path);
  Certificate c;
  c.record = file.record;
  require(file.record.at("format") != "fairway-bitmap",
          "is a bitmap, a picture drawn from samples: it claims no proof, so there is nothing to "
          "check",
          unreadable);
  require(file.record.at("format") == "fairway-certificate" &&
              file.record.at("format_version").is_number_unsigned() &&
              file.record.at("format_version") == 1 && file.record.at("method") == "certified",
          "is not a certificate of format_version 1 and method \"certified\"", unreadable);
  require_digests(file);
  take_arrays(file, c);
  if (!plan.empty()) require_plan(file, c.geometry, plan);
  require_geometry(c.geometry);
  require_cells(c, file.record.at("region_of_interest"));
  c.loop.take_directions(c.geometry.turn_radius_m, c.geometry.cell_m);
  require_leaves(c);
  return c;
}

}  // namespace fairway_check
