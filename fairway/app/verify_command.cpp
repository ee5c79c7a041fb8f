// fairway verify: which states reach, and a certificate of it.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct VerifyArguments {
  fs::path plan;
  fs::path output;
  fs::path resume;
  fs::path failures;
  fs::path pictures;
  fs::path summary;
  std::string method = "certified";
  std::string region = "goal";
  VerifyLimits limits;
  std::size_t volume_samples = CertifyOptions{}.samples;
  std::uint64_t seed = CertifyOptions{}.seed;
  int samples_per_border = 200;
};

RegionOfInterest region_of_text(const std::string& text) {
  RegionOfInterest region;
  if (text == "goal") return region;
  region.kind = RegionOfInterest::Kind::obstacle;
  if (text == "obstacle") return region;
  region.kind = RegionOfInterest::Kind::rectangle;
  const std::vector<std::string> parts = CLI::detail::split(text, ',');
  for (std::size_t i = 0; i < 4 && i < parts.size(); ++i) {
    if (!CLI::detail::lexical_cast(parts[i], region.rectangle_m[i])) break;
  }
  return region;
}

CLI::Validator region_argument() {
  const auto check = [](const std::string& text) -> std::string {
    if (text == "goal" || text == "obstacle") return {};
    const std::vector<std::string> parts = CLI::detail::split(text, ',');
    std::array<double, 4> r{};
    bool fits = parts.size() == 4;
    for (std::size_t i = 0; fits && i < 4; ++i) {
      fits = CLI::detail::lexical_cast(parts[i], r[i]) && std::isfinite(r[i]);
    }
    if (fits && r[0] < r[2] && r[1] < r[3]) return {};
    return "expected goal, obstacle, or X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, found " + text;
  };
  return {check, "", "region"};
}

/// Beside the certificate, under its own name when there is a summary of something else.
fs::path summary_place(const VerifyArguments& a) {
  if (!a.summary.empty()) return a.summary;
  return a.output.parent_path() / (a.output.stem().string() + ".summary.json");
}

int verify_command(const VerifyArguments& a, const Session& session) {
  const fs::path summary_file = summary_place(a);
  const Places inputs = files_of({a.plan, a.resume});
  require_places({a.output, summary_file, a.failures}, inputs, session.existing());
  std::optional<AtomicFolder> pictures;
  if (!a.pictures.empty()) {
    for (const std::string& picture : verdict_picture_files()) {
      require_no_input(a.pictures / picture, inputs);
    }
    pictures.emplace(a.pictures, session.existing(), "proved.png", verdict_picture_files());
  }
  say_when_interrupted(
      "nothing half-made was left; with --time-limit S a certificate holds what is proved by then, "
      "and --resume CERT goes on from it");
  const RegionOfInterest region = region_of_text(a.region);

  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  clock.begin("reading the plan", unknown_time);
  const Plan plan = read_plan(a.plan);
  json summary;
  std::vector<Finding> found;
  std::vector<std::string> warnings;
  std::string notes;
  if (a.method == "bitmap") {
    clock.begin("verifying", unknown_time);
    const BitmapVerification made =
        write_bitmap(plan, region, a.samples_per_border, a.seed, a.output, session.existing());
    clock.end();
    summary = verification_json(made);
    found = findings(plan, made);
  } else {
    std::optional<EarlierProof> earlier;
    if (!a.resume.empty()) earlier = EarlierProof{read_certificate(a.resume), a.resume.string()};
    clock.begin("verifying", unknown_time);
    const Verification made = verify_plan(plan, a.plan.string(), region,
                                          certify_options(a.limits, a.seed, a.volume_samples),
                                          std::move(earlier), levels_told_by(clock));
    clock.begin("writing the certificate", unknown_time);
    write_certificate(made.certificate, a.output, session.existing());
    std::vector<FailingState> failing;
    if (!a.failures.empty() || pictures) {
      failing = failing_states(made.certificate, 100, a.seed);
    }
    if (!a.failures.empty()) {
      write_whole(a.failures, session.existing(), failing_states_csv(failing));
    }
    if (pictures) {
      clock.begin("drawing", unknown_time);
      const Plan flown = as_verified(plan, made.certificate);
      write_verdict_pictures(flown, made.certificate,
                             all_flights(failing_flights(ExactFlights(flown), failing, 1)), a.seed,
                             a.plan.stem().string(), pictures->temporary_path());
      pictures->commit();
    }
    clock.end();
    summary = verification_json(made);
    found = findings(plan, made);
    notes = proof_notes(made) + "\n";
    if (auto warning = limit_warning(made)) warnings.push_back(std::move(*warning));
  }
  if (auto warning = cut_off_warning(plan); warning && a.region == "goal") {
    warnings.insert(warnings.begin(), std::move(*warning));
  }
  terminal.reset();
  summary["plan"] = a.plan.string();
  summary["certificate"] = a.output.string();
  summary["region"] = a.region;
  summary["findings"] = findings_json(found);
  summary["warnings"] = warnings;
  add_cost(summary, clock);
  write_whole(summary_file, session.existing(), summary.dump(2) + "\n");
  for (const std::string& warning : warnings) session.warn(warning);
  session.tell(summary,
               fmt::format("{}\n{}{}\nThe certificate is {}, in numbers {}.", findings_table(found),
                           notes, cost_words(summary), a.output.string(), summary_file.string()));
  return exit_done;
}

}  // namespace

