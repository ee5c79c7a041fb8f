#include "fairway/runtime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/certify.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size == 0 ? 1 : size)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept { std::free(place); }
void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace fairway {
namespace {

Plan plan_towards_the_middle() {
  Plan plan;
  plan.grid = {12, 10, -20.0, 5.0, 4.0};
  plan.vehicle = {10.0, 9.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.resize(plan.grid.size());
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const Vec2 to_goal = plan.grid.corner({6, 5}) - plan.grid.center(c);
    plan.heading_rad[i] = Heading::stored(std::atan2(to_goal.y, to_goal.x) + 0.1);
    if (norm(to_goal) < 9.0) plan.region[i] = Region::goal;
    if (c.ix == 2 && c.iy > 6) plan.region[i] = Region::obstacle;
  }
  return plan;
}

class RuntimeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Plan plan = plan_towards_the_middle();
    Certificate c;
    c.grid = plan.grid;
    c.vehicle = plan.vehicle;
    c.heading_rad = plan.heading_rad;
    c.region = plan.region;
    c.kind = cell_kinds(plan.grid, plan.region, {});
    CertifyOptions options;
    options.samples = 20'000;
    options.undecided_max = 0.001;
    Certified outcome = certify(c.flow(), std::vector<bool>(plan.grid.size(), true), options);
    c.sections = std::move(outcome.sections);
    const auto file = std::filesystem::temp_directory_path() / "fairway_runtime_test.safetensors";
    write_certificate(c, file, Existing::replace);
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    bytes() = text;
    std::filesystem::remove(file);
  }
  static std::string& bytes() {
    static std::string all;
    return all;
  }
  /// A copy aligned as a mapped file is.
  static std::vector<std::uint64_t> aligned(const std::string& text) {
    std::vector<std::uint64_t> words((text.size() + 7) / 8);
    std::copy(text.begin(), text.end(), reinterpret_cast<char*>(words.data()));
    return words;
  }
};

TEST_F(RuntimeTest, AnswersAgreeWithExactFlightsAndBoundTheirTimes) {
  const auto words = aligned(bytes());
  runtime::Certificate certificate;
  ASSERT_EQ(certificate.open(words.data(), bytes().size()), runtime::Status::ok);
  const Plan plan = plan_towards_the_middle();
  const ExactFlights flights(plan);
  Random random(3);
  int undecided = 0;
  for (int i = 0; i < 20'000; ++i) {
    const State s{{plan.grid.x0_m + random.unit() * plan.grid.width_m(),
                   plan.grid.y0_m + random.unit() * plan.grid.height_m()},
                  Heading::from_rad(random.uniform(-pi, pi))};
    const auto answer = certificate.query(s.position_m.x, s.position_m.y, s.heading.rad());
    const FlightResult flown = flights.fly(s);
    if (answer.verdict == Verdict::undecided) {
      ++undecided;
      continue;
    }
    ASSERT_STREQ(name_of(answer.verdict), name_of(flown.outcome))
        << s.position_m.x << "," << s.position_m.y << "," << s.heading.rad();
    if (answer.verdict == Verdict::reach) {
      ASSERT_GE(answer.time_bound_s, flown.time_s * (1.0 - 1e-12));
    } else {
      ASSERT_TRUE(std::isinf(answer.time_bound_s));
    }
  }
  EXPECT_LT(undecided, 200);
}

TEST_F(RuntimeTest, QueriesTouchNoHeap) {
  const auto words = aligned(bytes());
  runtime::Certificate certificate;
  const std::size_t before = allocations;
  ASSERT_EQ(certificate.open(words.data(), bytes().size()), runtime::Status::ok);
  for (int i = 0; i < 1000; ++i) {
    static_cast<void>(certificate.query(-20.0 + 0.04 * i, 20.0, 0.006 * i));
    static_cast<void>(certificate.command(-20.0 + 0.04 * i, 20.0, 0.006 * i));
  }
  EXPECT_EQ(allocations, before);
}

TEST_F(RuntimeTest, ACommandTurnsTheShortWay) {
  const auto words = aligned(bytes());
  runtime::Certificate certificate;
  ASSERT_EQ(certificate.open(words.data(), bytes().size()), runtime::Status::ok);
  const Plan plan = plan_towards_the_middle();
  const double psi = static_cast<double>(plan.heading_rad[0]);
  const double rate = plan.vehicle.speed_mps / plan.vehicle.turn_radius_m;
  EXPECT_EQ(certificate.command(-19.0, 6.0, psi - 0.1).turn_rate_radps, rate);
  EXPECT_EQ(certificate.command(-19.0, 6.0, psi + 0.1).turn_rate_radps, -rate);
  EXPECT_EQ(certificate.command(-19.0, 6.0, psi).turn_rate_radps, 0.0);
  EXPECT_TRUE(std::isnan(certificate.command(-100.0, 6.0, 0.0).heading_rad));
}

TEST_F(RuntimeTest, AStateInTheGoalHasReachedItAlready) {
  const auto words = aligned(bytes());
  runtime::Certificate certificate;
  ASSERT_EQ(certificate.open(words.data(), bytes().size()), runtime::Status::ok);
  for (const double y : {25.3, 25.0}) {  // the goal is about (4, 25), a border
    EXPECT_EQ(certificate.query(4.1, y, 0.3).verdict, Verdict::reach);
    EXPECT_EQ(certificate.query(4.1, y, 0.3).time_bound_s, 0.0);
  }
}

