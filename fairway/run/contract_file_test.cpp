#include "fairway/run/contract_file.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_overrides.hpp"

namespace fairway {
namespace {

constexpr Vehicle vehicle{10.0, 20.0};

const std::string scenario_without = R"([map]
file = "m.yaml"
cell_m = 4
[vehicle]
speed_mps = 10.0
turn_radius_m = 20.0
[mission]
kind = "goal"
goal_m = [120.0, 340.0]
)";
const std::string scenario_with = scenario_without + R"([vehicle.contract]
command_error_m = 6
heading_error_rad = 0.035
turn_radius_m = [18, 22]
)";

VehicleContract contract_with() {
  VehicleContract c = VehicleContract::of(vehicle);
  c.command_error_m = 6.0;
  c.heading_error_rad = 0.035;
  c.turn_radius_m = {18.0, 22.0};
  return c;
}

template <typename Read>
std::string refusal(const Read& read) {
  try {
    (void)read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string refusal_of_contract(const std::string& text) {
  return refusal([&] { return contract_of_text(text, "c.toml", vehicle); });
}
std::string refusal_of_scenario(const std::string& text) {
  return refusal([&] { return scenario_of_text(text, "s.toml"); });
}

TEST(ContractsInScenarios, HaveWhatIsGivenAndTheExactVehicleForTheRest) {
  EXPECT_FALSE(scenario_of_text(scenario_without, "s.toml").contract);
  EXPECT_EQ(scenario_of_text(scenario_with, "s.toml").contract, contract_with());
  EXPECT_EQ(scenario_of_text(scenario_without + "[vehicle.contract]\n", "s.toml").contract,
            VehicleContract::of(vehicle));
  // Before the vehicle, and inside it.
  EXPECT_EQ(scenario_of_text("[vehicle.contract]\nwind_mps = 1\n" + scenario_without, "s.toml")
                .contract->speed_mps,
            (SizeRange{10.0, 10.0}));
  std::string inside = scenario_without;
  inside.insert(inside.find("[mission]"), "contract = { wind_mps = 2 }\n");
  EXPECT_EQ(scenario_of_text(inside, "s.toml").contract->wind_mps, 2.0);
}

TEST(ContractsInScenarios, AreRefusedAtTheLineOfTheKey) {
  const struct {
    const char* line;
    const char* message;
  } cases[] = {
      {"turn_radius_m = [22, 18]",
       "s.toml:11: vehicle.contract.turn_radius_m: is [22, 18] m, expected the smaller number "
       "first: [18, 22]"},
      {"speed_mps = [11, 12]",
       "s.toml:11: vehicle.contract.speed_mps: is [11, 12] m/s and does not contain the plan's 10 "
       "m/s, expected a range that contains it, such as [10, 12]"},
      {"command_error_m = -1",
       "s.toml:11: vehicle.contract.command_error_m: is -1 m, expected 0 to 1e15"},
      {"heading_error_rad = 2.0",
       "s.toml:11: vehicle.contract.heading_error_rad: is 2 rad, expected at least 0 and less than "
       "1.5708: with more, a vehicle may turn either way everywhere; 2 degrees are 0.034907 rad"},
      {"wind_mps = 12",
       "s.toml:11: vehicle.contract.wind_mps: is 12 m/s, expected less than the least speed, 10 "
       "m/s: the wind carries a slower vehicle away"},
      {"wind_mps = nan",
       "s.toml:11: vehicle.contract.wind_mps: expected a number finite, found nan"},
      {"turn_radius_m = 20.0",
       "s.toml:11: vehicle.contract.turn_radius_m: expected an array of two numbers, found 20.0"},
      {"turn_radius_m = [18, 20, 22]",
       "s.toml:11: vehicle.contract.turn_radius_m: expected an array of two numbers, found"},
      {"wind_mps = \"2\"", "s.toml:11: vehicle.contract.wind_mps: expected a number, found"},
      {"comand_error_m = 1",
       "s.toml:11: vehicle.contract.comand_error_m: there is no such key; did you mean "
       "vehicle.contract.command_error_m?"},
      {"alpha = 1",
       "s.toml:11: vehicle.contract.alpha: there is no such key; did you mean plan.alpha?"},
  };
  for (const auto& [line, message] : cases) {
    const std::string said =
        refusal_of_scenario(scenario_without + "[vehicle.contract]\n" + line + "\n");
    EXPECT_TRUE(said.starts_with(message)) << said;
  }
  EXPECT_EQ(refusal_of_scenario(scenario_without + "[vehicle.contrat]\nwind_mps = 1\n"),
            "s.toml:10: vehicle.contrat: there is no such key; did you mean vehicle.contract?");
  EXPECT_EQ(refusal_of_scenario(scenario_without + "[contract]\nwind_mps = 1\n"),
            "s.toml:10: contract: there is no such key; did you mean vehicle.contract?");
  std::string outside = scenario_without;
  outside.insert(outside.find("[mission]"), "command_error_m = 1\n");
  EXPECT_EQ(refusal_of_scenario(outside),
            "s.toml:7: vehicle.command_error_m: there is no such key; did you mean "
            "vehicle.contract.command_error_m?");
  outside = scenario_without;
  outside.insert(outside.find("[mission]"), "contract = 3\n");
  EXPECT_EQ(refusal_of_scenario(outside),
            "s.toml:7: vehicle.contract: expected a table, [vehicle.contract]");
}

TEST(ContractsInScenarios, AreSetFromTheCommandLine) {
  const auto with = [](const std::string& text, const std::string& set) {
    const ScenarioOverride one = override_of_text(set);
    return scenario_of_text(text, "s.toml", std::span(&one, 1));
  };
  EXPECT_EQ(with(scenario_with, "vehicle.contract.wind_mps=1").contract->wind_mps, 1.0);
  EXPECT_EQ(with(scenario_with, "vehicle.contract.wind_mps=1").contract->command_error_m, 6.0);
  const Scenario made = with(scenario_without, "vehicle.contract.turn_radius_m=[19, 21]");
  ASSERT_TRUE(made.contract);
  EXPECT_EQ(made.contract->turn_radius_m, (SizeRange{19.0, 21.0}));
  EXPECT_EQ(made.contract->speed_mps, (SizeRange{10.0, 10.0}));
  nlohmann::json summary;
  add_overrides(summary, made);
  EXPECT_EQ(summary["set"]["vehicle.contract.turn_radius_m"], (nlohmann::json{19.0, 21.0}));
  EXPECT_EQ(refusal([&] { return with(scenario_with, "vehicle.contract.wind_mps=11"); }),
            "--set: vehicle.contract.wind_mps: is 11 m/s, expected less than the least speed, 10 "
            "m/s: the wind carries a slower vehicle away");
  EXPECT_EQ(refusal([&] { return with(scenario_with, "vehicle.contract={}"); }),
            "--set: vehicle.contract: is a table, expected one of its keys, such as "
            "vehicle.contract.command_error_m");
  // A radius set beside a contract takes part, too.
  EXPECT_EQ(with(scenario_without + "[vehicle.contract]\n", "vehicle.turn_radius_m=30")
                .contract->turn_radius_m,
            (SizeRange{30.0, 30.0}));
}

TEST(ContractsInScenarios, StandInThePlansRecordAndTheSummaryIfThereAreAny) {
  const Scenario with = scenario_of_text(scenario_with, "s.toml");
  const std::array papers{ScenarioOverride{"plan.preset", "paper"}};  // as with a contract
  const Scenario without = scenario_of_text(scenario_without, "s.toml", papers);
  const ObstacleMap map;
  const Mission mission = GoalMission{};
  EXPECT_EQ(plan_record(with, map, mission).contract, contract_with());
  EXPECT_FALSE(plan_record(without, map, mission).contract);
  EXPECT_EQ(plan_record(with, map, mission).options_json,
            plan_record(without, map, mission).options_json);
  EXPECT_EQ(effective_values(with, "vehicle")["contract"]["turn_radius_m"],
            (nlohmann::json{18.0, 22.0}));
  EXPECT_EQ(effective_values(without, "vehicle"),
            (nlohmann::json{{"speed_mps", 10.0}, {"turn_radius_m", 20.0}}));
}

TEST(ContractFiles, AreAContractAloneOrAWholeScenario) {
  EXPECT_EQ(contract_of_text(scenario_with, "s.toml", vehicle), contract_with());
  const std::string alone = scenario_with.substr(scenario_with.find("[vehicle.contract]"));
  EXPECT_EQ(contract_of_text(alone, "c.toml", vehicle), contract_with());
  EXPECT_EQ(contract_of_text("[vehicle.contract]\n", "c.toml", vehicle),
            VehicleContract::of(vehicle));
  // Its own vehicle says what its ranges are.
  EXPECT_EQ(refusal_of_contract("[vehicle]\nturn_radius_m = 25\n[vehicle.contract]\n"),
            "c.toml: vehicle.contract.turn_radius_m: is [25, 25] m and does not contain the plan's "
            "20 m, expected a range that contains it, such as [20, 25]");
}

TEST(ContractFiles, WithoutAContractSaySo) {
  for (const std::string& text : {std::string(), scenario_without}) {
    EXPECT_EQ(refusal_of_contract(text),
              "c.toml: has no table [vehicle.contract], expected one: it says what the vehicle "
              "keeps (docs/scenario.md)");
  }
  EXPECT_TRUE(refusal_of_contract("[vehicle.contract\n").starts_with("c.toml:1: is not TOML"));
  EXPECT_EQ(refusal_of_contract("command_error_m = 3\n"),
            "c.toml:1: command_error_m: there is no such key; did you mean "
            "vehicle.contract.command_error_m?");
  EXPECT_EQ(refusal_of_contract("[vehicle.contract]\n\nturn_radius_m = [22, 18]\n"),
            "c.toml:3: vehicle.contract.turn_radius_m: is [22, 18] m, expected the smaller number "
            "first: [18, 22]");
}

TEST(ContractFiles, GiveBackWhatWasWritten) {
  const ScratchFolder folder;
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    VehicleContract c;
    c.command_error_m = random.unit() * 30.0;
    c.look_ahead_m = random.below(2) == 0 ? 0.0 : random.unit();
    c.turn_radius_m = {20.0 * random.unit(), 20.0 + random.unit()};
    c.speed_mps = {10.0 - random.unit(), 10.0 + 1e6 * random.unit()};
    c.hold_side_rad = 0.01 + random.unit() * 3.0;
    c.heading_error_rad = random.unit() * std::min(c.hold_side_rad, 1.5);
    c.side_uncertain_rad = random.unit() * 1e-7;
    c.wind_mps = random.unit();
    ASSERT_EQ(contract_of_text(contract_toml(c), "c.toml", vehicle), c) << contract_toml(c);
  }
  EXPECT_EQ(contract_toml(contract_with()),
            "[vehicle.contract]\ncommand_error_m = 6.0\nlook_ahead_m = 0.0\nheading_error_rad = "
            "0.035\nturn_radius_m = [18.0, 22.0]\nspeed_mps = [10.0, 10.0]\nhold_side_rad = "
            "1.5707963267948966\nside_uncertain_rad = 0.0\nwind_mps = 0.0\n");
}

TEST(ContractFiles, AreToldInASentence) {
  VehicleContract c = contract_with();
  EXPECT_EQ(contract_words(c),
            "keeps a contract: the command of a place within 6 m, give or take 0.035 rad; turns of "
            "18 to 22 m; 10 m/s");
  c.look_ahead_m = 3.0;
  c.wind_mps = 2.5;
  c.speed_mps = {9.0, 11.0};
  EXPECT_EQ(
      contract_words(c),
      "keeps a contract: the command of a place within 6 m of the point 3 m ahead, give or take "
      "0.035 rad; turns of 18 to 22 m; 9 to 11 m/s through air that moves at up to 2.5 m/s");
}

}  // namespace
}  // namespace fairway
