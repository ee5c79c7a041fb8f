// The options of commands that start from a map.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "fairway/map/read_map.hpp"

namespace fairway {

struct MapArguments {
  std::filesystem::path file;
  std::optional<double> cell_m;
  std::optional<double> resolution_m;
  std::optional<double> altitude_m;
  std::string inclusion;  ///< "all", "any", or empty
  std::optional<double> turn_radius_m;

  /// Its cell_m is 1 when none was given.
  [[nodiscard]] MapRequest request() const;
};

/// MAP, --cell, --resolution, --altitude, --inclusion, --turn-radius.
void declare_map(CLI::App& options, MapArguments& arguments);

}  // namespace fairway
