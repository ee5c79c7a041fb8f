#include "fairway/run/run.hpp"

#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/digest.hpp"
#include "fairway/exchange/flight_files.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/ceiling_summary.hpp"
#include "fairway/run/closing.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/find_at_risk.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/flight_costs.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/flight_summary.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/plan_warnings.hpp"
#include "fairway/run/product_picture.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/prove_under_contract.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/report_page.hpp"
#include "fairway/run/run_estimate.hpp"
#include "fairway/run/run_inputs.hpp"
#include "fairway/run/run_pictures.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/run/scenario_overrides.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verify_and_check.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

RunResult unreachable(const Scenario& scenario, const MissionRefusal& refusal) {
  const char* key = place_key(scenario);
  return {true,
          {{"unreachable", true}, {"message", refusal.message}},
          fmt::format("{}: {}: {}", scenario.place_of(key), key, refusal.message),
          refusal.warnings};
}

}  // namespace

namespace {

void write_flights(const ScenarioFlights& flown, const Plan& plan, const std::string& where,
                   const fs::path& place) {
  const double step_m = plan.grid.cell_m;
  const bool has_modes = plan.further_modes() > 0;
  write_whole(place / product::flights_csv, Existing::keep,
              trajectories_csv(flown.recorded, plan.vehicle.speed_mps, step_m, has_modes));
  write_whole(place / product::flights_geojson, Existing::keep,
              flights_geojson(flown.recorded, step_m, lon_lat_of(frame_in(plan.record), where)));
  write_whole(place / product::outcomes, Existing::keep,
              outcomes_csv(flown.starts, flown.results, flown.measures, flown.followed.has_value(),
                           has_modes));
}

/// That the path is followed, where that was proved.
const FollowProof* follow_of(const std::optional<ProvedUnderContract>& under_contract) {
  if (!under_contract || !under_contract->verification.following) return nullptr;
  return &*under_contract->verification.certificate.follow;
}

/// report.html; where this build has none, a warning says why.
void write_page(const Plan& plan, const Mission& mission, const ScenarioFlights& flown,
                const Verified& verified, const std::optional<ProvedUnderContract>& under_contract,
                const std::optional<Ceiling>& ceiling, const VerdictMap* contract_map,
                const std::optional<PageWitnesses>& witnesses, const ExactFlights& flights,
                const std::string& title, const fs::path& place, RunResult& result) {
  constexpr std::size_t failing_of_each = 4;
  const auto* proved = std::get_if<Proved>(&verified);
  ReportPage page{title,
                  {plan_words(plan), flight_words(flown) + "Flights are evidence, not a proof.",
                   words_of(verified)},
                  result.summary,
                  proved != nullptr ? &proved->verification.certificate : nullptr,
                  proved != nullptr ? failing_flights(flights, proved->failing, failing_of_each)
                                    : std::vector<FailingFlights>{},
                  contract_map,
                  witnesses ? &*witnesses : nullptr,
                  follow_of(under_contract),
                  under_contract && is_exact(under_contract->verification.certificate)};
  if (under_contract) page.words.push_back(words_of(plan, *under_contract));
  if (ceiling) page.words.push_back(words_of(*ceiling, proved_share(plan, proved->verification)));
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

/// "DIR/report.html, DIR/plan.svg, ...": the files to look at first.
std::string to_look_at(const fs::path& folder, const json& products) {
  std::string files;
  for (const char* name : {product::report_page, "plan.svg", "flights.svg", "verdicts.svg",
                           "contract.svg", "slices.svg"}) {
    if (!products.contains(name)) continue;
    files += (files.empty() ? "" : ", ") + (folder / name).string();
  }
  return files;
}

}  // namespace

RunResult run(const Scenario& asked, const fs::path& folder, Existing existing,
              const Progress& progress) {
  std::vector<fs::path> places;
  for (const std::string& name : product_names()) places.push_back(folder / name);
  require_no_inputs(places, inputs_of(asked));
  AtomicFolder products(folder, existing, product::summary, product_names());
  const fs::path& place = products.temporary_path();
  StageClock clock(progress);

  auto answer = plan_scenario(asked, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer))
    return unreachable(asked, *refusal);
  const auto& [map, mission, plan, scenario, tried] = std::get<Planned>(answer);
  require_no_inputs(places, inputs_of(map));
  const RegionOfInterest region = region_on_plan(scenario.verify.region, plan);
  const Estimate left = estimate(scenario, map.grid);

  clock.begin("writing the plan", left.from_plan());
  write_plan(plan, place / product::plan, Existing::keep);

  clock.begin("flying", left.from_flights());
  const FlightEngine engine(plan);
  const ScenarioFlights flown = fly_scenario(scenario, plan, engine, clock, left.from_pictures());
  write_flights(flown, plan, scenario.file.string(), place);
  constexpr std::size_t measured_strata =
      1000;  // of two states each: a hundredth of a proof's time
  const FlightCosts costs = costs_over_all_states(plan, measured_strata, scenario.simulate.seed);

