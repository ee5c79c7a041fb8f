#include "fairway/runtime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/inclusion_prover.hpp"
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
// std::stable_sort asks this one; what it gives is freed below as well.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
// Not inlined: where only one of the pair is, GCC takes them for a mismatch.
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }

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

/// The plan towards the middle, and two fields that go on in one direction.
Certificate certificate_with_modes() {
  const Plan plan = plan_towards_the_middle();
  Certificate c;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.kind = cell_kinds(plan.grid, plan.region, {});
  c.mode_heading_rad.assign(2 * plan.grid.size(), 0.5F);
  std::fill_n(c.mode_heading_rad.begin(), plan.grid.size(), -2.0F);
  CertifyOptions options;
  options.samples = 20'000;
  const std::vector<const float*> further{c.mode_heading_rad.data(),
                                          c.mode_heading_rad.data() + plan.grid.size()};
  Certified outcome =
      certify(c.flow(), std::vector<bool>(plan.grid.size(), true), options, {}, {}, further);
  c.sections = std::move(outcome.sections);
  c.mode_sections = std::move(outcome.further);
  c.plan.mode_heading_rad = sha256_hex(std::as_bytes(std::span(c.mode_heading_rad)));
  c.plan.heading_rad = sha256_hex(std::as_bytes(std::span(c.heading_rad)));
  c.plan.region = sha256_hex(std::as_bytes(std::span(c.region)));
  return c;
}

TEST_F(RuntimeTest, ACertificateWithModesIsReadWholeAndAnswersByMode) {
  const Certificate made = certificate_with_modes();
  const auto file = std::filesystem::temp_directory_path() / "fairway_runtime_modes.safetensors";
  write_certificate(made, file, Existing::replace);
  const Certificate read = read_certificate(file);
  EXPECT_EQ(read.mode_heading_rad, made.mode_heading_rad);
  EXPECT_EQ(read.mode_sections.first, made.mode_sections.first);
  EXPECT_EQ(read.mode_sections.time_s, made.mode_sections.time_s);
  EXPECT_EQ(read.mode_sections.next_mode, made.mode_sections.next_mode);
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  const auto words = aligned(text);
  runtime::Certificate certificate;
  ASSERT_EQ(certificate.open(words.data(), text.size()), runtime::Status::ok);
  ASSERT_EQ(certificate.modes(), 3);
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double x = made.grid.x0_m + random.unit() * made.grid.width_m();
    const double y = made.grid.y0_m + random.unit() * made.grid.height_m();
    const double h = random.uniform(-pi, pi);
    const ProvedState known = ask_all_modes(made.view(), x, y, h);
    const runtime::Answer answer = certificate.query(x, y, h);
    ASSERT_EQ(answer.verdict, known.verdict);
    ASSERT_EQ(answer.mode, known.mode);
    ASSERT_EQ(answer.time_bound_s, known.time_s);
    runtime::ModePilot pilot(certificate);
    const runtime::Answer flown = pilot.steer(x, y, h).answer;
    const bool is_proved = known.verdict == Verdict::reach;
    ASSERT_EQ(flown.mode, is_proved ? known.mode : liked_mode(made.view(), 0, x, y, h));
    ASSERT_EQ(flown.verdict == Verdict::reach, is_proved);
  }
  for (const int none : {-1, 3, 1000}) {  // under the sanitizers: nothing beside
    EXPECT_EQ(certificate.query_mode(none, 0.0, 20.0, 1.0).verdict, Verdict::undecided);
    EXPECT_TRUE(std::isnan(certificate.command(0.0, 20.0, 1.0, none).heading_rad));
  }
  EXPECT_EQ(certificate.query_before(99, 0.0, 20.0, 1.0).verdict,
            certificate.query(0.0, 20.0, 1.0).verdict);
}

