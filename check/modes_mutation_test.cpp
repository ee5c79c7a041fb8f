// Certificates of plans with modes: what the prover makes of them is accepted, and no change to it
// that claims more is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "check/testing/plans_with_modes.hpp"
#include "check/testing/refusal.hpp"
#include "check/testing/sample_certificate.hpp"
#include "check/testing/taken_apart.hpp"
#include "fairway/plan/plan_file.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;

class ModesMutation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("fairway-modes-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write_sample(street(), folder_ / "good");
    good_ = read(folder_ / "good");
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string refusal(const std::string& bytes, std::size_t samples = 20000) {
    std::ofstream(folder_ / "changed", std::ios::binary) << bytes;
    return refusal_of(folder_ / "changed", "", samples);
  }
  static std::string refusal(TakenApart parts, std::size_t samples = 0) {
    parts.sign();
    return refusal(parts.file(), samples);
  }

  static fs::path folder_;
  static std::string good_;
};
fs::path ModesMutation::folder_;
std::string ModesMutation::good_;

TEST_F(ModesMutation, WhatTheProverMadeIsAccepted) {
  EXPECT_EQ(refusal(good_), "");
  TakenApart parts(good_);
  EXPECT_EQ(refusal(parts, 20000), "");
  // The plan is one for which modes matter, and has leaves of every kind.
  EXPECT_GT(parts.record["reach_by_mode"][1].get<double>(), 0.02);
  std::vector<int> handed_to(5, 0);
  int deep = 0;
  for (std::size_t i = 0; i < mode_leaves(parts); ++i) {
    const ModeLeaf leaf{parts, i};
    if (leaf.hands_over()) ++handed_to.at(leaf.next());
    deep += leaf.rank() > 1 ? 1 : 0;
  }
  EXPECT_GT(handed_to[0], 10);
  EXPECT_GT(handed_to[1] + handed_to[2] + handed_to[3], 3);
  EXPECT_GT(deep, 10);
  EXPECT_FALSE(some_leaves(parts, 1, is_open).empty());
}

TEST_F(ModesMutation, PlansWithOddModesAreAcceptedWhole) {
  fairway::CertifyOptions options = quick_options();
  options.last_level = 6;
  options.samples = 3000;
  std::size_t handed_over = 0;
  std::size_t flown_on = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    fairway::Plan plan = seed % 2 == 0 ? fairway::random_plan(seed) : fairway::odd_plan(seed);
    add_odd_modes(plan, seed);
    write_sample(plan, folder_ / "odd", options);
    const std::string file = read(folder_ / "odd");
    ASSERT_EQ(refusal(file, 2000), "") << "plan " << seed;
    TakenApart parts(file);
    for (std::size_t i = 0; i < mode_leaves(parts); ++i) {
      handed_over += is_handed_over({parts, i}) ? 1 : 0;
      flown_on += is_flown_on({parts, i}) ? 1 : 0;
    }
  }
  EXPECT_GT(handed_over, 250U);
  EXPECT_GT(flown_on, 100U);
}

TEST_F(ModesMutation, ALeafIsHandedOverOnlyToAnEarlierModeThatIsProvedToReach) {
  const TakenApart good(good_);
  TakenApart parts = good;
  int refused = 0;
  int tried = 0;
  for (const std::size_t leaf : some_leaves(parts, 20, is_handed_over)) {
    for (std::uint8_t other = 0; other < mode_of_leaf(parts, leaf); ++other) {
      parts = good;
      if (other == ModeLeaf{parts, leaf}.next()) continue;
      ModeLeaf{parts, leaf}.put_next(other);
      ModeLeaf{parts, leaf}.put_time(1e6F);
      // Accepted where the other mode reaches, too: nobody is misled. The prover takes the first
      // that does, so no earlier one may.
      const std::string why = refusal(parts);
      const bool is_earlier = other < ModeLeaf{parts, leaf}.next();
      ++tried;
      refused += why.empty() ? 0 : 1;
      EXPECT_TRUE(why.empty() ? !is_earlier
                              : why.find("could not be re-proved") != std::string::npos)
          << leaf << ": " << why;
    }
  }
  EXPECT_GT(refused, 10) << "of " << tried;
}