TEST_F(RuntimeTest, StatesOffTheGridOrNotFiniteAreNotMisjudged) {
  const auto words = aligned(bytes());
  runtime::Certificate certificate;
  EXPECT_EQ(certificate.query(0.0, 20.0, 0.0).verdict, Verdict::undecided);  // not open
  ASSERT_EQ(certificate.open(words.data(), bytes().size()), runtime::Status::ok);
  EXPECT_EQ(certificate.query(-100.0, 20.0, 0.0).verdict, Verdict::leave);
  EXPECT_EQ(certificate.query(NAN, 20.0, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query(0.0, INFINITY, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query(0.0, 20.0, NAN).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query(1e300, 20.0, 0.0).verdict, Verdict::undecided);
}

TEST_F(RuntimeTest, CommandsForAnyPlaceAreThoseOfTheProofAndTouchNoHeapOnceMade) {
  const auto words = aligned(bytes());
  runtime::FileArrays arrays;
  ASSERT_EQ(arrays.open(words.data(), bytes().size()), runtime::Status::ok);
  Flow flow;
  ASSERT_EQ(arrays.take_flow(flow), runtime::Status::ok);
  Random random(6);
  std::vector<float> commands(flow.heading_rad, flow.heading_rad + flow.grid.size());
  for (int round = 0; round < 40; ++round) {
    for (float& command : commands) {
      if (random.below(4) == 0) command = std::numeric_limits<float>::quiet_NaN();
    }
    const std::vector<float> filled = filled_commands(flow.grid, commands.data());
    const runtime::CommandField field(flow.grid, commands.data());
    runtime::TurnSide side;
    const std::size_t before = allocations;
    for (int k = 0; k < 500; ++k) {
      const Vec2 at{random.uniform(-60.0, 80.0), random.uniform(-40.0, 90.0)};
      const Cell cell = flow.grid.cell_of(at);
      const Cell on{std::clamp(cell.ix, 0, flow.grid.nx - 1),
                    std::clamp(cell.iy, 0, flow.grid.ny - 1)};
      const auto wanted = static_cast<double>(filled[flow.grid.index(on)]);
      const double command = field.command_rad(at.x, at.y);
      ASSERT_TRUE(command == wanted || (std::isnan(command) && std::isnan(wanted)));
      static_cast<void>(side.keep(command, random.uniform(-pi, pi)));
      static_cast<void>(runtime::point_ahead(at.x, at.y, 1.0, 2.0));
    }
    EXPECT_EQ(allocations, before);
  }
}

/// The certificate with `is` put in for `was` in its header.
std::string with_header(const std::string& file, const std::string& was, const std::string& is) {
  std::uint64_t length = 0;
  std::memcpy(&length, file.data(), 8);
  std::string header = file.substr(8, length);
  header.replace(header.find(was), was.size(), is);
  while (header.size() % 8 != 0) header += ' ';
  const std::uint64_t now = header.size();
  std::string all(8, '\0');
  std::memcpy(all.data(), &now, 8);
  return all + header + file.substr(8 + length);
}

TEST_F(RuntimeTest, HeadersThatOthersReadOtherwiseAreNotOpened) {
  runtime::Certificate certificate;
  const auto opens = [&](const std::string& was, const std::string& is) {
    const std::string file = with_header(bytes(), was, is);
    const auto words = aligned(file);
    return certificate.open(words.data(), file.size()) == runtime::Status::ok;
  };
  // Another place for an array, where the first of its names in the text would be looked for.
  const std::string other = R"("cell_kind":{"dtype":"U8","shape":[10,12],"data_offsets":[48,168]})";
  EXPECT_FALSE(opens(R"("__metadata__":{)", other + R"(,"__metadata__":{)"));
  EXPECT_FALSE(opens(R"("__metadata__":{)", R"("__metadata__":{)" + other + ","));
  EXPECT_FALSE(opens(R"("cell_kind":{)", R"("cell_kind":{"x":{)" + other + "},"));
  EXPECT_FALSE(opens(R"("shape":[10,12])", R"("shape":[12,10])"));
  EXPECT_FALSE(opens(R"("leaf_rank")", R"("leaf_ranks")"));
  EXPECT_TRUE(opens(R"("__metadata__":{)", "\n\t\"__metadata__\" : { "));
  EXPECT_TRUE(opens(R"("cell_kind":{"dtype":"U8","shape":[10,12])",
                    R"("cell\u005fkind" : { "shape": [10, 12],"dtype" : "U8")"));
}

TEST_F(RuntimeTest, NoDamagedFileMakesItReadBesideTheBytes) {
  runtime::Certificate certificate;
  EXPECT_EQ(certificate.open(nullptr, 0), runtime::Status::too_short);
  for (std::size_t size = 0; size < bytes().size(); size += 1 + size / 7) {  // cut short
    const auto words = aligned(bytes().substr(0, size));
    EXPECT_NE(certificate.open(words.data(), size), runtime::Status::ok) << size;
  }
  Random random(5);
  for (int i = 0; i < 3000; ++i) {  // a byte of the header or the first arrays altered
    std::string text = bytes();
    text[random.below(std::min<std::size_t>(text.size(), 6000))] = static_cast<char>(random.bits());
    const auto words = aligned(text);
    if (certificate.open(words.data(), text.size()) != runtime::Status::ok) continue;
    static_cast<void>(certificate.query(0.0, 20.0, 1.0));  // under the sanitizers: nothing beside
  }
}

}  // namespace
}  // namespace fairway
