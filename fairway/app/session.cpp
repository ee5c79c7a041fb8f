#include "fairway/app/session.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace fairway {

void Session::tell(const nlohmann::json& report, std::string_view text) const {
  if (json) {
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (!quiet) {
    fmt::print("{}\n", text);
  }
  std::fflush(stdout);
}

int Session::tell(const RunResult& result) const {
  for (const std::string& warning : result.warnings) warn(warning);
  tell(result.summary, result.paragraph);
  return result.unreachable ? exit_no : exit_done;
}

void Session::warn(std::string_view sentence) const {
  fmt::print(stderr, "fairway: warning: {}\n", sentence);
}

}  // namespace fairway