TEST_F(ModesMutation, NoLeafIsHandedOverToItsOwnModeALaterOneOrNone) {
  const TakenApart good(good_);
  TakenApart parts = good;
  for (const std::size_t leaf : some_leaves(parts, 6, is_handed_over)) {
    const std::size_t mode = mode_of_leaf(parts, leaf);
    for (const std::size_t other : {mode, mode + 1, std::size_t{5}, std::size_t{254}}) {
      parts = good;
      ModeLeaf{parts, leaf}.put_next(static_cast<std::uint8_t>(other));
      EXPECT_THAT(refusal(parts), testing::HasSubstr("hands over to no earlier mode"));
    }
    parts = good;  // a rank is one within a mode
    ModeLeaf{parts, leaf}.put_rank(1);
    EXPECT_THAT(refusal(parts), testing::HasSubstr("has an invalid verdict, rank or time"));
  }
}

TEST_F(ModesMutation, WhatIsFlownOnAndWhatIsHandedOverAreTwoThings) {
  const TakenApart good(good_);
  TakenApart parts = good;
  int refused = 0;
  int tried = 0;
  for (const std::size_t leaf : some_leaves(parts, 30, is_flown_on)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_next(0);
    ModeLeaf{parts, leaf}.put_rank(0);
    ModeLeaf{parts, leaf}.put_time(1e6F);
    ++tried;
    refused += refusal(parts).empty() ? 0 : 1;
  }
  // The prover asks first whether it can hand over; the check looks a little farther.
  EXPECT_GT(refused, tried * 3 / 4);
  refused = 0;
  for (const std::size_t leaf : some_leaves(parts = good, 30, is_handed_over)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_next(stays);
    refused += refusal(parts).empty() ? 0 : 1;  // its rank is 0
  }
  EXPECT_GT(refused, 15);
}

TEST_F(ModesMutation, UndecidedLeavesCannotBeClaimed) {
  const TakenApart good(good_);
  TakenApart parts = good;
  for (const std::size_t leaf : some_leaves(parts, 10, is_open)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_verdict(reach);
    ModeLeaf{parts, leaf}.put_rank(1000000);
    ModeLeaf{parts, leaf}.put_time(1e6F);
    EXPECT_THAT(refusal(parts), testing::HasSubstr("could not be re-proved")) << leaf;
    ModeLeaf{parts, leaf}.put_rank(0);
    for (std::uint8_t mode = 0; mode < mode_of_leaf(parts, leaf); ++mode) {
      ModeLeaf{parts, leaf}.put_next(mode);
      EXPECT_THAT(refusal(parts), testing::HasSubstr("could not be re-proved")) << leaf;
    }
  }
  // They say nothing else either.
  const std::size_t leaf = some_leaves(parts = good, 1, is_open)[0];
  const std::vector<std::function<void(const ModeLeaf&)>> changes{
      [](const ModeLeaf& l) { l.put_next(0); },
      [](const ModeLeaf& l) { l.put_rank(1); },
      [](const ModeLeaf& l) { l.put_time(1.0F); },
      [](const ModeLeaf& l) { l.put_verdict(collide); },
      [](const ModeLeaf& l) { l.put_verdict(leave); },
      [](const ModeLeaf& l) {
        l.put_verdict(trapped);
        l.put_time(std::numeric_limits<float>::infinity());
      }};
  for (const auto& change : changes) {
    parts = good;
    change({parts, leaf});
    EXPECT_THAT(refusal(parts), testing::HasSubstr("has an invalid verdict, rank or time"));
  }
}

TEST_F(ModesMutation, ALeafThatReachesIsNotSaidToDoAnythingElse) {
  const TakenApart good(good_);
  TakenApart parts = good;
  for (const std::size_t leaf : some_leaves(parts, 5, is_reaching)) {
    for (const Verdict verdict : {collide, leave}) {
      parts = good;
      ModeLeaf{parts, leaf}.put_verdict(verdict);
      EXPECT_THAT(refusal(parts), testing::HasSubstr("has an invalid verdict, rank or time"));
    }
  }
}

