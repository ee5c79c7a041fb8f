#include "fairway/app/verify_arguments.hpp"

#include "fairway/app/argument_checks.hpp"
#include "fairway/run/region_request.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

void declare_verify_arguments(CLI::App& options, VerifyArguments& a) {
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
  options.add_flag("--ceiling", a.ceiling,
                   "also bound what any control could keep, and tell what share of it is proved; "
                   "the limits hold for it, too (docs/ceiling.md)");
  options
      .add_option("--resume", a.resume,
                  "continue from an earlier certificate of the same plan, vehicle (or contract) "
                  "and region; "
                  "its leaves are proved again first, which takes about as long as fairway check")
      ->type_name("CERT");
  options
      .add_option("--failures", a.failures,
                  "write states that fail, are at risk or are undecided, for fairway simulate "
                  "--states")
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
    if (a.method == "bitmap" && (!a.resume.empty() || !a.failures.empty() || a.ceiling)) {
      throw CLI::ValidationError("--method bitmap",
                                 "cannot be combined with --resume, --failures or --ceiling");
    }
  });
}

}  // namespace fairway
