// What every certificate takes over from its plan: the grid, and arrays by cell.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/flight.hpp"
#include "check/tensors.hpp"

namespace fairway_check {

/// The array "geometry", number by number.
struct Geometry {
  double x0_m;
  double y0_m;
  double cell_m;
  double turn_radius_m;
  double speed_mps;
  double units;  ///< in a side
};

/// An array, whose type and shape must be these.
template <typename T>
std::vector<T> values(const TensorFile& file, const std::string& name, const char* type,
                      const std::vector<std::uint64_t>& shape) {
  const auto found = file.tensors.find(name);
  require(found != file.tensors.end() && found->second.type == type && found->second.shape == shape,
          name + ": is missing, or its type or shape does not match the others", unreadable);
  require(reinterpret_cast<std::uintptr_t>(found->second.bytes.data()) % sizeof(T) == 0,
          name + ": is not aligned to its element size", unreadable);
  std::vector<T> all(found->second.bytes.size() / sizeof(T));
  if (!all.empty()) std::memcpy(all.data(), found->second.bytes.data(), found->second.bytes.size());
  return all;
}

/// Fills grid and arrays of `loop` but for its radius and directions. Throws Defect 65 or 1.
void take_plan_arrays(const TensorFile& file, Geometry& geometry, Loop& loop,
                      std::vector<std::int8_t>& region);

/// Digests of the arrays in the file.
void require_digests(const TensorFile& file);

/// Of an exact certificate: it has the commands of all modes that its plan has.
void require_modes_of_plan(const TensorFile& file);

/// Requires that it belongs to this plan: arrays, vehicle, grid and frame, and where it holds.
void require_plan(const TensorFile& file, const Geometry& g, const std::string& plan_path);

/// The array "holding", which only names what trapped states do: they hold. Empty when there is
/// none.
std::vector<std::uint8_t> holding_of(const TensorFile& file,
                                     const std::vector<std::int8_t>& region);

/// Commands, regions and kinds that can be, targets where the record says. `interest`: "goal",
/// "obstacle", a rectangle, or "cells": those that cell_kind calls targets.
void require_cells(const Geometry& geometry, const Loop& loop,
                   const std::vector<std::int8_t>& region, const nlohmann::json& interest);

/// Commands that can be, of a further mode.
void require_commands(const Loop& loop);

}  // namespace fairway_check
