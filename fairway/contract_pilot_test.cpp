// Vehicles that keep their contract, and take their courses from a ContractPilot that knows no more
// than their estimates, arrive in time.
#include "fairway/contract_pilot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr double step_m = 0.01;
constexpr double speed_mps = 1.0;

/// A goal among some obstacles, and as many directions as further modes.
Plan plan_with(std::size_t directions, std::uint64_t seed) {
  Random random = Random::stream(0x9110, seed);
  Plan plan = empty_plan(18, 15, 1.0, random.uniform(1.4, 2.4));
  plan.vehicle.speed_mps = speed_mps;
  const Vec2 goal{random.uniform(5.0, 13.0), random.uniform(4.0, 11.0)};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 to = goal - plan.grid.center(plan.grid.cell_at(i));
    plan.heading_rad[i] = static_cast<float>(std::atan2(to.y, to.x));
    if (norm2(to) < 4.0) plan.region[i] = Region::goal;
    if (norm2(to) >= 9.0 && random.below(30) == 0) {
      plan.region[i] = Region::obstacle;
      plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  for (std::size_t k = 0; k < directions; ++k) {
    const double at = 0.3 + 2.0 * pi * static_cast<double>(k) / static_cast<double>(directions);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), plan.grid.size(),
                                 static_cast<float>(std::remainder(at, 2.0 * pi)));
  }
  return plan;
}

VehicleContract contract_of(const Plan& plan) {
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  const double r = plan.vehicle.turn_radius_m;
  contract.turn_radius_m = {0.95 * r, 1.05 * r};
  contract.speed_mps.least *= 0.95;
  contract.command_error_m = 0.15;
  contract.heading_error_rad = 0.03;
  contract.side_uncertain_rad = 0.1;
  return contract;
}

/// A certificate's file in memory, aligned to 8 bytes.
struct Proved {
  explicit Proved(const Plan& plan) {
    ContractVerifyOptions options;
    options.samples = 1000;
    options.find_witnesses = false;
    options.parts_per_cell = 2;
    const auto made = verify_contract(plan, "the plan", {}, contract_of(plan), options,
                                      [](const std::string&) {});
    const auto path = std::filesystem::temp_directory_path() / "fairway_contract_pilot_test";
    write_contract_certificate(made.certificate, path, Existing::replace);
    std::ifstream in(path, std::ios::binary);
    const std::string file(std::istreambuf_iterator<char>(in), {});
    std::filesystem::remove(path);
    words.resize(file.size() / 8 + 1);
    std::memcpy(words.data(), file.data(), file.size());
    size = file.size();
  }
  std::vector<std::uint64_t> words;
  std::size_t size = 0;
};

struct Flown {
  Verdict begun = Verdict::undecided;  ///< what the pilot said at the start
  int first_mode = 0;
  int changes = 0;
  Verdict end = Verdict::undecided;
  double late_s = 0.0;  ///< seconds after what was told at the start
};

/// `eager`: how near to its bounds the estimate is.
Flown fly(const runtime::ContractCertificate& certificate, Vec2 place, double heading_rad,
          double eager, Random& random) {
  const VehicleContract& contract = *certificate.contract();
  const Flow& flow = *certificate.flow();
  runtime::ContractPilot pilot(certificate);
  Flown flown;
  double clock_s = 100.0;
  double deadline_s = 0.0;
  double off_rad = 0.0;
  double radius_m = contract.turn_radius_m.least;
  double error_rad = 0.0;
  double error_m = 0.0;
  int mode = 0;
  for (int k = 0;; ++k) {
    const Cell cell = flow.grid.cell_of(place);
    if (!flow.grid.contains(cell)) flown.end = Verdict::leave;
    if (flow.kind_at(cell) == CellKind::obstacle) flown.end = Verdict::collide;
    if (flow.kind_at(cell) == CellKind::target) flown.end = Verdict::reach;
    flown.late_s = clock_s - deadline_s;
    if (flown.end != Verdict::undecided || (k > 0 && flown.late_s > 1.0)) return flown;
    if (k % 40 == 0) {  // the errors change as they like
      radius_m = random.uniform(contract.turn_radius_m.least, contract.turn_radius_m.most);
      error_rad = eager * random.uniform(-1.0, 1.0) * (contract.heading_error_rad - 0.01);
      error_m = eager * (contract.command_error_m - 2.0 * step_m);
      off_rad = random.uniform(-pi, pi);
    }
    const double x = place.x + error_m * std::cos(off_rad);
    const double y = place.y + error_m * std::sin(off_rad);
    const double course_rad = std::remainder(heading_rad + error_rad, 2.0 * pi);
    const auto now = pilot.steer(clock_s, x, y, course_rad);
    if (k == 0) {
      flown.begun = now.answer.verdict;
      flown.first_mode = mode = now.answer.mode;
      if (flown.begun != Verdict::reach) return flown;
      deadline_s = clock_s + now.answer.time_bound_s;
    }
    EXPECT_LE(now.answer.mode, mode);
    flown.changes += now.answer.mode != mode ? 1 : 0;
    mode = now.answer.mode;
    const double most_rad = step_m / radius_m;
    const double turn_rad = std::remainder(now.course_rad - course_rad, 2.0 * pi);
    const double turned_rad = std::clamp(turn_rad, -most_rad, most_rad);
    const double middle_rad = heading_rad + 0.5 * turned_rad;
    place = place + step_m * Vec2{std::cos(middle_rad), std::sin(middle_rad)};
    heading_rad = std::remainder(heading_rad + turned_rad, 2.0 * pi);
    clock_s += step_m / (speed_mps * random.uniform(0.95, 1.0));
  }
}

