#include "fairway/tune/tuning_products.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {

using nlohmann::json;

std::vector<std::string> tuning_product_names() {
  return {tuning_product::scenario,
          product::plan,
          product::certificate,
          product::contract_certificate,
          "search.svg",
          "search.png",
          "pareto.svg",
          "pareto.png",
          product::summary};
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void require_range(const char* name, int value) {
  if (value < 1) throw InputError("", fmt::format("{} is {}, expected at least 1", name, value));
}

void add_tuning(json& summary, const std::vector<Evaluation>& all,
                const std::vector<std::string>& keys, const TuneRequest& request) {
  json front = json::array();
  for (const std::size_t i : pareto_front(all)) {
    front.push_back(
        {{"values", all[i].values}, {"share", all[i].share}, {"mean_time_s", all[i].mean_time_s}});
  }
  std::size_t refused = 0;
  for (const Evaluation& one : all) refused += one.allowed ? 0 : 1;
  summary["tuning"] = {{"parameters", keys},
                       {"objective",
                        {{"reach", request.objective.reach},
                         {"safe", request.objective.safe},
                         {"time", request.objective.time}}},
                       {"evaluations", all.size()},
                       {"refused", refused},
                       {"pareto_front", front}};
}

std::string tuning_words(const json& summary, const std::filesystem::path& folder) {
  const json& tuning = summary["tuning"];
  const json& given = summary["given_share"];
  std::string words = fmt::format(
      "{} of all states are proved to succeed with the best of {} evaluations; {}.\n",
      percent_text(summary["tuned_share"].get<double>(), 2),
      tuning["evaluations"].get<std::size_t>(),
      given.is_null() ? "the scenario as given does not allow the mission"
                      : percent_text(given.get<double>(), 2) + " with the scenario as given");
  for (std::size_t i = 0; i < tuning["parameters"].size(); ++i) {
    words += fmt::format("  {} = {}\n", tuning["parameters"][i].get<std::string>(),
                         summary["tuned_values"][i].get<std::string>());
  }
  return words + fmt::format("{}\nLook at {} and {}.", cost_words(summary),
                             (folder / tuning_product::scenario).string(),
                             (folder / "search.svg").string());
}

}  // namespace fairway
