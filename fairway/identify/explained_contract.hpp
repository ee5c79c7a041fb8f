// A contract with a reason for each of its numbers.
#pragma once

#include <string>
#include <vector>

#include "fairway/vehicle/contract.hpp"

namespace fairway {

struct ExplainedContract {
  VehicleContract contract;
  std::vector<std::string> about;  ///< lines on the whole: where it comes from, what it asks for
  /// One reason each, of one line or several.
  std::string command_error;
  std::string heading_error;
  std::string turn_radius;
  std::string speed;
  std::string side_uncertain;
};

}  // namespace fairway
