// fairway verify: proves which states reach, and writes a certificate.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/app/verify_arguments.hpp"
#include "fairway/app/verify_methods.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/bitmap_pictures.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verdict_pictures.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

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

VerifyOutcome outcome_of(const VerifyTask& task) {
  if (const auto asked = contract_asked(task)) {
    return verify_under_contract(task, *asked);
  }
  return task.arguments.method == "bitmap" ? verify_by_bitmap(task) : verify_exactly(task);
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
  VerifyOutcome made =
      outcome_of({a, session, plan, region, clock, pictures ? &*pictures : nullptr});
  if (auto warning = cut_off_warning(plan); warning && a.region == "goal") {
    made.warnings.insert(made.warnings.begin(), std::move(*warning));
  }
  terminal.reset();
  const bool drawn = a.method == "bitmap";
  nlohmann::json& summary = made.summary;
  summary["plan"] = a.plan.string();
  summary[drawn ? "bitmap" : "certificate"] = a.output.string();
  summary["region"] = a.region;
  summary["findings"] = findings_json(made.findings);
  summary["warnings"] = made.warnings;
  add_cost(summary, clock);
  write_whole(summary_file, session.existing(), summary.dump(2) + "\n");
  for (const std::string& warning : made.warnings) session.warn(warning);
  session.tell(summary,
               fmt::format("{}\n{}{}\n{}: {}. Summary: {}.", findings_table(made.findings),
                           made.notes, cost_words(summary), drawn ? "Bitmap" : "Certificate",
                           a.output.string(), summary_file.string()));
  return exit_done;
}

}  // namespace

Action declare_verify(CLI::App& options) {
  auto arguments = std::make_shared<VerifyArguments>();
  declare_verify_arguments(options, *arguments);
  options.footer("Example: fairway verify out/demo/plan.safetensors -o demo.cert.safetensors");
  return [arguments](const Session& session) { return verify_command(*arguments, session); };
}

}  // namespace fairway