  const Verified verified =
      verify_and_check(plan, scenario, region, flown, place, clock, left.from_pictures());
  std::vector<std::string> contract_warnings;
  const std::optional<ProvedUnderContract> under_contract =
      prove_under_contract(plan, scenario, region, place, clock, contract_warnings);
  const Plan as_asked = as_verified(plan, verified);
  const ExactFlights flights(as_asked);
  const std::optional<Ceiling> ceiling = ceiling_asked(scenario, as_asked, verified, clock);

  clock.begin("drawing", left.from_pictures());
  const std::string title = scenario.file.stem().string();
  write_run_pictures(plan, mission, flown, follow_of(under_contract), title, place);
  write_verified_pictures(as_asked, flights, verified, scenario.simulate.seed, title, place);
  std::optional<VerdictMap> contract_map;
  std::optional<PageWitnesses> witnesses;
  if (under_contract) {
    clock.begin("sampling verdicts under the contract", left.page_s);
    const ContractVerification& made = under_contract->verification;
    contract_map = contract_verdict_map(made.certificate, page_headings(plan.grid));
    if (made.searched) witnesses = find_at_risk(made.certificate, *contract_map);
    write_contract_pictures(*contract_map, witnesses ? &witnesses->at_risk : nullptr, title, place);
  }

  clock.begin("making the page", left.page_s);
  std::vector<Finding> found = findings_of(plan, flown, verified);
  RunResult result{
      false, plan_summary(scenario, plan), {}, warnings_of(scenario, map, plan, flown, verified)};
  for (std::string& warning : contract_warnings) result.warnings.push_back(std::move(warning));
  result.summary["verify"] = json_of(verified);
  if (ceiling) {
    add_ceiling(result.summary["verify"], found, *ceiling,
                proved_share(plan, std::get<Proved>(verified).verification));
    if (auto warning = limit_warning(*ceiling)) result.warnings.push_back(*warning);
  }
  if (under_contract) {
    std::vector<Finding> under = findings(plan, *under_contract);
    result.summary["contract"] = json_of(*under_contract);
    const auto share = proved_share(plan, under_contract->verification);
    if (ceiling && share) add_ceiling(result.summary["contract"], under, *ceiling, *share);
    found.insert(found.end(), under.begin(), under.end());
    if (auto warning = limit_warning(*under_contract)) result.warnings.push_back(*warning);
    result.summary["contract"]["findings"] = findings_json(under);
  }
  add_overrides(result.summary, scenario);
  if (!tried.empty()) result.summary["tried_parameters"] = tried_json(tried);
  result.summary["findings"] = findings_json(found);
  result.summary["warnings"] = result.warnings;
  add_flights(result.summary, flown, scenario.simulate.seed);
  result.summary["measures"] = flight_costs_json(costs);
  result.summary["products"] = product_digests(place);
  write_page(plan, mission, flown, verified, under_contract, ceiling,
             contract_map ? &*contract_map : nullptr, witnesses, flights, title, place, result);
  clock.end();
  result.summary["products"] = product_digests(place);
  add_cost(result.summary, clock);
  write_whole(place / product::summary, Existing::keep, result.summary.dump(2) + "\n");
  products.commit();
  result.paragraph = fmt::format(
      "{}\n{}{}\nLook at {} and {}.", findings_table(found),
      notes_of(plan, flown, verified) + (under_contract ? notes_of(*under_contract) : ""),
      cost_words(result.summary), to_look_at(folder, result.summary["products"]),
      (folder / product::summary).string());
  return result;
}

RunResult run_plan_only(const Scenario& asked, const fs::path& file, Existing existing,
                        const Progress& progress, const fs::path& picture) {
  std::vector<fs::path> places{file};
  if (!picture.empty()) places.push_back(picture);
  require_no_inputs(places, inputs_of(asked));
  for (const fs::path& place : places) require_writable_place(place, existing);
  StageClock clock(progress);

  auto answer = plan_scenario(asked, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer))
    return unreachable(asked, *refusal);
  const auto& [map, mission, plan, scenario, tried] = std::get<Planned>(answer);

  require_no_inputs(places, inputs_of(map));
  clock.begin("writing the plan", estimate(scenario, map.grid).plan_s);
  write_plan(plan, file, existing);
  if (!picture.empty()) {
    clock.begin("drawing", estimate(scenario, map.grid).pictures_s);
    write_picture(picture_of_plan(plan, scenario.file.stem().string()), picture, existing);
  }
  clock.end();

  RunResult result{false, plan_summary(scenario, plan), {}, plan_warnings(scenario, map, plan)};
  add_overrides(result.summary, scenario);
  if (!tried.empty()) result.summary["tried_parameters"] = tried_json(tried);
  for (const fs::path& place : places) {
    result.summary["products"][place.filename().string()] = sha256_file(place);
  }
  add_cost(result.summary, clock);
  const std::vector<Finding> found = plan_findings(plan);
  result.summary["findings"] = findings_json(found);
  result.summary["warnings"] = result.warnings;
  result.paragraph = fmt::format(
      "{}{} {}\nPlan: {}.", findings_table(found), grid_words(plan), cost_words(result.summary),
      file.string() + (picture.empty() ? "" : ", drawn in " + picture.string()));
  return result;
}

}  // namespace fairway
