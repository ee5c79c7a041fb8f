// fairway check: hands a certificate to the independent program beside this one.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fairway/app/command.hpp"
#include "fairway/base/error.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
  fs::path certificate;
  fs::path plan;
};

/// `fairway-check` beside this program, else wherever the shell finds it.
std::string checker() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = self.parent_path() / "fairway-check";
  return !error && fs::exists(beside) ? beside.string() : "fairway-check";
}

int check_command(const CheckArguments& a, const Session& session) {
  std::vector<std::string> words{checker(), a.certificate.string()};
  if (!a.plan.empty()) words.insert(words.end(), {"--plan", a.plan.string()});
  if (session.json) words.emplace_back("--json");
  if (session.quiet) words.emplace_back("--quiet");
  if (session.threads > 0) {
    words.insert(words.end(), {"--threads", std::to_string(session.threads)});
  }
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  if (child == 0) {
    // The signals that this program keeps for a thread of its own are the child's again.
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    ::execvp(argv[0], argv.data());
    fmt::print(stderr, "fairway: cannot run {}: {}\n", words[0], std::strerror(errno));
    ::_exit(exit_fault);
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) {
    throw std::system_error(errno, std::generic_category(), "running " + words[0]);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(exit_fault);
}

}  // namespace

Action declare_check(CLI::App& options) {
  auto arguments = std::make_shared<CheckArguments>();
  options.add_option("certificate", arguments->certificate, "the certificate")
      ->required()
      ->type_name("CERT");
  options.add_option("--plan", arguments->plan, "the plan it is to be a certificate of")
      ->type_name("PLAN");
  options.footer(
      "Re-proves every claim with a separate program, fairway-check. Exit code 0: accepted; 1: "
      "refused, with the reason.");
  return [arguments](const Session& session) { return check_command(*arguments, session); };
}

}  // namespace fairway