TEST_F(RuntimeTest, ModesThatDoNotFitAreRefusedByEveryReader) {
  const auto file = std::filesystem::temp_directory_path() / "fairway_runtime_spoilt.safetensors";
  const auto refused = [&](const std::function<void(SectionVerdicts&)>& spoil) {
    Certificate c = certificate_with_modes();
    spoil(c.mode_sections);
    write_certificate(c, file, Existing::replace);
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto words = aligned(text);
    runtime::Certificate certificate;
    EXPECT_NE(certificate.open(words.data(), text.size()), runtime::Status::ok);
    EXPECT_EQ(certificate.query(0.0, 20.0, 1.0).verdict, Verdict::undecided);
    EXPECT_THROW(static_cast<void>(read_certificate(file)), InputError);
  };
  refused([](SectionVerdicts& s) { s.next_mode.front() = 99; });
  refused([](SectionVerdicts& s) { s.verdict.front() = 77; });
  refused([](SectionVerdicts& s) { s.first.back() += 1; });
  refused([](SectionVerdicts& s) { s.next_mode.pop_back(); });
  std::filesystem::remove(file);
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

/// Of a certificate under a contract that decides nothing.
std::string contract_file(const Plan& plan, const std::vector<CellKind>& kinds) {
  ContractCertificate c;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.contract = VehicleContract::of(plan.vehicle);
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.kind = kinds;
  c.verdicts.first.assign(4 * plan.grid.size() + 1, 0);
  c.verdicts.group_heading_rad = {std::numeric_limits<float>::quiet_NaN()};
  c.verdicts.group_time_s = {std::numeric_limits<float>::infinity()};
  const auto path = std::filesystem::temp_directory_path() / "fairway_runtime_contract.safetensors";
  write_contract_certificate(c, path, Existing::replace);
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return text;
}

TEST_F(RuntimeTest, CommandsAreReadFromCertificatesOfBothKindsAndOfNoOtherFile) {
  const Plan plan = plan_towards_the_middle();
  const auto kinds = cell_kinds(plan.grid, plan.region, {});
  const auto status = [](const std::string& text, Flow& flow) {
    static std::vector<std::uint64_t> words;  // outlives the flow
    words = aligned(text);
    runtime::FileArrays arrays;
    const auto opened = arrays.open(words.data(), text.size());
    return opened == runtime::Status::ok ? arrays.take_flow(flow) : opened;
  };
  const std::string whole = contract_file(plan, kinds);
  for (const std::string& text : {bytes(), whole}) {
    Flow flow;
    ASSERT_EQ(status(text, flow), runtime::Status::ok);
    EXPECT_EQ(flow.grid, plan.grid);
    EXPECT_EQ(flow.vehicle, plan.vehicle);
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      ASSERT_EQ(flow.heading_rad[i], plan.heading_rad[i]);
      ASSERT_EQ(flow.kind[i], kinds[i]);
    }
  }
  Flow flow;
  Plan flat = plan;
  flat.grid.cell_m = 0.0;
  EXPECT_EQ(status(contract_file(flat, kinds), flow), runtime::Status::misfit);
  auto odd = kinds;
  odd[7] = static_cast<CellKind>(3);
  EXPECT_EQ(status(contract_file(plan, odd), flow), runtime::Status::misfit);
  EXPECT_EQ(status(with_header(whole, R"("cell_kind":{)", R"("cell_king":{)"), flow),
            runtime::Status::misfit);
  EXPECT_EQ(status(with_header(whole, R"("heading_rad":{)", R"("heading_deg":{)"), flow),
            runtime::Status::not_certificate);
  EXPECT_EQ(status(whole.substr(0, whole.size() - 1), flow), runtime::Status::not_certificate);
  runtime::Certificate exact;
  const auto words = aligned(whole);
  EXPECT_EQ(exact.open(words.data(), whole.size()), runtime::Status::not_certificate);
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

/// A vehicle as on board: it sees its place and course with errors, asks for a command now and
/// then, and has an autopilot that turns to the shorter side of what it is handed.
class FlownOnBoard {
 public:
  static constexpr double period_m = 0.5;
  static constexpr double place_error_m = 0.4;
  static constexpr double course_error_rad = 0.03;

  /// What it keeps: between two questions it flies on by the period, with the command of before.
  static VehicleContract contract(const Vehicle& vehicle) {
    VehicleContract c = VehicleContract::of(vehicle);
    c.command_error_m = period_m + place_error_m;
    c.heading_error_rad = course_error_rad;
    c.turn_radius_m = {0.93 * vehicle.turn_radius_m, 1.07 * vehicle.turn_radius_m};
    return c;
  }

  FlownOnBoard(const runtime::CommandField& commands, const VehicleContract& contract, Vec2 at,
               double course_rad, std::uint64_t seed)
      : commands_(commands),
        contract_(contract),
        at_(at),
        course_rad_(course_rad),
        side_(contract.hold_side_rad),
        random_(seed) {}

  Vec2 at() const { return at_; }

  void fly(double length_m) {
    until_m_ -= length_m;
    if (until_m_ <= 0.0) ask();
    const double most = length_m / radius_m_;
    const double wanted = std::remainder(handed_rad_ - (course_rad_ + course_seen_off_), 2.0 * pi);
    const double turn = std::clamp(wanted, -most, most);
    at_ = at_ + length_m * Heading::from_rad(course_rad_ + 0.5 * turn).unit();
    course_rad_ += turn;
  }

 private:
  void ask() {
    until_m_ = period_m;
    const double angle = random_.uniform(-pi, pi);
    const Vec2 seen = at_ + place_error_m * random_.unit() * Heading::from_rad(angle).unit();
    course_seen_off_ = random_.uniform(-course_error_rad, course_error_rad);
    radius_m_ = random_.uniform(contract_.turn_radius_m.least, contract_.turn_radius_m.most);
    handed_rad_ = side_.keep(commands_.command_rad(seen.x, seen.y), course_rad_ + course_seen_off_);
  }

  const runtime::CommandField& commands_;
  const VehicleContract& contract_;
  Vec2 at_;
  double course_rad_;
  runtime::TurnSide side_;
  Random random_;
  double until_m_ = 0.0;
  double handed_rad_ = 0.0;
  double course_seen_off_ = 0.0;
  double radius_m_ = 0.0;
};

TEST(RuntimeUnderAContract, TheLoopOfTheDocsDoesWhatIsProvedOfItsContract) {
  Plan plan = plan_towards_the_middle();
  for (const std::size_t lost : {3U, 14U, 40U, 95U}) {
    plan.heading_rad[lost] = std::numeric_limits<float>::quiet_NaN();
  }
  const auto kinds = cell_kinds(plan.grid, plan.region, {});
  const Flow flow{plan.grid, plan.vehicle, plan.heading_rad.data(), kinds.data()};
  const VehicleContract contract = FlownOnBoard::contract(plan.vehicle);
  const Parts parts(flow, contract, 2);
  InclusionProver prover(parts, {});
  ASSERT_TRUE(prover.run([](const InclusionLevel&) {}));
  const ContractVerdicts verdicts = prover.verdicts(contract.speed_mps.least);
  const runtime::CommandField commands(flow.grid, flow.heading_rad);
  Random random(8);
  std::array<int, verdict_count> seen{};
  for (int k = 0; k < 1500; ++k) {
    const Vec2 start{plan.grid.x0_m + random.unit() * plan.grid.width_m(),
                     plan.grid.y0_m + random.unit() * plan.grid.height_m()};
    const double course_rad = random.uniform(-pi, pi);
    const Vec2 in_parts = (1.0 / parts.part_m()) * (start - plan.grid.corner({0, 0}));
    const ContractAnswer answer =
        contract_answer(parts, verdicts, contract.speed_mps.least, in_parts, course_rad);
    ++seen[static_cast<std::size_t>(answer.verdict)];
    if (answer.verdict == Verdict::undecided || answer.verdict == Verdict::trapped) continue;
    for (int flight = 0; flight < 3; ++flight) {
      FlownOnBoard vehicle(commands, contract, start, course_rad, random.bits());
      constexpr double step_m = 0.05;
      Verdict end = Verdict::undecided;
      const double most_m = answer.worst_time_s * contract.speed_mps.least + 1.0;
      for (double way = 0.0; way < most_m && end == Verdict::undecided; way += step_m) {
        const CellKind kind = flow.kind_at(flow.grid.cell_of(vehicle.at()));
        end = kind == CellKind::obstacle  ? Verdict::collide
              : kind == CellKind::target  ? Verdict::reach
              : kind == CellKind::outside ? Verdict::leave
                                          : Verdict::undecided;
        vehicle.fly(step_m);
      }
      ASSERT_EQ(end, answer.verdict) << start.x << "," << start.y << "," << course_rad;
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 700);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::leave)], 20);
}

}  // namespace
}  // namespace fairway
