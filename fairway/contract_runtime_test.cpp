// A vehicle gets the answers of `fairway query` from a mapped contract certificate, and nothing
// from a damaged one.
#include "fairway/contract_runtime.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

/// A file's bytes, aligned to 8.
struct FileBytes {
  explicit FileBytes(const std::string& text) : size(text.size()), words(text.size() / 8 + 1) {
    std::memcpy(words.data(), text.data(), size);
  }
  char* data() { return reinterpret_cast<char*>(words.data()); }
  std::size_t size;
  std::vector<std::uint64_t> words;
};

struct Proved {
  ContractCertificate certificate;
  std::string file;
};

Proved proved(std::uint64_t seed) {
  const Plan plan = random_plan(seed);
  Random random(seed);
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = random.uniform(0.0, 0.3) * plan.grid.cell_m;
  contract.look_ahead_m = random.uniform(0.0, 0.1) * plan.grid.cell_m;
  contract.turn_radius_m.most *= 1.1;
  contract.speed_mps.least *= 0.9;
  if (random.below(2) == 0) contract.wind_mps = 0.05 * contract.speed_mps.least;
  ContractVerifyOptions options;
  options.samples = 1000;
  options.find_witnesses = false;
  options.parts_per_cell = seed % 4 == 0 ? 2 : 1;
  Proved made{verify_contract(plan, "the plan", {}, contract, options, [](const std::string&) {})
                  .certificate,
              {}};
  const auto path = std::filesystem::temp_directory_path() / "fairway_contract_runtime_test";
  write_contract_certificate(made.certificate, path, Existing::replace);
  std::ifstream in(path, std::ios::binary);
  made.file.assign(std::istreambuf_iterator<char>(in), {});
  std::filesystem::remove(path);
  return made;
}

TEST(ContractRuntime, AnswersWhatAQueryAnswers) {
  std::array<int, verdict_count> seen{};
  for (std::uint64_t seed = 20; seed < 28; ++seed) {
    const Proved made = proved(seed);
    FileBytes bytes(made.file);
    runtime::ContractCertificate certificate;
    ASSERT_EQ(certificate.open(bytes.data(), bytes.size), runtime::Status::ok);
    const runtime::ContractCertificate moved = std::move(certificate);
    EXPECT_EQ(certificate.contract(), nullptr);
    ASSERT_NE(moved.contract(), nullptr);
    EXPECT_EQ(*moved.contract(), made.certificate.contract);
    EXPECT_EQ(moved.flow()->grid.nx, made.certificate.grid.nx);
    const Grid& grid = made.certificate.grid;
    Random random(seed);
    std::vector<State> states;
    for (int k = 0; k < 300; ++k) {
      // Some beside the grid, some far off, some on borders.
      const double far = k % 50 == 0 ? 1e9 : 1.1;
      Vec2 p{grid.x0_m + random.uniform(-0.1, far) * grid.width_m(),
             grid.y0_m + random.uniform(-0.1, far) * grid.height_m()};
      if (k % 7 == 0) p.x = grid.corner(grid.cell_of(p)).x;
      states.push_back({p, Heading::from_rad(random.uniform(-pi, pi))});
    }
    const std::vector<ContractReply> replies = ask(made.certificate, states);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const State& s = states[k];
      const runtime::Answer answer = moved.query(s.position_m.x, s.position_m.y, s.heading.rad());
      // As one of a box of states it may be decided, too, and its bound is that of the box.
      if (replies[k].verdict != Verdict::undecided) {
        ASSERT_EQ(answer.verdict, replies[k].verdict) << "seed " << seed << ", state " << k;
      }
      ++seen[static_cast<std::size_t>(answer.verdict)];
      if (answer.verdict == Verdict::reach) {
        EXPECT_GE(answer.time_bound_s, replies[k].time_bound_s);
        EXPECT_LT(answer.time_bound_s, HUGE_VAL);
      } else {
        EXPECT_TRUE(std::isinf(answer.time_bound_s));
      }
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::reach)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::leave)], 100);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::collide)], 20);
}

TEST(ContractRuntime, KnowsNothingBeforeItIsOpenedOrOfNoState) {
  const runtime::ContractCertificate none;
  EXPECT_EQ(none.query(1.0, 1.0, 0.0).verdict, Verdict::undecided);
  const Proved made = proved(21);
  FileBytes bytes(made.file);
  runtime::ContractCertificate certificate;
  ASSERT_EQ(certificate.open(bytes.data(), bytes.size), runtime::Status::ok);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(certificate.query(nan, 0.0, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query(0.0, HUGE_VAL, 0.0).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.query(0.0, 0.0, nan).verdict, Verdict::undecided);
  EXPECT_EQ(certificate.open(nullptr, 0), runtime::Status::too_short);
  EXPECT_EQ(certificate.flow(), nullptr) << "what was open before is closed";
}

TEST(ContractRuntime, OpensNoDamagedFileAndNeitherKindAsTheOther) {
  const Proved made = proved(22);
  Random random(9);
  std::size_t opened = 0;
  for (int k = 0; k < 400; ++k) {
    FileBytes bytes(made.file);
    // The header, or the arrays that queries follow.
    const std::size_t at =
        random.below(k % 2 == 0 ? std::min<std::size_t>(6000, bytes.size) : bytes.size);
    bytes.data()[at] = static_cast<char>(random.below(256));
    if (k % 5 == 0) bytes.size = random.below(bytes.size);
    runtime::ContractCertificate certificate;
    if (certificate.open(bytes.data(), bytes.size) != runtime::Status::ok) continue;
    ++opened;  // then no query may read out of bounds
    const Grid& grid = made.certificate.grid;
    for (int q = 0; q < 20; ++q) {
      (void)certificate.query(grid.x0_m + random.unit() * grid.width_m(),
                              grid.y0_m + random.unit() * grid.height_m(), random.uniform(-pi, pi));
    }
  }
  EXPECT_LT(opened, 300U);
  FileBytes bytes(made.file);
  runtime::Certificate exact;
  EXPECT_EQ(exact.open(bytes.data(), bytes.size), runtime::Status::not_certificate);
}

}  // namespace
}  // namespace fairway
