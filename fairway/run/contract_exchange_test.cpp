// The raster of a contract certificate says what queries say, at_risk included.
#include <array>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/map/testing/reading_rasters.hpp"
#include "fairway/map/testing/scratch_folder.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/plan_map.hpp"

namespace fairway {
namespace {

TEST(ContractExchange, ARasterHasABandForEachHeadingOfWhatQueriesSay) {
  ObstacleMap map;
  map.grid = {30, 22, -120.0, -80.0, 8.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (int ix = 8; ix < 22; ++ix) map.obstacle[map.grid.index({ix, 10})] = 1;
  const Plan plan = std::get<Plan>(plan_map(map, {10.0, 12.0}, GoalMission{{40.0, 60.0}, {}}, {}));
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 2.0;
  contract.heading_error_rad = 0.03;
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  const ContractCertificate certificate =
      verify_contract(plan, "plan", {}, contract, options, [](const std::string&) {}).certificate;
  const std::vector<Heading> headings = even_headings(3);
  ScratchFolder folder;
  write_contract_raster(plan.grid, {}, contract_layers(certificate, headings), folder.file("v.tif"),
                        Existing::keep);
  const std::vector<ReadBand> bands = bands_of(folder.file("v.tif"), plan.grid);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[1].name, "verdict at heading 2.0944 rad");
  std::array<std::size_t, verdict_count + 1> seen{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto replies = ask(certificate, states_asked_at(plan.grid, headings[k]));
    for (std::size_t i = 0; i < replies.size(); ++i) {
      const std::size_t code =
          replies[i].witness ? at_risk_code : static_cast<std::size_t>(replies[i].verdict);
      ASSERT_EQ(bands[k].values[i], static_cast<float>(code));
      ++seen[code];
      if (plan.region[i] == Region::obstacle) {
        EXPECT_EQ(replies[i].verdict, Verdict::collide);
      }
      if (plan.region[i] == Region::goal) {
        EXPECT_EQ(replies[i].verdict, Verdict::reach);
      }
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 100U);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 20U);
  EXPECT_GT(seen[at_risk_code], 0U);
}

}  // namespace
}  // namespace fairway