TEST_F(ModesMutation, ALeafOnWhichOthersDependCannotBecomeUndecided) {
  const TakenApart good(good_);
  TakenApart parts = good;
  int refused = 0;
  for (const std::size_t leaf : some_leaves(parts, 40, is_reaching)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_verdict(undecided);
    ModeLeaf{parts, leaf}.put_rank(0);
    ModeLeaf{parts, leaf}.put_time(0.0F);
    ModeLeaf{parts, leaf}.put_next(stays);
    const std::string why = refusal(parts);
    EXPECT_TRUE(why.empty() || why.find("undecided") != std::string::npos) << why;
    refused += why.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 4);
  // Nor may a leaf of the plan's own mode on which further modes rest alone.
  parts = good;
  for (std::size_t leaf = 0; leaf < good.leaves(); ++leaf) {
    parts.put<std::uint8_t>("leaf_verdict", leaf, undecided);
    parts.put<std::uint32_t>("leaf_rank", leaf, 0);
    parts.put("leaf_time_s", leaf, 0.0F);
  }
  EXPECT_THAT(refusal(parts), testing::HasSubstr("of mode 1, claimed to reach"));
}

TEST_F(ModesMutation, TimesBoundAndRanksFallWithinAMode) {
  const TakenApart good(good_);
  TakenApart parts = good;
  for (const std::size_t leaf : some_leaves(parts, 20, is_reaching)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_time(0.9F * ModeLeaf{parts, leaf}.time_s());
    EXPECT_THAT(refusal(parts), testing::HasSubstr("takes up to")) << leaf;
    for (const float bad : {-1.0F, NAN, INFINITY}) {
      parts = good;
      ModeLeaf{parts, leaf}.put_time(bad);
      EXPECT_THAT(refusal(parts), testing::HasSubstr("has an invalid verdict, rank or time"));
    }
  }
  // A leaf of rank 2 comes to one of rank 1; and no two can be of the same.
  const auto comes_to_another = [](const ModeLeaf& leaf) {
    return is_flown_on(leaf) && leaf.rank() > 1;
  };
  for (const std::size_t leaf : some_leaves(parts = good, 15, comes_to_another)) {
    parts = good;
    ModeLeaf{parts, leaf}.put_rank(0);
    EXPECT_THAT(refusal(parts), testing::HasSubstr("its rank is 0, but its states come to a leaf"));
  }
  parts = good;
  for (const std::size_t leaf : some_leaves(parts, ~std::size_t{0}, is_flown_on)) {
    ModeLeaf{parts, leaf}.put_rank(7);
  }
  EXPECT_THAT(refusal(parts), testing::HasSubstr("its rank is 7"));
}

