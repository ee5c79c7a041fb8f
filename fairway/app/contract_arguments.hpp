// The options of fairway contract.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fairway/identify/commands_in_force.hpp"
#include "fairway/identify/known_vehicle.hpp"

namespace fairway {

struct ContractArguments {
  KnownVehicle vehicle;
  std::string bank_limit;
  std::string turn_rate;
  std::string heading_error;
  std::string holds = "course";
  std::vector<std::string> logs;
  std::string columns;
  std::string angles;
  std::optional<double> tracking_m;
  double margin = 0.0;
  bool hold_sides = false;
  std::filesystem::path contract;
  std::filesystem::path picture;
  std::filesystem::path output;

  SideRule sides() const { return hold_sides ? SideRule::contract : SideRule::each_command; }
};

/// How the vehicle turns, what errors it has, and its logs.
void declare_turn(CLI::App& options, ContractArguments& arguments);
void declare_errors(CLI::App& options, ContractArguments& arguments);
void declare_logs(CLI::App& options, ContractArguments& arguments);

}  // namespace fairway
