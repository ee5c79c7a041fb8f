// fairway check: passes a certificate to the independent program fairway-check.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/run/checker.hpp"

namespace fairway {
namespace {

struct CheckArguments {
  std::filesystem::path certificate;
  std::filesystem::path plan;
  std::string samples;
};

int check_command(const CheckArguments& a, const Session& session) {
  std::vector<std::string> words{a.certificate.string()};
  if (!a.plan.empty()) words.insert(words.end(), {"--plan", a.plan.string()});
  if (!a.samples.empty()) words.insert(words.end(), {"--samples", a.samples});
  if (session.json) words.emplace_back("--json");
  if (session.quiet) words.emplace_back("--quiet");
  if (session.threads > 0) {
    words.insert(words.end(), {"--threads", std::to_string(session.threads)});
  }
  const CheckRun run = run_checker(std::move(words), false);
  if (run.exit_code != 127) return run.exit_code;
  complain(fmt::format("fairway: cannot run {}: expected it next to fairway", checker_program()));
  return exit_fault;
}

}  // namespace

Action declare_check(CLI::App& options) {
  auto arguments = std::make_shared<CheckArguments>();
  options.add_option("certificate", arguments->certificate, "the certificate")
      ->required()
      ->type_name("CERT");
  options.add_option("--plan", arguments->plan, "also check that it is a certificate of this plan")
      ->type_name("PLAN");
  options
      .add_option("--samples", arguments->samples,
                  "states sampled to compare the claimed shares with (default 20000)")
      ->check(CLI::Range(0, 1 << 30))
      ->type_name("N");
  options.footer(
      "Re-proves every claim with an independent program, fairway-check. Exit code 0: accepted; 1: "
      "refused, with the reason.");
  return [arguments](const Session& session) { return check_command(*arguments, session); };
}

}  // namespace fairway
