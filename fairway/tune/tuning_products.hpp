// What a folder of `fairway tune` holds, and its numbers in words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/tune/tune.hpp"

namespace fairway {

namespace tuning_product {
inline constexpr const char* evaluations = "evaluations.csv";  ///< grows during the search
inline constexpr const char* search = "search.json";           ///< what it is about
inline constexpr const char* scenario = "scenario.toml";
}  // namespace tuning_product

/// What is written at the end, in one step.
[[nodiscard]] std::vector<std::string> tuning_product_names();

[[nodiscard]] std::string file_text(const std::filesystem::path& file);

/// The parameters, the objective, how many evaluations, and the Pareto front.
void add_tuning(nlohmann::json& summary, const std::vector<Evaluation>& all,
                const std::vector<std::string>& keys, const TuneRequest& request);

[[nodiscard]] std::string tuning_words(const nlohmann::json& summary,
                                       const std::filesystem::path& folder);

/// Throws InputError unless it is at least 1.
void require_range(const char* name, int value);

}  // namespace fairway
