// fairway verify: proves which states reach, and writes a certificate.
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
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/bitmap_pictures.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/run/verify_progress.hpp"
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
  std::string method;  // empty: contract if there is one, else certified
  fs::path contract;
  int parts_per_cell = 0;
  std::string region = "goal";
  VerifyLimits limits;
  std::size_t volume_samples = CertifyOptions{}.samples;
  std::uint64_t seed = CertifyOptions{}.seed;
  int samples_per_border = usual_border_samples;
};

CLI::Validator region_argument() {
  const auto check = [](const std::string& text) -> std::string {
    const auto request = region_request_of(text);
    const bool is_file = request && request->kind == RegionOfInterest::Kind::cells;
    if (request && (!is_file || fs::exists(request->file))) return {};
    return "expected goal, obstacle, X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, or a file, found " +
           text;
  };
  return {check, "", "region"};
}

/// Next to the certificate and named after it, so that other summaries there are kept.
fs::path summary_place(const VerifyArguments& a) {
  if (!a.summary.empty()) return a.summary;
  return a.output.parent_path() / (a.output.stem().string() + ".summary.json");
}

/// Opens the folder of the pictures; none of them may overwrite an input.
void open_pictures(const VerifyArguments& a, const Places& inputs, const Session& session,
                   std::optional<AtomicFolder>& folder) {
  if (a.pictures.empty()) return;
  const bool drawn = a.method == "bitmap";
  const std::vector<std::string> files = drawn ? bitmap_picture_files() : verdict_picture_files();
  for (const std::string& picture : files) require_no_input(a.pictures / picture, inputs);
  folder.emplace(a.pictures, session.existing(), drawn ? "sampled.png" : "proved.png", files);
}

/// The contract to verify under: the one given, or the plan's own.
std::optional<VehicleContract> contract_for(const VerifyArguments& a, const Plan& plan) {
  if (!a.contract.empty()) return read_contract(a.contract, plan.vehicle);
  if (a.method == "contract" && !plan.record.contract) {
    throw InputError(a.plan.string(),
                     "carries no contract: name one with --contract FILE.toml, or plan from a "
                     "scenario with [vehicle.contract]");
  }
  return a.method.empty() || a.method == "contract" ? plan.record.contract : std::nullopt;
}

ContractVerifyOptions contract_options(const VerifyArguments& a) {
  ContractVerifyOptions options;
  options.parts_per_cell = a.parts_per_cell;
  options.limits = a.limits;
  if (a.volume_samples != CertifyOptions{}.samples) options.samples = a.volume_samples;
  options.seed = a.seed;
  return options;
}

int verify_command(const VerifyArguments& a, const Session& session) {
  const fs::path summary_file = summary_place(a);
  const RegionRequest asked = region_request_of(a.region).value_or(RegionRequest{});
  const Places inputs = files_of({a.plan, a.resume, a.contract, asked.file});
  require_places({a.output, summary_file, a.failures}, inputs, session.existing());
  std::optional<AtomicFolder> pictures;
  open_pictures(a, inputs, session, pictures);
  say_when_interrupted(
      "no partial files were left; with --time-limit S a certificate holds what is proved by then, "
      "and --resume CERT continues from it");
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  clock.begin("reading the plan", unknown_time);
  const Plan plan = read_plan(a.plan);
  const RegionOfInterest region = region_on_plan(asked, plan);
  json summary;
  std::vector<Finding> found;
  std::vector<std::string> warnings;
  std::string notes;
  const char* product = a.method == "bitmap" ? "bitmap" : "certificate";
  if (const auto contract = contract_for(a, plan)) {
    if (!a.resume.empty() || !a.failures.empty() || pictures) {
      throw InputError("--resume, --failures and --pictures",
                       "go with the exact vehicle: add --method certified");
    }
    const ContractVerification made =
        verify_contract(plan, a.plan.string(), region, *contract, contract_options(a),
                        begin_verifying_contract(clock, a.limits));
    clock.begin("writing the certificate", unknown_time);
    write_contract_certificate(made.certificate, a.output, session.existing());
    clock.end();
    summary = contract_verification_json(made);
    found = findings(plan, made);
    notes = contract_notes(made) + "\n";
    if (auto warning = contract_warning(plan, *contract)) warnings.push_back(std::move(*warning));
  } else if (a.method == "bitmap") {
    clock.begin("verifying", unknown_time);
    const BitmapVerification made =
        draw_bitmap(plan, a.plan.string(), region, a.samples_per_border, a.seed);
    clock.begin("writing the bitmap", unknown_time);
    write_bitmap(made.bitmap, a.output, session.existing());
    if (pictures) {
      clock.begin("drawing", unknown_time);
      write_bitmap_pictures(made.bitmap, a.plan.stem().string(), pictures->temporary_path());
      pictures->commit();
    }
    clock.end();
    summary = verification_json(made);
    found = findings(plan, made);
  } else {
    std::optional<EarlierProof> earlier;
    if (!a.resume.empty()) earlier = EarlierProof{read_certificate(a.resume), a.resume.string()};
    const CertifyOptions options = certify_options(a.limits, a.seed, a.volume_samples);
    const Verification made = verify_plan(plan, a.plan.string(), region, options,
                                          std::move(earlier), begin_verifying(clock, options));
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
    if (made.resumed) {
      summary["resumed"] = resumed_json(*made.resumed);
      notes += resumed_words(*made.resumed) + "\n";
    }
    if (auto warning = limit_warning(made)) warnings.push_back(std::move(*warning));
  }
  if (auto warning = cut_off_warning(plan); warning && a.region == "goal") {
    warnings.insert(warnings.begin(), std::move(*warning));
  }
  terminal.reset();
  summary["plan"] = a.plan.string();
  summary[product] = a.output.string();
  summary["region"] = a.region;
  summary["findings"] = findings_json(found);
  summary["warnings"] = warnings;
  add_cost(summary, clock);
  write_whole(summary_file, session.existing(), summary.dump(2) + "\n");
  for (const std::string& warning : warnings) session.warn(warning);
  session.tell(summary,
               fmt::format("{}\n{}{}\n{}: {}. Summary: {}.", findings_table(found), notes,
                           cost_words(summary), a.method == "bitmap" ? "Bitmap" : "Certificate",
                           a.output.string(), summary_file.string()));
  return exit_done;
}

}  // namespace

