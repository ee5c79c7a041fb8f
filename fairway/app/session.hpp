// What every subcommand receives: the global options and the output functions.
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

/// Standard output could not be written.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes to standard output and flushes it. Throws OutputError.
void print(std::string_view text);

/// Writes a line to stderr; failure to do so is ignored.
void complain(std::string_view text) noexcept;

struct Session {
  bool quiet = false;
  bool json = false;
  bool force = false;
  int threads = 0;  ///< 0: all cores

  Existing existing() const { return force ? Existing::replace : Existing::keep; }

  /// Prints the result: `report` with --json, else `text` (nothing with --quiet), like print().
  void tell(const nlohmann::json& report, std::string_view text) const;
  /// Prints warnings and result; returns the exit code: exit_done, or exit_no when unreachable.
  int tell(const RunResult& result) const;
  /// Prints a warning to stderr.
  void warn(std::string_view sentence) const;
};

}  // namespace fairway
