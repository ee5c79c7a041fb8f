// fairway-check: re-proves a certificate, without any code of the program that made it.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <thread>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include "check/proof.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

struct Request {
  std::string certificate;
  std::string plan;
  std::size_t samples = 20000;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  bool json = false;
  bool quiet = false;
};

void declare(CLI::App& app, Request& r) {
  app.add_option("CERT", r.certificate, "certificate made by \"fairway verify\"")->required();
  app.add_option("--plan", r.plan, "refuse unless it is the certificate of this plan");
  app.add_option("--samples", r.samples, "states sampled to measure the claimed shares; 0: none")
      ->check(CLI::Range(0, 1 << 30))
      ->capture_default_str();
  app.add_option("--threads", r.threads, "default: all cores; the answer does not depend on it")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--json", r.json, "print one JSON object");
  app.add_flag("--quiet", r.quiet, "print only the answer");
  app.set_version_flag("--version", "fairway-check " FAIRWAY_VERSION);
  app.footer(
      "Exit codes: 0 accepted, 1 refused, 64 wrong usage, 65 certificate not readable, 70 "
      "internal error, 74 standard output could not be written.");
}

int run(const Request& r) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, r.threads);
  const auto began = std::chrono::steady_clock::now();
  nlohmann::ordered_json report{{"certificate", r.certificate}, {"accepted", false}};
  const std::string defect = judge(r.certificate, r.plan, r.samples, report);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  report["accepted"] = defect.empty();
  report["reason"] = defect.empty() ? nlohmann::json() : nlohmann::json(defect);
  report["wall_s"] = wall.count();
  const std::string not_proved =
      std::string("program, options, levels and stopped_by") +
      (r.plan.empty() ? "; without --plan, frame, the digest of cost_m, where the plan holds, and "
                        "that a path, or a goal to hold at, is the plan's"
                      : "");
  report["not_proved"] = not_proved;
  std::string answer = defect.empty() ? "accepted" : "REFUSED: " + defect;
  if (defect.empty() && !r.quiet) {
    answer += fmt::format(
        "\nLeaves re-proved: {} (undecided: nothing claimed). {} sampled states agree with the "
        "claimed shares.\nNot proved: {}.\n{:.2f} s on {} threads.",
        report["leaves"].dump(), r.samples, not_proved, wall.count(), r.threads);
  }
  using Invalid = nlohmann::json::error_handler_t;
  std::cout << (r.json ? report.dump(2, ' ', false, Invalid::replace)
                       : r.certificate + ": " + answer)
            << '\n';
  return defect.empty() ? 0 : 1;
}

}  // namespace
}  // namespace fairway_check

/// An answer that could not be written does not count: 0 becomes 74.
int when_written(int code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return code;
  std::cerr << "fairway-check: standard output could not be written\n";
  return code == 0 ? 74 : code;
}

int checked(int count, char** words) {
  CLI::App app("fairway-check: re-proves a certificate independently", "fairway-check");
  fairway_check::Request request;
  const auto failed = [&request](std::string_view what, int code) {
    std::cerr << "fairway-check: " << request.certificate << ": " << what << '\n';
    return code;
  };
  try {
    fairway_check::declare(app, request);
    app.parse(count, words);
    return fairway_check::run(request);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 64;
  } catch (const fairway_check::Defect& defect) {
    return failed(defect.what(), defect.code);
  } catch (const nlohmann::json::exception& error) {
    return failed(std::string("cannot be understood: ") + error.what(), 65);
  } catch (const std::exception& error) {
    return failed(error.what(), 70);
  }
}

int main(int count, char** words) { return when_written(checked(count, words)); }
