// The states given on a command line: in metres, in degrees, or in a CSV file of either.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct StatesAsked {
  std::vector<std::string> metres;   ///< --state X,Y,H
  std::vector<std::string> degrees;  ///< --state-deg LAT,LON,COURSE
  std::filesystem::path file;        ///< --states CSV; - for standard input

  bool empty() const { return metres.empty() && degrees.empty() && file.empty(); }
  bool may_be_in_degrees() const { return !degrees.empty() || !file.empty(); }
};

/// Declares --state, --state-deg and --states. `noun`: "start" or "state", for the help texts.
void declare_states(CLI::App& options, StatesAsked& asked, const std::string& noun);

/// In order: those in metres, those in degrees, those of the file. `frame`: of the plan or the
/// certificate in `file`. Throws InputError for degrees when it is not georeferenced.
[[nodiscard]] std::vector<State> states_of(const StatesAsked& asked, const Frame& frame,
                                           const std::filesystem::path& file);

}  // namespace fairway
