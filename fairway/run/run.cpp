#include "fairway/run/run.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/digest.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/checker.hpp"
#include "fairway/run/closing.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/flight_summary.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/report_page.hpp"
#include "fairway/run/run_pictures.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Seconds that the stages after the map will take, from rates seen on one machine with two cores:
/// no more than what a progress line needs.
struct Estimate {
  double field_s, plan_s, flights_s, pictures_s, page_s;
  double from_field() const { return field_s + from_plan(); }
  double from_plan() const { return plan_s + from_flights(); }
  double from_flights() const { return flights_s + from_pictures(); }
  double from_pictures() const { return pictures_s + page_s; }
};
Estimate estimate(const Scenario& scenario, const Grid& grid) {
  const auto cells = static_cast<double>(grid.size());
  const auto flights =
      static_cast<double>(std::max(scenario.simulate.random, scenario.simulate.sample));
  return {120e-9 * cells, 30e-9 * cells, flights * (grid.nx + grid.ny) * 100e-9,
          0.5 + 500e-9 * cells, 0.2 + 20e-6 * cells};
}

RunResult unreachable(const Scenario& scenario, const MissionRefusal& refusal) {
  const char* key = place_key(scenario);
  return {true,
          {{"unreachable", true}, {"message", refusal.message}},
          fmt::format("{}: {}: {}", scenario.place_of(key), key, refusal.message),
          refusal.warnings};
}

}  // namespace

std::variant<Planned, MissionRefusal> plan_scenario(const Scenario& scenario, StageClock& clock) {
  clock.begin("reading the map", unknown_time);
  ObstacleMap map = read_map(map_request(scenario));
  Mission mission = mission_on_map(scenario, map);

  clock.begin("computing the field", estimate(scenario, map.grid).from_field());
  FieldOrRefusal answer = compute_field(map, scenario.vehicle, mission, scenario.plan);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    if (refusal->reason != MissionRefusal::Reason::unreachable) throw_refusal(scenario, *refusal);
    return std::move(*refusal);
  }
  Plan plan = plan_of_field(std::move(std::get<Field>(answer)), scenario.vehicle,
                            plan_record(scenario, map, mission));
  return Planned{std::move(map), std::move(mission), std::move(plan)};
}

namespace {

void write_flights(const ScenarioFlights& flown, const Plan& plan, const std::string& where,
                   const fs::path& place) {
  const double step_m = plan.grid.cell_m;
  write_whole(place / product::flights_csv, Existing::keep,
              trajectories_csv(flown.recorded, plan.vehicle.speed_mps, step_m));
  write_whole(place / product::flights_geojson, Existing::keep,
              flights_geojson(flown.recorded, step_m, lon_lat_of(frame_in(plan.record), where)));
  write_whole(place / product::outcomes, Existing::keep, outcomes_csv(flown.starts, flown.results));
}

/// The verdicts into a certificate, re-proved by the independent program.
Proved prove_and_check(const Plan& plan, const Scenario& scenario, const ScenarioFlights& flown,
                       const fs::path& place, StageClock& clock) {
  const fs::path file = place / product::certificate;
  const CertifyOptions options = certify_options(scenario.verify.limits, scenario.simulate.seed);
  Proved proved;
  proved.verification =
      verify_plan(plan, scenario.file.string(), {}, options, std::nullopt, levels_told_by(clock));
  const Certificate& certificate = proved.verification.certificate;
  write_certificate(certificate, file, Existing::keep);
  proved.failing =
      failing_states(certificate, 100, options.seed, failing_starts(flown.starts, flown.results));
  write_whole(place / product::failures, Existing::keep, failing_states_csv(proved.failing));

  clock.begin("checking the certificate", unknown_time);
  const CheckRun check = run_checker({file.string(), "--quiet"}, true);
  if (check.exit_code == 1) {
    throw std::runtime_error("the certificate was refused by fairway-check: " + check.output);
  }
  proved.checked = check.exit_code == 0;
  return proved;
}

Verified verify_and_check(const Plan& plan, const Scenario& scenario, const ScenarioFlights& flown,
                          const fs::path& place, StageClock& clock) {
  clock.begin("verifying", unknown_time);
  if (scenario.verify.method == VerifyMethod::certified) {
    return prove_and_check(plan, scenario, flown, place, clock);
  }
  constexpr int samples_per_border = 200;
  return write_bitmap(plan, {}, samples_per_border, scenario.simulate.seed, place / product::bitmap,
                      Existing::keep);
}

/// report.html; where this build has none, a warning says why.
void write_page(const Plan& plan, const Mission& mission, const ScenarioFlights& flown,
                const Verified& verified, const ExactFlights& flights, const std::string& title,
                const fs::path& place, RunResult& result) {
  constexpr std::size_t failing_of_each = 4;
  const auto* proved = std::get_if<Proved>(&verified);
  const ReportPage page{
      title,
      {plan_words(plan), flight_words(flown) + "Flights are evidence, not a proof.",
       words_of(verified)},
      result.summary,
      proved != nullptr ? &proved->verification.certificate : nullptr,
      proved != nullptr ? failing_flights(flights, proved->failing, failing_of_each)
                        : std::vector<FailingFlights>{}};
  const std::string absent = write_report_page(plan, mission, flown, page, place);
  if (!absent.empty()) result.warnings.push_back(absent);
}

json product_digests(const fs::path& folder) {
  json digests = json::object();
  for (const auto& entry : fs::directory_iterator(folder)) {
    digests[entry.path().filename().string()] = sha256_file(entry.path());
  }
  return digests;
}

}  // namespace

