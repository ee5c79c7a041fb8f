// What a comparison found: plans side by side, and how each differs from the first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fairway/compare/common_ground.hpp"
#include "fairway/compare/plan_measures.hpp"
#include "fairway/verify/verdict.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// What is known of states: of the exact vehicle, or of every vehicle that keeps the contract.
enum class Knowledge : std::uint8_t { exact, contract };
constexpr const char* name_of(Knowledge of) {
  return of == Knowledge::exact ? "exact" : "contract";
}

/// One line of the table. NaN where there is none; a standard error of NaN is not known.
struct ComparedMeasure {
  std::string key;
  std::string group;  ///< what all lines of the group are a share, or a mean, of
  std::string name;
  std::string unit;                                 ///< "%": values are shares from 0 to 1
  int better = 0;                                   ///< 1: more is better; -1: less; 0: neither
  std::vector<SampledValue> value;                  ///< [plan]
  std::vector<SampledValue> difference_from_first;  ///< [plan]; of the first: 0
};

/// Of each cell, how many of its states only one of two plans brings to the mission, as far as that
/// is proved (or was seen).
struct DifferenceMap {
  VerdictMap places;                       ///< grid, cells, kinds; no verdicts
  std::size_t each = 0;                    ///< states in a sample: one for each heading
  std::vector<std::uint16_t> only_first;   ///< [sample]
  std::vector<std::uint16_t> only_second;  ///< [sample]
  std::vector<std::uint16_t> neither;      ///< [sample]
};

/// Two plans, state by state: shares of all states. A plan is said to prove a state when it is
/// proved that the mission is kept from there.
struct PairDifference {
  std::size_t first = 0;  ///< number of the plan
  std::size_t second = 0;
  Knowledge of = Knowledge::exact;
  SampledValue only_first;          ///< proved by the first and not by the second
  SampledValue only_second;         ///< the other way round
  SampledValue only_first_failing;  ///< of all states: and the second is proved to fail there
  SampledValue only_second_failing;
  SampledValue both;
  SampledValue neither;
  DifferenceMap map;
};

struct Comparison {
  std::vector<std::string> names;  ///< [plan]
  CommonGround ground;
  std::vector<PlanMeasures> measures;  ///< [plan]
  bool is_proved = false;              ///< of every plan; else its flights were seen
  bool has_contract = false;           ///< a contract certificate, of every plan
  /// [Knowledge] "reach the goal", "join the path and follow it", "reach the goal within the
  /// contract"; the second is empty without one.
  std::array<std::string, 2> does;
  SampledValue all_succeed;  ///< share of states whose flights succeed under every plan
  std::vector<ComparedMeasure> table;
  std::vector<PairDifference> pairs;  ///< the first with each other, exact and under the contract
  /// [Knowledge][plan][state]; empty where it is not known of every plan.
  std::array<std::vector<std::vector<Verdict>>, 2> verdicts;
  std::vector<std::string> warnings;

  /// "proved to reach the goal"; "seen to" where it was flown.
  std::string known_to(Knowledge of) const {
    const bool proved = of == Knowledge::contract || is_proved;
    return (proved ? "proved to " : "seen to ") + does[static_cast<std::size_t>(of)];
  }
};

}  // namespace fairway
