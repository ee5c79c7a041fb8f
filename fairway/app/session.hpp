// What every subcommand is given: the global options, and the ways to speak.
#pragma once

#include <stdexcept>
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
  exit_fault = 70,
  exit_output = 74
};

/// What was to be told could not be written to standard output.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// To standard output, and on to where it leads. Throws OutputError.
void print(std::string_view text);

/// A line to stderr. Where that cannot be written there is nobody to tell.
void complain(std::string_view text) noexcept;

struct Session {
  bool quiet = false;
  bool json = false;
  bool force = false;
  int threads = 0;  ///< 0: all cores

  Existing existing() const { return force ? Existing::replace : Existing::keep; }

  /// The result: `report` with --json, else `text` (nothing with --quiet). To stdout, like print().
  void tell(const nlohmann::json& report, std::string_view text) const;
  /// Warnings, result, and the exit code it stands for: exit_done, or exit_no when unreachable.
  int tell(const RunResult& result) const;
  /// What the user should know; to stderr.
  void warn(std::string_view sentence) const;
};

}  // namespace fairway
