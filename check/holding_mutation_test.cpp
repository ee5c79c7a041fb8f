// What is told to hold: the checker measures by itself how much does, and where that may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <variant>

#include "check/testing/refusal.hpp"
#include "check/testing/taken_apart.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/verification.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;

constexpr fairway::Vehicle vehicle{10.0, 20.0};

/// A goal in one room, a holding place in another.
fairway::Plan plan_with_a_closed_room() {
  fairway::ObstacleMap map;
  map.grid = {32, 17, 0.0, 0.0, 8.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (std::size_t i = 0; i < map.obstacle.size(); ++i) {
    const fairway::Cell c = map.grid.cell_at(i);
    const bool is_wall = c.ix == 0 || c.iy == 0 || c.ix == 16 || c.ix == 31 || c.iy == 16;
    map.obstacle[i] = is_wall ? 1 : 0;
  }
  const fairway::Mission mission = fairway::GoalMission{map.grid.center({24, 8}), {}};
  fairway::FieldOptions options;
  options.alpha = 0.5;
  options.beta = 1.0;
  return plan_of_field(std::get<fairway::Field>(compute_field(map, vehicle, mission, options)),
                       vehicle);
}

class HoldingMutation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("fairway-holding-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    fairway::Plan plan = plan_with_a_closed_room();
    ASSERT_EQ(plan.record.holding_places.size(), 1U);
    write_plan(plan, folder_ / "plan", fairway::Existing::replace);
    fairway::CertifyOptions exact;
    exact.samples = 4000;
    write_certificate(verify_plan(plan, "plan", {}, exact).certificate, folder_ / "exact",
                      fairway::Existing::replace);
    fairway::VehicleContract contract = fairway::VehicleContract::of(vehicle);
    contract.command_error_m = 0.8;
    contract.heading_error_rad = 0.005;
    contract.turn_radius_m = {19.8, 20.2};
    fairway::ContractVerifyOptions options;
    options.samples = 4000;
    options.find_witnesses = false;
    const auto made =
        verify_contract(plan, "plan", {}, contract, options, [](const std::string&) {});
    write_contract_certificate(made.certificate, folder_ / "contract", fairway::Existing::replace);
    plan.record.holding_places.clear();  // the arrays are those of a plan that says nothing of it
    write_plan(plan, folder_ / "silent", fairway::Existing::replace);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string changed(const char* name, const std::function<void(TakenApart&)>& change,
                             const std::string& plan = "") {
    std::ifstream in(folder_ / name, std::ios::binary);
    TakenApart parts(std::string(std::istreambuf_iterator<char>(in), {}));
    change(parts);
    parts.sign();
    std::ofstream(folder_ / "changed", std::ios::binary) << parts.file();
    return refusal_of(folder_ / "changed", plan, 2000);
  }

  static fs::path folder_;
};
fs::path HoldingMutation::folder_;

TEST_F(HoldingMutation, IsToldOfTrappedStatesWhereThePlanHoldsAndOfNoOthers) {
  for (const char* name : {"exact", "contract"}) {
    const std::string plan = folder_ / "plan";
    EXPECT_EQ(changed(
                  name, [](TakenApart&) {}, plan),
              "");
    EXPECT_THAT(changed(
                    name, [](TakenApart&) {}, folder_ / "silent"),
                testing::HasSubstr("is not where the plan holds"));
    // As many, by another name.
    EXPECT_THAT(changed(name,
                        [](TakenApart& parts) {
                          nlohmann::json& shares = parts.record["volume_fraction"];
                          ASSERT_GT(shares["hold"], 0.1);
                          shares["trapped"] =
                              shares["trapped"].get<double>() + shares["hold"].get<double>();
                          shares.erase("hold");
                        }),
                testing::HasSubstr("trapped is claimed as"));
    // A state with a goal to reach is not said to hold.
    EXPECT_THAT(changed(name,
                        [](TakenApart& parts) {
                          nlohmann::json& shares = parts.record["volume_fraction"];
                          shares["hold"] = shares["hold"].get<double>() + 0.1;
                          shares["reach"] = shares["reach"].get<double>() - 0.1;
                        }),
                testing::HasSubstr("is claimed as"));
    const std::size_t in_the_goals_room = 8 * 32 + 20;
    const auto add_cell = [&](TakenApart& parts) {
      parts.put<std::uint8_t>("holding", in_the_goals_room, 1);
    };
    EXPECT_THAT(changed(name, add_cell, plan), testing::HasSubstr("is not where the plan holds"));
    const auto in_a_wall = [](TakenApart& parts) { parts.put<std::uint8_t>("holding", 0, 1); };
    EXPECT_THAT(changed(name, in_a_wall), testing::HasSubstr("holding: expected 0, or 1"));
    // No leaf is proved by the word: without every other one, the rest is refused.
    const auto forget = [](TakenApart& parts) {
      for (std::size_t leaf = 0; leaf < parts.leaves(); leaf += 2) {
        if (parts.at<std::uint8_t>("leaf_verdict", leaf) != trapped) continue;
        parts.put<std::uint8_t>("leaf_verdict", leaf, undecided);
      }
    };
    EXPECT_NE(changed(name, forget), "");
  }
}

}  // namespace
}  // namespace fairway_check
