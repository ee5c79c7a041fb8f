// fairway-check: re-proves a certificate, with no code of the program that made it.
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include "check/proof.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

struct Arguments {
  std::string certificate;
  std::string plan;
  std::size_t samples = 20000;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  bool json = false;
  bool quiet = false;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("certificate", a.certificate, "of \"fairway verify\"")
      ->required()
      ->type_name("CERT");
  app.add_option("--plan", a.plan, "refuse unless it is the certificate of this plan")
      ->type_name("PLAN");
  app.add_option("--samples", a.samples,
                 "states that measure the claimed shares of volume; 0: none")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1} << 30))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--threads", a.threads, "default: all cores; the answer does not depend on it")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}))
      ->type_name("N");
  app.add_flag("--json", a.json, "print one JSON object");
  app.add_flag("--quiet", a.quiet, "print nothing but the answer");
  app.set_version_flag("--version", "fairway-check " FAIRWAY_VERSION);
  app.footer(
      "Exit codes: 0 accepted, 1 refused, 64 wrong usage, 65 no readable certificate, 70 our "
      "fault.");
}

int run(const Arguments& a) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, a.threads);
  const auto began = std::chrono::steady_clock::now();
  nlohmann::ordered_json report{
      {"certificate", a.certificate}, {"accepted", false}, {"reason", nullptr}};
  const std::string defect = judge(a.certificate, a.plan, a.samples, report);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  report["accepted"] = defect.empty();
  if (!defect.empty()) report["reason"] = defect;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  report["wall_s"] = wall.count();
  report["peak_rss_bytes"] = usage.ru_maxrss * 1024;
  if (a.json) {
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (!defect.empty()) {
    fmt::print("{}: REFUSED: {}\n", a.certificate, defect);
  } else {
    fmt::print("{}: accepted\n", a.certificate);
    if (!a.quiet)
      fmt::print(
          "Leaves re-proved: {} (undecided: nothing claimed). {} sampled states agree with the "
          "claimed shares.\n{:.2f} s on {} threads.\n",
          report["leaves"].dump(), a.samples, wall.count(), a.threads);
  }
  return defect.empty() ? 0 : 1;
}

}  // namespace
}  // namespace fairway_check

int main(int count, char** words) {
  CLI::App app("fairway-check: re-proves a certificate independently", "fairway-check");
  fairway_check::Arguments arguments;
  const auto failed = [&](const char* what, int code) {
    fmt::print(stderr, "fairway-check: {}: {}\n", arguments.certificate, what);
    return code;
  };
  try {
    fairway_check::declare(app, arguments);
    app.parse(count, words);
    return fairway_check::run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 64;
  } catch (const fairway_check::Defect& defect) {
    return failed(defect.what(), defect.code);
  } catch (const nlohmann::json::exception& error) {
    return failed((std::string("is not understood: ") + error.what()).c_str(), 65);
  } catch (const std::exception& error) {
    return failed(error.what(), 70);
  }
}