TEST(ContractPilot, BringsWhoeverItSaysItBringsInTime) {
  std::array<int, 2> reached{};  // from mode 0, from further ones
  int changes = 0;
  for (const std::uint64_t seed : {1U, 2U}) {
    const Plan plan = plan_with(4, seed);
    const Proved proved(plan);
    runtime::ContractCertificate certificate;
    ASSERT_EQ(certificate.open(proved.words.data(), proved.size), runtime::Status::ok);
    ASSERT_EQ(certificate.modes(), 5);
    Random random = Random::stream(0x9111, seed);
    for (int k = 0; k < 350; ++k) {
      const Vec2 place{random.uniform(0.0, 18.0), random.uniform(0.0, 15.0)};
      const double heading_rad = random.uniform(-pi, pi);
      const runtime::Answer known = certificate.query(place.x, place.y, heading_rad);
      // Where obstacles and goal are, a flight has ended before it begins.
      const CellKind kind = certificate.flow()->kind_at(plan.grid.cell_of(place));
      if (kind == CellKind::obstacle || kind == CellKind::target) continue;
      const Flown flown =
          fly(certificate, place, heading_rad, 0.5 * static_cast<double>(random.below(3)), random);
      if (flown.begun != Verdict::reach) continue;
      EXPECT_EQ(known.verdict, Verdict::reach) << "all states around are proved, but not this one";
      ++reached[flown.first_mode > 0 ? 1 : 0];
      changes += flown.changes;
      ASSERT_EQ(flown.end, Verdict::reach)
          << "seed " << seed << ", state " << place.x << ", " << place.y << ", " << heading_rad
          << ", mode " << flown.first_mode << ", after " << flown.changes << " changes";
      ASSERT_LE(flown.late_s, 0.1);
    }
  }
  EXPECT_GT(reached[0], 150);
  EXPECT_GT(reached[1], 20);
  EXPECT_GE(changes, reached[1]);
}

TEST(ContractPilot, FliesOnWhereNothingIsProved) {
  const Plan plan = plan_with(2, 7);
  const Proved proved(plan);
  runtime::ContractCertificate certificate;
  ASSERT_EQ(certificate.open(proved.words.data(), proved.size), runtime::Status::ok);
  runtime::ContractPilot pilot(certificate);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pilot.steer(0.0, -50.0, 3.0, 0.0).answer.verdict, Verdict::undecided);
  EXPECT_FALSE(std::isnan(pilot.steer(0.1, -50.0, 3.0, 0.0).course_rad));
  EXPECT_EQ(pilot.steer(0.2, nan, 3.0, 0.0).answer.verdict, Verdict::undecided);
  EXPECT_TRUE(std::isnan(pilot.steer(0.3, nan, 3.0, 0.0).course_rad));
  EXPECT_EQ(certificate.query_around(3, 5.0, 5.0, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query_around(-1, 5.0, 5.0, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.hand_over(0, 5.0, 5.0, 0.0, 1e9).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.heading_rad(3), nullptr);
}

}  // namespace
}  // namespace fairway