Action declare_verify(CLI::App& options) {
  auto arguments = std::make_shared<VerifyArguments>();
  VerifyArguments& a = *arguments;
  options.add_option("plan", a.plan, "the plan file")->required()->type_name("PLAN");
  options.add_option("-o,--output", a.output, "the certificate to write")
      ->required()
      ->type_name("CERT.safetensors");
  options
      .add_option("--method", a.method,
                  "certified: a proof; bitmap: the paper's, on samples of the borders, a picture")
      ->check(CLI::IsMember({"certified", "bitmap"}))
      ->type_name("METHOD")
      ->capture_default_str();
  options
      .add_option("--region", a.region,
                  "what is to be reached: goal, obstacle, or the cells wholly inside X0,Y0,X1,Y1")
      ->check(region_argument())
      ->type_name("REGION")
      ->capture_default_str();
  options
      .add_option("--undecided-max", a.limits.undecided_max,
                  "stop once this share of the volume is undecided")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("F")
      ->capture_default_str();
  options.add_option("--time-limit", a.limits.time_limit_s, "stop after this time, seconds")
      ->check(finite_above(0.0))
      ->type_name("S");
  options
      .add_option("--memory-limit", a.limits.memory_limit_mb, "stop before using more, megabytes")
      ->check(finite_above(0.0))
      ->type_name("MB");
  options
      .add_option(
          "--resume", a.resume,
          "go on from an earlier certificate of the same plan, vehicle and region; its leaves "
          "are proved again first, which takes about as long as fairway check")
      ->type_name("CERT");
  options
      .add_option("--failures", a.failures,
                  "write states that fail or are undecided, for fairway simulate --states")
      ->type_name("CSV");
  options
      .add_option("--pictures", a.pictures,
                  "draw the verdicts, the shares proved, and a flight to each kind of failure")
      ->type_name("DIR");
  options
      .add_option("--summary", a.summary,
                  "where to write the numbers (default: beside the certificate, .summary.json)")
      ->type_name("JSON");
  options
      .add_option("--volume-samples", a.volume_samples,
                  "states that measure the volumes; at least 1000, and one a cell")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->type_name("N")
      ->capture_default_str();
  options.add_option("--seed", a.seed, "of these")->type_name("S")->capture_default_str();
  options
      .add_option("--border-samples", a.samples_per_border,
                  "bitmap: places and headings on a border, a multiple of four")
      ->check(CLI::Range(4, 4000))
      ->type_name("M")
      ->capture_default_str();
  options.final_callback([&a] {
    if (a.samples_per_border % 4 != 0) {
      throw CLI::ValidationError("--border-samples", "expected a multiple of four");
    }
    if (a.method == "bitmap" && (!a.resume.empty() || !a.failures.empty() || !a.pictures.empty())) {
      throw CLI::ValidationError("--method bitmap", "has no --resume, --failures or --pictures");
    }
  });
  options.footer("Example: fairway verify out/demo/plan.safetensors -o demo.cert.safetensors");
  return [arguments](const Session& session) { return verify_command(*arguments, session); };
}

}  // namespace fairway
