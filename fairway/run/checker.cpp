#include "fairway/run/checker.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fairway {
namespace {

constexpr int cannot_run = 127;  // what shells say

[[noreturn]] void become(std::vector<char*>& argv, int output) {
  // The child handles the signals again that the parent reserves for a thread.
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  if (output >= 0) {
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
  }
  ::execvp(argv[0], argv.data());
  ::_exit(cannot_run);
}

std::string read_all(int from) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t n = ::read(from, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

std::string checker_program() {
  std::error_code error;
  const auto beside =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "fairway-check";
  if (!error && std::filesystem::exists(beside, error)) return beside.string();
  // The Python module, PREFIX/lib/python3/dist-packages/fairway/*.so, or python/fairway/*.so of a
  // build: bin/ is in a folder above it.
  Dl_info self;
  if (::dladdr(reinterpret_cast<const void*>(&run_checker), &self) != 0) {
    const auto file = std::filesystem::weakly_canonical(self.dli_fname, error);
    for (auto up = file.parent_path(); !error && up.has_relative_path(); up = up.parent_path()) {
      const auto program = up / "bin" / "fairway-check";
      if (std::filesystem::exists(program, error)) return program.string();
    }
  }
  return "fairway-check";
}

CheckRun run_checker(std::vector<std::string> arguments, bool capture) {
  arguments.insert(arguments.begin(), checker_program());
  std::vector<char*> argv;
  for (std::string& word : arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> ends{-1, -1};
  const auto fail = [&](const char* what) {
    const int why = errno;
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
    throw std::system_error(why, std::generic_category(), what);
  };
  if (capture && ::pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe to fairway-check");
  const pid_t child = ::fork();
  if (child < 0) fail("starting fairway-check");
  if (child == 0) become(argv, ends[1]);
  CheckRun run;
  if (capture) {
    ::close(ends[1]);
    ends[1] = -1;
    run.output = read_all(ends[0]);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("waiting for fairway-check");
  }
  if (ends[0] >= 0) ::close(ends[0]);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 70;
  return run;
}

}  // namespace fairway
