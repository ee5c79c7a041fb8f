#include "fairway/behaviour/witness_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "fairway/behaviour/find_witness.hpp"
#include "fairway/behaviour/testing/contract_trial.hpp"

namespace fairway {
namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> row(1);
    for (const char c : line) {
      if (c == ',') {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

TEST(WitnessCsv, EveryLineNamesACommandWithinReachAndTheLastIsTheEnd) {
  int witnesses = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ContractTrial trial = contract_trial(seed);
    const PlanFlow held(trial.plan);
    const Flow flow = held.flow();
    const VehicleContract& contract = trial.contract;
    const BehaviourChoices choices(flow, contract);
    const FailureGuide guide(choices);
    WitnessSearch search(choices, guide);
    Random random(seed);
    for (int k = 0; k < 10; ++k) {
      const State start = random_state(flow, random);
      const auto flight = search.find(start);
      if (!flight) continue;
      ++witnesses;
      const auto rows = rows_of(witness_csv(flow, choices.commands(), contract, *flight));
      ASSERT_EQ(rows.size(), flight->steps.size() + 2);
      EXPECT_EQ(rows[0][8], "command_y_m");
      EXPECT_EQ(std::stod(rows[1][1]), start.position_m.x);
      EXPECT_EQ(std::stod(rows[1][3]), start.heading.rad());
      for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto& row = rows[i];
        ASSERT_EQ(row.size(), 9U);
        if (i + 1 == rows.size()) {
          EXPECT_EQ(row[4] + row[5] + row[6] + row[7] + row[8], "");
          continue;
        }
        const double heading = std::stod(row[3]);
        const Vec2 ahead = Vec2{std::stod(row[1]), std::stod(row[2])} +
                           contract.look_ahead_m * Vec2{std::cos(heading), std::sin(heading)};
        const Vec2 asked{std::stod(row[7]), std::stod(row[8])};
        EXPECT_LE(norm(ahead - asked), contract.command_error_m + 1e-9);
        const double command =
            static_cast<double>(choices.commands()[flow.grid.index(flow.grid.cell_of(asked))]);
        if (row[5].empty()) continue;  // straight: within the error of a command
        EXPECT_LE(std::abs(std::remainder(std::stod(row[6]) - command, two_pi)),
                  contract.heading_error_rad + 1e-9);
        EXPECT_GE(std::stod(row[5]), contract.turn_radius_m.least);
        EXPECT_NEAR(std::abs(std::stod(row[4])), 1.0 / std::stod(row[5]), 1e-12);
        EXPECT_GE(std::stod(rows[i + 1][0]), std::stod(row[0]));
      }
    }
  }
  EXPECT_GT(witnesses, 50);
}

}  // namespace
}  // namespace fairway
