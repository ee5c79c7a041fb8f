// fairway ceiling: what any control could bring to the mission.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/scenario_arguments.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/ceiling/ceiling_file.hpp"
#include "fairway/ceiling/find_ceiling.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/report/draw_ceiling.hpp"
#include "fairway/run/ceiling_summary.hpp"
#include "fairway/run/product_picture.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/run.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct CeilingArguments {
  ScenarioArguments scenario;  // or a plan
  fs::path output;
  fs::path picture;
  CeilingOptions options;
};

bool is_folder(const fs::path& asked) {
  std::error_code error;
  return fs::is_directory(asked, error);
}

/// That of a run for its folder; empty for a scenario.
fs::path plan_file_of(const fs::path& asked) {
  if (is_folder(asked)) return asked / product::plan;
  return asked.extension() == ".toml" ? fs::path{} : asked;
}

/// Beside a run's plan; empty where there is none.
fs::path certificate_file_of(const fs::path& plan_file) {
  const fs::path beside = plan_file.parent_path() / product::certificate;
  std::error_code error;
  const bool is_there = plan_file.filename() == product::plan && fs::is_regular_file(beside, error);
  return is_there ? beside : fs::path{};
}

/// What the certificate proves of the plan; none when it is about something else.
std::optional<VerdictMap> kept_by_plan(const fs::path& file, const Plan& plan,
                                       const Session& session) {
  if (file.empty()) return std::nullopt;
  const Certificate found = read_certificate(file);
  if (proof_identity(found) == proof_identity(plan, RegionOfInterest{})) {
    return verdict_map_of(found.view(), {});
  }
  session.warn(file.string() + " is not about this plan and its mission, and is not drawn");
  return std::nullopt;
}

/// The name of a run's folder, else that of the file.
std::string title_of(const fs::path& asked) {
  return is_folder(asked) ? fs::canonical(asked).filename().string() : asked.stem().string();
}

/// The plan of a file, or of a scenario; or why there is none.
std::variant<Plan, MissionRefusal> plan_asked_for(const CeilingArguments& a,
                                                  const fs::path& plan_file, StageClock& clock) {
  if (!plan_file.empty()) return read_plan(plan_file);
  auto planned = plan_scenario(a.scenario.read(), clock);
  if (auto* refusal = std::get_if<MissionRefusal>(&planned)) return std::move(*refusal);
  return std::move(std::get<Planned>(planned).plan);
}

int ceiling_command(const CeilingArguments& a, const Session& session) {
  const fs::path plan_file = plan_file_of(a.scenario.file);
  const fs::path certificate = certificate_file_of(plan_file);
  require_places({a.output, a.picture},
                 files_of({plan_file.empty() ? a.scenario.file : plan_file, certificate}),
                 session.existing());
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  const auto asked = plan_asked_for(a, plan_file, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&asked)) {
    terminal.reset();
    session.tell({{"unreachable", true}, {"message", refusal->message}}, refusal->message);
    return exit_no;
  }
  const auto& plan = std::get<Plan>(asked);
  clock.begin("what any control could reach", unknown_time);
  const Ceiling ceiling = find_ceiling(plan.grid, plan.region, plan.vehicle, a.options);
  const double wall_s = clock.seconds();
  terminal.reset();
  nlohmann::json report = json_of(ceiling);
  report["wall_s"] = wall_s;
  if (ceiling.levels == 0 && (!a.output.empty() || !a.picture.empty())) {
    session.tell(report, words_of(ceiling) + " No file was written.");
    return exit_no;
  }
  if (!a.output.empty()) {
    write_ceiling(ceiling, plan.region, a.output, session.existing());
    report["file"] = a.output.string();
  }
  if (!a.picture.empty()) {
    const auto kept = kept_by_plan(certificate, plan, session);
    write_picture(draw_ceiling(ceiling, plan.region, {.title = title_of(a.scenario.file)},
                               kept ? &*kept : nullptr),
                  a.picture, session.existing());
    report["picture"] = a.picture.string();
  }
  session.tell(report, words_of(ceiling));
  return exit_done;
}

}  // namespace

Action declare_ceiling(CLI::App& options) {
  auto arguments = std::make_shared<CeilingArguments>();
  CeilingArguments& a = *arguments;
  declare(options, a.scenario);
  options.get_option("scenario")->type_name("SCENARIO.toml|PLAN|DIR");
  options.add_option("-o,--output", a.output, "the shares of each cell and heading, to a file")
      ->type_name("CEILING.safetensors");
  options
      .add_option("--picture", a.picture,
                  "draw the shares of each cell, .svg or .png; of a run with its certificate, what "
                  "the plan is proved to keep, too")
      ->check(picture_argument())
      ->type_name("FILE");
  options
      .add_option("--gap-max", a.options.gap_max,
                  "stop once the bounds are this share of all states apart")
      ->check(CLI::Range(0.0001, 0.9999))
      ->type_name("SHARE")
      ->capture_default_str();
  options.add_option("--levels", a.options.levels_max, "refine at most so often")
      ->check(CLI::Range(1, 5))
      ->type_name("N")
      ->capture_default_str();
  options.add_option("--time-limit", a.options.time_limit_s, "seconds; what was found still holds")
      ->check(CLI::Range(0.1, 1e7))
      ->type_name("S")
      ->capture_default_str();
  options
      .add_option("--memory-limit", a.options.memory_limit_mb,
                  "megabytes; a level that takes more is not begun")
      ->check(CLI::Range(1.0, 1e7))
      ->type_name("MB")
      ->capture_default_str();
  options.footer(
      "Proves from which states some control brings the vehicle to the mission, and from which\n"
      "none does, as a bracket: no plan of any kind can keep more than the upper bound.\n"
      "Example: fairway ceiling demo/demo.toml --picture ceiling.svg");
  return [arguments](const Session& session) { return ceiling_command(*arguments, session); };
}

}  // namespace fairway
