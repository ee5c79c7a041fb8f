// What every subcommand is given: the global options, and the ways to speak.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "fairway/base/atomic_file.hpp"
#include "fairway/run/run.hpp"

namespace fairway {

/// Exit codes, as `fairway --help` lists them.
enum ExitCode : int {
  exit_done = 0,
  exit_no = 1,
  exit_usage = 64,
  exit_input = 65,
  exit_fault = 70
};

struct Session {
  bool quiet = false;
  bool json = false;
  bool force = false;
  int threads = 0;  ///< 0: all cores

  Existing existing() const { return force ? Existing::replace : Existing::keep; }

  /// The result: `report` with --json, else `text` (nothing with --quiet). To stdout.
  void tell(const nlohmann::json& report, std::string_view text) const;
  /// Warnings, result, and the exit code it stands for: exit_done, or exit_no when unreachable.
  int tell(const RunResult& result) const;
  /// What the user should know; to stderr.
  void warn(std::string_view sentence) const;
};

}  // namespace fairway