namespace {

/// Throws when a product would take the place of what it is made of.
void require_no_inputs(const std::vector<fs::path>& products, const std::vector<fs::path>& inputs) {
  for (const fs::path& product : products) require_no_input(product, inputs);
}

std::vector<fs::path> inputs_of(const Scenario& scenario) {
  std::vector<fs::path> inputs{scenario.file, scenario.map.file};
  if (const auto& path = scenario.mission.path_file) inputs.push_back(*path);
  return inputs;
}

/// What the map's file names in turn.
std::vector<fs::path> inputs_of(const ObstacleMap& map) {
  std::vector<fs::path> inputs;
  for (const InputFile& input : map.inputs) inputs.emplace_back(input.path);
  return inputs;
}

}  // namespace

RunResult run(const Scenario& scenario, const fs::path& folder, Existing existing,
              const Progress& progress) {
  std::vector<fs::path> places;
  for (const std::string& name : product_names()) places.push_back(folder / name);
  require_no_inputs(places, inputs_of(scenario));
  AtomicFolder products(folder, existing, product::summary, product_names());
  const fs::path& place = products.temporary_path();
  StageClock clock(progress);

  auto answer = plan_scenario(scenario, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer))
    return unreachable(scenario, *refusal);
  const auto& [map, mission, plan] = std::get<Planned>(answer);
  require_no_inputs(places, inputs_of(map));
  const Estimate left = estimate(scenario, map.grid);

  clock.begin("writing the plan", left.from_plan());
  write_plan(plan, place / product::plan, Existing::keep);

  clock.begin("flying", left.from_flights());
  const FlightEngine engine(plan);
  const ScenarioFlights flown = fly_scenario(scenario, plan, engine, clock, left.from_pictures());
  write_flights(flown, plan, scenario.file.string(), place);

  const Verified verified = verify_and_check(plan, scenario, flown, place, clock);

  clock.begin("drawing", left.from_pictures());
  const std::string title = scenario.file.stem().string();
  write_run_pictures(plan, mission, flown, title, place);
  const auto* proved = std::get_if<Proved>(&verified);
  if (proved != nullptr) {
    write_verdict_pictures(plan, proved->verification.certificate,
                           all_flights(failing_flights(*engine.exact(), proved->failing, 1)),
                           scenario.simulate.seed, title, place);
  }

  clock.begin("making the page", left.page_s);
  const std::vector<Finding> found = findings_of(plan, flown, verified);
  RunResult result{
      false, plan_summary(scenario, map, plan), {}, warnings_of(map, plan, flown, verified)};
  result.summary["findings"] = findings_json(found);
  result.summary["warnings"] = result.warnings;
  add_flights(result.summary, flown, scenario.simulate.seed);
  result.summary["verify"] = json_of(verified);
  result.summary["products"] = product_digests(place);
  write_page(plan, mission, flown, verified, *engine.exact(), title, place, result);
  clock.end();
  result.summary["products"] = product_digests(place);
  add_cost(result.summary, clock);
  write_whole(place / product::summary, Existing::keep, result.summary.dump(2) + "\n");
  products.commit();
  std::string pictures = (folder / "plan.svg").string() + ", " + (folder / "flights.svg").string();
  if (result.summary["products"].contains(product::report_page)) {
    pictures = (folder / product::report_page).string() + ", " + pictures;
  }
  if (proved != nullptr) pictures += ", " + (folder / "verdicts.svg").string();
  result.paragraph = fmt::format("{}\n{}{}\nLook at {} and {}.", findings_table(found),
                                 notes_of(plan, flown, verified), cost_words(result.summary),
                                 pictures, (folder / product::summary).string());
  return result;
}

RunResult run_plan_only(const Scenario& scenario, const fs::path& file, Existing existing,
                        const Progress& progress) {
  require_no_inputs({file}, inputs_of(scenario));
  require_writable_place(file, existing);
  StageClock clock(progress);

  auto answer = plan_scenario(scenario, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer))
    return unreachable(scenario, *refusal);
  const auto& [map, mission, plan] = std::get<Planned>(answer);

  require_no_inputs({file}, inputs_of(map));
  clock.begin("writing the plan", estimate(scenario, map.grid).plan_s);
  write_plan(plan, file, existing);
  clock.end();

  RunResult result{false, plan_summary(scenario, map, plan), {}, plan_warnings(map, plan)};
  result.summary["products"] = {{file.filename().string(), sha256_file(file)}};
  add_cost(result.summary, clock);
  const std::vector<Finding> found = plan_findings(plan);
  result.summary["findings"] = findings_json(found);
  result.paragraph = fmt::format("{}{} {}\nThe plan is {}.", findings_table(found),
                                 grid_words(plan), cost_words(result.summary), file.string());
  return result;
}

}  // namespace fairway
