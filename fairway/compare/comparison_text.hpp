// A comparison as text, CSV and JSON.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/compare/compared_plan.hpp"
#include "fairway/compare/comparison.hpp"

namespace fairway {

/// Bad news first: what each other plan loses and wins against the first, one line each.
[[nodiscard]] std::vector<std::string> difference_lines(const Comparison& comparison);

/// The largest 95 % error of a share of all states.
[[nodiscard]] double error_of_shares(const Comparison& comparison);

/// "66.4 %", "62.1", "none"; and of the difference from the first "+4.3 ± 0.2", with its 95 % error
/// where that is known.
struct MeasureText {
  std::string value;
  std::string difference;  ///< empty for the first plan, and where there is none
  bool differs = false;    ///< by more than its 95 % error, where that is known
};
[[nodiscard]] MeasureText measure_text(const ComparedMeasure& measure, std::size_t plan);

/// The table in columns, a column for each plan; lines end with a newline.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);

/// A line for each measure and plan: measure,of,unit,plan,value,standard_error,states,
/// difference_from_first,difference_standard_error. Shares are from 0 to 1.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

/// The sampled states that one plan proves and another does not: x_m,y_m,heading_rad and each
/// one's verdict, verdict_1 for the first plan.
[[nodiscard]] std::string differing_states_csv(const Comparison& comparison, Knowledge of);

/// docs/formats.md, "comparison.json".
[[nodiscard]] nlohmann::json comparison_json(std::span<const ComparedPlan> plans,
                                             const Comparison& comparison);

}  // namespace fairway
