// A child process, used line by line through its stdin and stdout.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace fairway::bench {

class ChildProcess {
 public:
  /// argv[0] is the program, a path or a name on PATH. Throws std::runtime_error.
  explicit ChildProcess(const std::vector<std::string>& argv);
  ~ChildProcess();  ///< closes its stdin and waits for it to end
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void write_line(const std::string& line);
  /// The next line without its line ending; nothing when the program has ended.
  std::optional<std::string> read_line();

 private:
  pid_t pid_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
};

}  // namespace fairway::bench
