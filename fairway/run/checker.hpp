// The independent program, fairway-check, as a step of a job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fairway {

/// `fairway-check` next to the running program, else as the shell finds it.
[[nodiscard]] std::string checker_program();

struct CheckRun {
  int exit_code = 0;   ///< 0 accepted, 1 refused; else as of any command; 127: could not be run
  std::string output;  ///< what it printed, when it was captured
};

/// Runs it with `arguments`; its output is the caller's, or captured.
[[nodiscard]] CheckRun run_checker(std::vector<std::string> arguments, bool capture);

}  // namespace fairway
