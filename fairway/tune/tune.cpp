#include "fairway/tune/tune.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/run_inputs.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/version.hpp"
#include "fairway/tune/parameter_search.hpp"
#include "fairway/tune/sharp_proof.hpp"
#include "fairway/tune/tuning_pictures.hpp"
#include "fairway/tune/tuning_products.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What a resumed search must have in common with the one before.
json identity_of(const TuneRequest& request, const TunedScenario& tuned, const ObstacleMap& map) {
  json vary = json::object();
  for (const Parameter& p : tuned.parameters()) {
    vary[p.key] = p.is_range() ? json{p.low, p.high} : json(p.choices);
  }
  json set = json::object();
  for (const ScenarioOverride& one : request.overrides) set[one.key] = one.value;
  json inputs = json::object();
  for (const InputFile& input : recorded_inputs(tuned.given(), map)) {
    inputs[input.path] = input.sha256;
  }
  return {{"program", program_version}, {"inputs", inputs}, {"set", set}, {"vary", vary}};
}

/// Makes the folder ready for a search that may be killed at any time.
void begin_folder(const fs::path& folder, const TuneRequest& request, Existing existing,
                  const json& identity) {
  const fs::path search = folder / tuning_product::search;
  if (request.resume) {
    if (!fs::exists(folder / tuning_product::evaluations) || !fs::exists(search)) {
      throw InputError(folder.string(),
                       "holds no search to resume, expected evaluations.csv and "
                       "search.json of fairway tune");
    }
    if (file_text(search) != identity.dump(2) + "\n") {
      throw InputError(search.string(),
                       "is of another search: --resume needs the same scenario, map, --set and "
                       "--vary, and the same version of Fairway");
    }
    return;
  }
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw InputError(folder.string(), "is a file, expected a folder");
  }
  if (fs::exists(folder) && !fs::is_empty(folder) && existing == Existing::keep) {
    throw InputError(folder.string(),
                     "exists already; --force replaces what is in it, --resume continues");
  }
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw InputError(folder.string(), "cannot be made: " + failed.message());
  for (const std::string& name : tuning_product_names()) fs::remove(folder / name);
  fs::remove(folder / tuning_product::evaluations);
  write_whole(search, Existing::replace, identity.dump(2) + "\n");
}

struct Finalist {
  const Evaluation* evaluation = nullptr;
  Planned planned;
  SharpProof proof;
};

Planned planned_of(const Scenario& scenario) {
  const Progress silent;
  StageClock clock(silent);
  auto answer = plan_scenario(scenario, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    throw InputError(scenario.file.string(), refusal->message);
  }
  return std::move(std::get<Planned>(answer));
}

/// The scenario as given, then the best different plans.
std::vector<Finalist> finalists(const ParameterSearch& search, const TunedScenario& tuned,
                                const TuneRequest& request, StageClock& clock) {
  const std::vector<Evaluation>& all = search.asked();
  std::vector<const Evaluation*> order;
  for (const Evaluation& one : all) {
    if (one.allowed) order.push_back(&one);
  }
  std::stable_sort(order.begin(), order.end(), [&](const Evaluation* a, const Evaluation* b) {
    return search.value(*a) > search.value(*b);
  });
  auto most = static_cast<std::size_t>(request.finalists);
  if (all.front().allowed) {
    order.insert(order.begin(), &all.front());
    ++most;
  }
  std::vector<Finalist> found;
  for (const Evaluation* one : order) {
    if (found.size() == most) break;
    const Scenario scenario = tuned.with(one->values);
    Planned planned = planned_of(scenario);
    const PlanDigests digests = plan_digests(planned.plan);
    const bool is_known = std::any_of(found.begin(), found.end(), [&](const Finalist& f) {
      return plan_digests(f.planned.plan) == digests;
    });
    if (is_known) continue;
    clock.rename(fmt::format("proving, plan {} of {}", found.size() + 1, most));
    clock.tell(unknown_time);
    SharpProof proof = prove_sharply(planned.plan, scenario);
    found.push_back({one, std::move(planned), std::move(proof)});
  }
  return found;
}

/// By what is proved, and the time that was flown; the first of equals.
std::size_t best_of(const std::vector<Finalist>& all, const ParameterSearch& search) {
  const auto worth = [&](const Finalist& f) {
    Evaluation proved = *f.evaluation;
    proved.share = f.proof.share();
    proved.safe_share = f.proof.safe_share();
    return search.value(proved);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (worth(all[i]) > worth(all[best])) best = i;
  }
  return best;
}

}  // namespace

RunResult tune(const TuneRequest& request, const fs::path& folder, Existing existing,
               const Progress& progress) {
  require_range("evaluations", request.evaluations);
  const TunedScenario tuned(request);
  std::vector<fs::path> places{folder / tuning_product::evaluations,
                               folder / tuning_product::search};
  for (const std::string& name : tuning_product_names()) places.push_back(folder / name);
  require_no_inputs(places, inputs_of(tuned.given()));
  const ObstacleMap map = read_map(map_request(tuned.given()));
  require_no_inputs(places, inputs_of(map));
  StageClock clock(progress);
  clock.begin("searching", unknown_time);
  begin_folder(folder, request, existing, identity_of(request, tuned, map));
  ParameterSearch search(request, tuned, folder, clock);
  search.run();

  clock.begin("proving", unknown_time);
  const std::vector<Finalist> last = finalists(search, tuned, request, clock);
  if (last.empty()) {
    return {true, {{"unreachable", true}}, "No parameters that were tried allow the mission.", {}};
  }
  const Finalist& best = last[best_of(last, search)];

  clock.begin("writing", unknown_time);
  AtomicFolder products(folder, Existing::replace, product::summary, tuning_product_names());
  const fs::path& place = products.temporary_path();
  const std::string text = tuned.text_in(folder, best.evaluation->values);
  write_whole(place / tuning_product::scenario, Existing::keep, text);
  const Scenario scenario = scenario_of_text(text, folder / tuning_product::scenario);
  const Planned planned = planned_of(scenario);
  if (plan_digests(planned.plan) != plan_digests(best.planned.plan)) {
    throw std::logic_error("the tuned scenario does not give the plan that was proved");
  }
  write_plan(planned.plan, place / product::plan, Existing::keep);
  RunResult result{false, plan_summary(planned.scenario, planned.plan), {}, {}};
  result.summary["checked"] = best.proof.write_and_check(place);
  write_tuning_pictures(search.asked(), request.objective, place);
  add_tuning(result.summary, search.asked(), tuned.keys(), request);
  json proved = json::array();
  for (const Finalist& one : last) {
    proved.push_back({{"values", one.evaluation->values},
                      {"share", one.proof.share()},
                      {"flown_share", one.evaluation->share},
                      {"mean_time_s", one.evaluation->mean_time_s}});
  }
  result.summary["finalists"] = proved;
  const bool is_given_allowed = search.asked().front().allowed;
  result.summary["given_share"] = is_given_allowed ? json(last.front().proof.share()) : json();
  result.summary["tuned_share"] = best.proof.share();
  result.summary["tuned_values"] = best.evaluation->values;
  result.summary["verify"] = best.proof.json();
  clock.end();
  add_cost(result.summary, clock);
  write_whole(place / product::summary, Existing::keep, result.summary.dump(2) + "\n");
  products.commit();
  result.paragraph = tuning_words(result.summary, folder);
  return result;
}

}  // namespace fairway