TEST_F(ModesMutation, CommandsOfEveryModeArePartOfTheProof) {
  const TakenApart good(good_);
  TakenApart parts = good;
  int refused = 0;
  int changed = 0;
  const std::size_t cells = good.arrays.at("region").size();
  for (std::size_t at = 0; at < 4 * cells; at += 41) {
    parts = good;
    const float rad = good.at<float>("mode_heading_rad", at);
    if (good.at<std::uint8_t>("cell_kind", at % cells) != ordinary) continue;
    parts.put("mode_heading_rad", at, rad > 0.0F ? rad - 3.0F : rad + 3.0F);
    ++changed;
    refused += refusal(parts).empty() ? 0 : 1;
  }
  EXPECT_EQ(refused, changed);  // sections of other sides than those with leaves, at least
  // A little changes no section's sides: leaves themselves fail, or reach still.
  refused = 0;
  for (std::size_t at = 0; at < 4 * cells; at += 23) {
    if (good.at<std::uint8_t>("cell_kind", at % cells) != ordinary) continue;
    parts = good;
    parts.put("mode_heading_rad", at, good.at<float>("mode_heading_rad", at) + 0.02F);
    const std::string why = refusal(parts);
    refused += why.find("could not be re-proved") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(refused, 10);
  for (const float bad : {3.2F, -3.1415928F, INFINITY}) {
    parts = good;
    parts.put("mode_heading_rad", cells + 5 * street_nx + 6, bad);
    EXPECT_THAT(refusal(parts), testing::HasSubstr("mode_heading_rad: has an invalid command"));
  }
}

TEST_F(ModesMutation, LeavesCoverTheSectionsOfTheirMode) {
  const TakenApart good(good_);
  TakenApart parts = good;
  // An open leaf gives way to its neighbour that reaches: half of it, and nearly all.
  int refused = 0;
  for (const std::size_t leaf : some_leaves(parts, ~std::size_t{0}, is_open)) {
    const std::size_t s = section_of_mode_leaf(good, leaf);
    if (leaf == good.at<std::uint32_t>("mode_section_first", s)) continue;
    const bool last = leaf + 1 == good.at<std::uint32_t>("mode_section_first", s + 1);
    const double begin = good.at<std::uint32_t>("mode_leaf_begin", leaf);
    const double end = last ? 0x1p32 : good.at<std::uint32_t>("mode_leaf_begin", leaf + 1);
    for (const double share : {0.5, 0.98}) {
      parts = good;
      parts.put("mode_leaf_begin", leaf, static_cast<std::uint32_t>(begin + share * (end - begin)));
      const std::string why = refusal(parts);
      refused += why.find("could not be re-proved") != std::string::npos ? 1 : 0;
      EXPECT_TRUE(why.empty() || why.find("could not be re-proved") != std::string::npos) << why;
    }
    if (refused > 20) break;
  }
  EXPECT_GT(refused, 20);
  parts = good;
  const std::size_t leaf = some_leaves(parts, 1, is_reaching)[0];
  const std::size_t s = section_of_mode_leaf(good, leaf);
  const std::uint32_t first = good.at<std::uint32_t>("mode_section_first", s);
  parts.put<std::uint32_t>("mode_leaf_begin", first, 1);
  EXPECT_THAT(refusal(parts), testing::HasSubstr("do not ascend from the side's start"));
  // A section that is another side's, one without its last leaf, and lists that do not ascend.
  parts = good;
  const std::uint32_t next = good.at<std::uint32_t>("mode_section_first", s + 1);
  parts.put("mode_section_first", s, next);
  EXPECT_THAT(refusal(parts), testing::HasSubstr("a section has leaves where it cannot"));
  parts = good;
  parts.put("mode_section_first", s, next + 1);
  EXPECT_THAT(refusal(parts), testing::HasSubstr("does not ascend from 0"));
  parts = good;
  parts.put<std::uint32_t>("mode_section_first", 0, 1);
  EXPECT_THAT(refusal(parts), testing::HasSubstr("does not ascend from 0"));
}

TEST_F(ModesMutation, ModesCannotChangePlaces) {
  // The fields of two modes and their leaves are exchanged whole: each is proved by itself, but
  // hands over to modes that are others now.
  fairway::Plan plan = street();
  const std::size_t cells = plan.grid.size();
  std::swap_ranges(plan.mode_heading_rad.begin(),
                   plan.mode_heading_rad.begin() + static_cast<std::ptrdiff_t>(cells),
                   plan.mode_heading_rad.begin() + static_cast<std::ptrdiff_t>(2 * cells));
  const TakenApart good(good_);
  TakenApart parts = good;
  std::memcpy(parts.arrays["mode_heading_rad"].data(), plan.mode_heading_rad.data(),
              4 * plan.mode_heading_rad.size());
  EXPECT_NE(refusal(parts), "");
}

TEST_F(ModesMutation, ThePlanHasTheSameModes) {
  fairway::Plan plan = street();
  const auto judged = [&](const fairway::Plan& other) {
    fairway::write_plan(other, folder_ / "plan", fairway::Existing::replace);
    return refusal_of(folder_ / "good", folder_ / "plan", 0);
  };
  EXPECT_EQ(judged(plan), "");
  const std::vector<std::function<void(fairway::Plan&)>> changes{
      [](fairway::Plan& p) { p.mode_heading_rad[5 * street_nx + 6] = 0.25F; },
      [](fairway::Plan& p) {
        p.mode_heading_rad.resize(3 * p.grid.size());
        p.record.modes.pop_back();
      },
      [](fairway::Plan& p) {
        p.mode_heading_rad.clear();
        p.record.modes.clear();
      }};
  for (const auto& change : changes) {
    fairway::Plan other = plan;
    change(other);
    EXPECT_THAT(judged(other), testing::HasSubstr("is not the certificate of the plan"));
  }
  // The certificate of one mode is not that of a plan with several.
  plan.mode_heading_rad.clear();
  plan.record.modes.clear();
  write_sample(plan, folder_ / "single");
  fairway::write_plan(street(), folder_ / "plan", fairway::Existing::replace);
  EXPECT_EQ(refusal_of(folder_ / "single", "", 0), "");
  EXPECT_THAT(refusal_of(folder_ / "single", folder_ / "plan", 0),
              testing::HasSubstr("is not the certificate of the plan"));
  TakenApart single(read(folder_ / "single"));
  single.record["plan_sha256"]["mode_heading_rad"] = std::string(64, '0');
  EXPECT_THAT(refusal(single), testing::HasSubstr("mode_heading_rad is not that of the plan"));
  TakenApart parts(good_);
  parts.record["plan_sha256"]["mode_heading_rad"] = std::string(64, '0');
  EXPECT_THAT(refusal(parts.file()),
              testing::HasSubstr("mode_heading_rad is not that of the plan"));
  parts.record["plan_sha256"].erase("mode_heading_rad");
  EXPECT_THAT(refusal(parts.file()),
              testing::HasSubstr("mode_heading_rad is not that of the plan"));
}

TEST_F(ModesMutation, SharesByModeAreThoseOfSampledStates) {
  const TakenApart good(good_);
  TakenApart parts = good;
  nlohmann::json& shares = parts.record["reach_by_mode"];
  ASSERT_EQ(shares.size(), 5U);
  shares[1] = shares[1].get<double>() + 0.01;
  EXPECT_THAT(refusal(parts, 2000), testing::HasSubstr("does not sum to the share that reaches"));
  parts = good;
  std::swap(parts.record["reach_by_mode"][0], parts.record["reach_by_mode"][4]);
  EXPECT_THAT(refusal(parts, 2000), testing::HasSubstr("reach_by_mode: mode 0 is claimed as"));
  parts = good;
  parts.record["reach_by_mode"].push_back(0.0);
  EXPECT_THAT(refusal(parts, 2000), testing::HasSubstr("expected a share for every mode"));
  parts = good;
  parts.record["reach_by_mode"][0] = good.record["reach_by_mode"][0].get<double>() + 1.0;
  parts.record["reach_by_mode"][1] = good.record["reach_by_mode"][1].get<double>() - 1.0;
  EXPECT_THAT(refusal(parts, 2000), testing::HasSubstr("negative share"));
  parts = good;
  parts.record.erase("reach_by_mode");  // no verdict rests on it
  EXPECT_EQ(refusal(parts, 2000), "");
}

TEST_F(ModesMutation, DamagedFilesAreUnreadable) {
  const TakenApart good(good_);
  for (const auto& [name, bytes] : good.arrays) {
    if (!name.starts_with("mode_")) continue;
    TakenApart parts = good;
    parts.header.erase(name);
    EXPECT_THAT(refusal(parts.file()), testing::StartsWith("unreadable: ")) << name;
    parts = good;
    parts.header[name]["dtype"] = "U64";
    EXPECT_THAT(refusal(parts.file()), testing::StartsWith("unreadable: ")) << name;
    parts = good;
    parts.arrays[name][0] = static_cast<char>(parts.arrays[name][0] ^ 1);
    EXPECT_THAT(refusal(parts.file()), testing::HasSubstr(name + ": digest mismatch"));
  }
  TakenApart parts = good;
  for (const nlohmann::json& shape : {nlohmann::json{4 * street_ny, street_nx},
                                      {2, 2 * street_ny, street_nx},
                                      {4, street_nx, street_ny}}) {
    parts.header["mode_heading_rad"]["shape"] = shape;
    EXPECT_THAT(refusal(parts.file()), testing::StartsWith("unreadable: "));
  }
}

}  // namespace
}  // namespace fairway_check
