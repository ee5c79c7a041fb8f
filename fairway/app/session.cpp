#include "fairway/app/session.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace fairway {

void print(std::string_view text) {
  errno = 0;
  const bool put = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (put && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw OutputError(errno == 0 ? "" : std::strerror(errno));
}

void complain(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fputc('\n', stderr);
}

void Session::tell(const nlohmann::json& report, std::string_view text) const {
  if (json) {
    print(report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } else if (!quiet) {
    print(std::string(text) + "\n");
  }
}

int Session::tell(const RunResult& result) const {
  for (const std::string& warning : result.warnings) warn(warning);
  tell(result.summary, result.paragraph);
  return result.unreachable ? exit_no : exit_done;
}

void Session::warn(std::string_view sentence) const {
  complain("fairway: warning: " + std::string(sentence));
}

}  // namespace fairway