Action declare_verify(CLI::App& options) {
  auto arguments = std::make_shared<VerifyArguments>();
  VerifyArguments& a = *arguments;
  options.add_option("plan", a.plan, "the plan file")->required()->type_name("PLAN");
  options.add_option("-o,--output", a.output, "the certificate, or the bitmap, to write")
      ->required()
      ->type_name("CERT.safetensors");
  options
      .add_option(
          "--method", a.method,
          "certified: a proof for the exact vehicle, with a certificate; contract: a proof for "
          "every vehicle that keeps a contract (the default where there is one); bitmap: paper 2's "
          "backward reachable set on samples of the borders, a picture that can be queried, not a "
          "proof")
      ->check(CLI::IsMember({"certified", "contract", "bitmap"}))
      ->type_name("METHOD")
      ->default_str("certified");
  options
      .add_option("--contract", a.contract,
                  "prove it for every vehicle that keeps the contract [vehicle.contract] of this "
                  "file, instead of the plan's own contract")
      ->check(CLI::ExistingFile)
      ->type_name("FILE.toml");
  options
      .add_option("--parts", a.parts_per_cell,
                  "under a contract: parts along the side of a cell; finer proves more, and takes "
                  "longer (default: by the contract's command error)")
      ->check(CLI::Range(1, 16))
      ->type_name("K");
  options
      .add_option("--region", a.region,
                  "region to be reached: goal, obstacle, the cells wholly inside X0,Y0,X1,Y1, or "
                  "the cells of a file (GeoJSON areas, or CSV with ix,iy)")
      ->check(region_argument())
      ->type_name("REGION")
      ->capture_default_str();
  options
      .add_option("--undecided-max", a.limits.undecided_max,
                  "stop once at most this share of the volume is undecided")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("F")
      ->capture_default_str();
  options.add_option("--time-limit", a.limits.time_limit_s, "stop after this many seconds")
      ->check(finite_above(0.0))
      ->type_name("S");
  options
      .add_option("--memory-limit", a.limits.memory_limit_mb,
                  "stop before using more memory than this, megabytes")
      ->check(finite_above(0.0))
      ->type_name("MB");
  options
      .add_option(
          "--resume", a.resume,
          "continue from an earlier certificate of the same plan, vehicle and region; its leaves "
          "are proved again first, which takes about as long as fairway check")
      ->type_name("CERT");
  options
      .add_option("--failures", a.failures,
                  "write states that fail or are undecided, for fairway simulate --states")
      ->type_name("CSV");
  options
      .add_option("--pictures", a.pictures,
                  "draw the verdicts, the proved shares and one flight for each kind of failure; "
                  "bitmap: slices by heading and the shares of headings that reach")
      ->type_name("DIR");
  options
      .add_option("--summary", a.summary,
                  "write the numbers to this file (default: next to the certificate, named "
                  ".summary.json)")
      ->type_name("JSON");
  options
      .add_option(
          "--volume-samples", a.volume_samples,
          "number of states sampled to measure the volumes; at least 1000, and one per cell")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->type_name("N")
      ->capture_default_str();
  options.add_option("--seed", a.seed, "random seed for the volume samples")
      ->type_name("S")
      ->capture_default_str();
  options
      .add_option("--border-samples", a.samples_per_border,
                  "bitmap: number of places and of headings sampled on each border, a multiple of "
                  "four")
      ->check(CLI::Range(least_border_samples, most_border_samples))
      ->type_name("M")
      ->capture_default_str();
  options.final_callback([&a] {
    if (a.samples_per_border % 4 != 0) {
      throw CLI::ValidationError("--border-samples", "expected a multiple of four");
    }
    if (!a.contract.empty() && !a.method.empty() && a.method != "contract") {
      throw CLI::ValidationError("--contract", "goes with --method contract");
    }
    if (a.method == "bitmap" && (!a.resume.empty() || !a.failures.empty())) {
      throw CLI::ValidationError("--method bitmap",
                                 "cannot be combined with --resume or --failures");
    }
  });
  options.footer("Example: fairway verify out/demo/plan.safetensors -o demo.cert.safetensors");
  return [arguments](const Session& session) { return verify_command(*arguments, session); };
}

}  // namespace fairway
