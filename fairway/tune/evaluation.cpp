#include "fairway/tune/evaluation.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/run/choose_parameters.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/run.hpp"
#include "fairway/tune/tuning_products.hpp"

namespace fairway {
namespace {

constexpr std::size_t flights_of_an_evaluation = 10'000;
constexpr std::size_t laps_of_an_evaluation = 2'000;
constexpr std::uint64_t seed_of_flights = 1;

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, between);) parts.push_back(part);
  return parts;
}

std::string header_of(const std::vector<std::string>& keys) {
  std::string header = "evaluation";
  for (const std::string& key : keys) header += "," + key;
  return header + ",allowed,share,safe_share,mean_time_s";
}

std::string line_of(const Evaluation& one, std::size_t number) {
  std::string line = fmt::format("{}", number);
  for (const std::string& value : one.values) line += "," + value;
  return line + fmt::format(",{},{},{},{}\n", one.allowed ? 1 : 0, one.share, one.safe_share,
                            one.mean_time_s);
}

/// Coarse: no witnesses are searched for, few states measure the shares.
void prove_coarsely(const Plan& plan, const Scenario& scenario, const VehicleContract& contract,
                    Evaluation& made) {
  ContractVerifyOptions options;
  options.limits.time_limit_s = 0.0;
  options.samples = 5'000;
  options.seed = scenario.simulate.seed;
  options.or_touch = false;  // to touch a path that is to be followed is no success
  options.find_witnesses = false;
  const ContractVerification proof =
      verify_contract(plan, scenario.file.string(), region_on_plan({}, plan), contract, options,
                      [](const std::string&) {});
  constexpr auto reach = static_cast<std::size_t>(Verdict::reach);
  made.share = proof.survey.shares.all[reach];
  made.safe_share = proof.survey.shares.free[reach];
}

}  // namespace

Objective objective_of_text(const std::string& text) {
  if (text == "reach") return {};
  Objective weights{0.0, 0.0, 0.0};
  const std::map<std::string, double*> by_name{
      {"reach", &weights.reach}, {"safe", &weights.safe}, {"time", &weights.time}};
  for (const std::string& part : parts_of(text, ',')) {
    const std::size_t equals = std::min(part.find('='), part.size());
    const auto weight = by_name.find(part.substr(0, equals));
    char* end = nullptr;
    const std::string number = part.substr(std::min(equals + 1, part.size()));
    const double value = std::strtod(number.c_str(), &end);
    if (weight == by_name.end() || number.empty() || *end != '\0' || !(value >= 0.0)) {
      throw InputError("--objective", fmt::format("{}: expected reach, or weights of reach, safe "
                                                  "and time, such as reach=1,time=0.05",
                                                  text));
    }
    *weight->second = value;
  }
  return weights;
}

double value_of(const Evaluation& one, const Evaluation& given, const Objective& objective) {
  // Where nothing arrives there is no time: that of the scenario as given stands for it.
  const bool is_timed = one.mean_time_s > 0.0 && given.mean_time_s > 0.0;
  const double time = is_timed ? one.mean_time_s / given.mean_time_s : 1.0;
  return objective.reach * one.share + objective.safe * one.safe_share - objective.time * time;
}

std::vector<std::size_t> pareto_front(const std::vector<Evaluation>& all) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(-all[a].share, all[a].mean_time_s) <
           std::pair(-all[b].share, all[b].mean_time_s);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (!all[i].allowed || all[i].share <= 0.0) continue;
    if (front.empty() || all[i].mean_time_s < all[front.back()].mean_time_s) front.push_back(i);
  }
  return front;
}

Evaluation evaluate(const Scenario& asked, std::vector<std::string> values) {
  Scenario scenario = asked;
  scenario.open.modes = false;  // those that come by themselves take longer than all the rest
  Evaluation made;
  made.values = std::move(values);
  const Progress silent;
  StageClock clock(silent);
  try {
    const auto answer = plan_scenario(scenario, clock);
    const auto* planned = std::get_if<Planned>(&answer);
    if (planned == nullptr) return made;
    const bool follows = scenario.mission.kind == MissionKind::path;
    const FlownShare flown = fly_all_states(
        planned->plan, follows ? laps_of_an_evaluation : flights_of_an_evaluation, seed_of_flights);
    made.allowed = true;
    made.mean_time_s = flown.mean_time_s;
    made.share = flown.share();
    made.safe_share = flown.safe_starts == 0 ? 0.0
                                             : static_cast<double>(flown.safe_arrive) /
                                                   static_cast<double>(flown.safe_starts);
    if (scenario.contract) prove_coarsely(planned->plan, scenario, *scenario.contract, made);
  } catch (const WarnedInputError&) {  // a goal in a wider buffer, for example
  }
  return made;
}

EvaluationLog::EvaluationLog(std::filesystem::path file, const std::vector<std::string>& keys)
    : file_(std::move(file)), keys_(keys.size()) {
  const std::string header = header_of(keys) + "\n";
  std::string text = file_text(file_);
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0
  if (!text.empty() && !text.starts_with(header)) {
    throw InputError(file_.string(), "is the log of other parameters; expected " + header_of(keys));
  }
  if (text.empty()) text = header;
  std::size_t number = 0;
  for (const std::string& line : parts_of(text, '\n')) {
    if (++number > 1) take_line(line, number);
  }
  write_whole(file_, Existing::replace, text);  // killed here, the process loses no line
  out_ = std::fopen(file_.c_str(), "ab");
  if (out_ == nullptr) throw InputError(file_.string(), "cannot be written");
}

EvaluationLog::~EvaluationLog() { std::fclose(out_); }

void EvaluationLog::take_line(const std::string& line, std::size_t number) {
  const std::vector<std::string> parts = parts_of(line, ',');
  if (parts.size() != keys_ + 5) {
    throw InputError(fmt::format("{}:{}", file_.string(), number),
                     fmt::format("expected {} values", keys_ + 5));
  }
  const auto first = parts.begin() + 1;
  Evaluation one;
  one.values.assign(first, first + static_cast<std::ptrdiff_t>(keys_));
  const auto measured = [&](std::size_t k) {
    return std::strtod(parts[keys_ + 1 + k].c_str(), nullptr);
  };
  one.allowed = measured(0) != 0.0;
  one.share = measured(1);
  one.safe_share = measured(2);
  one.mean_time_s = measured(3);
  by_values_[one.values] = all_.size();
  all_.push_back(std::move(one));
}

const Evaluation* EvaluationLog::find(const std::vector<std::string>& values) const {
  const auto found = by_values_.find(values);
  return found == by_values_.end() ? nullptr : &all_[found->second];
}

const Evaluation& EvaluationLog::add(Evaluation one) {
  const std::string line = line_of(one, all_.size() + 1);
  if (std::fwrite(line.data(), 1, line.size(), out_) != line.size() || std::fflush(out_) != 0) {
    throw InputError(file_.string(), "cannot be written");
  }
  by_values_[one.values] = all_.size();
  all_.push_back(std::move(one));
  return all_.back();
}

}  // namespace fairway
