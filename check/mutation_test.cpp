#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>

#include "check/certificate.hpp"
#include "check/proof.hpp"
#include "check/tensors.hpp"
#include "check/testing/sample_certificate.hpp"
#include "check/testing/taken_apart.hpp"
#include "fairway/plan/plan_file.hpp"

namespace fairway_check {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Parts = TakenApart;

class CheckMutation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("fairway-check-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    // Reach, collide, leave and circling, side by side.
    fairway::Plan plan = fairway::empty_plan(12, 9, 8.0, 20.0);
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const fairway::Cell c = plan.grid.cell_at(i);
      const double x = c.ix - 8.0;
      const double y = c.iy - 4.0;
      plan.heading_rad[i] = static_cast<float>(std::atan2(-y, -x) + 0.1);
      if (x * x + y * y < 3.0) plan.region[i] = fairway::Region::goal;
      if (c.ix == 4 && c.iy > 1) plan.region[i] = fairway::Region::obstacle;
      if (c.ix < 2) plan.heading_rad[i] = static_cast<float>(c.iy < 4 ? -2.0 : 1.0);
      if (c.iy == 0 && c.ix > 4) plan.region[i] = fairway::Region::buffer;
    }
    write_sample(plan, folder_ / "good");
    good_ = read(folder_ / "good");
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Why `bytes` are refused; "" when they are accepted; "unreadable: ..." when there is nothing to
  /// judge.
  static std::string refusal(const std::string& bytes, std::size_t samples = 20000) {
    std::ofstream(folder_ / "changed", std::ios::binary) << bytes;
    nlohmann::ordered_json report;
    try {
      return judge(folder_ / "changed", "", samples, report);
    } catch (const Defect& defect) {
      return std::string("unreadable: ") + defect.what();
    } catch (const json::exception& error) {
      return std::string("unreadable: ") + error.what();
    }
  }
  static void expect_refused(Parts parts, const std::string& because) {
    parts.sign();
    EXPECT_THAT(refusal(parts.file()), testing::HasSubstr(because));
  }

  static fs::path folder_;
  static std::string good_;
};
fs::path CheckMutation::folder_;
std::string CheckMutation::good_;

TEST_F(CheckMutation, WhatTheProverMadeIsAccepted) {
  EXPECT_EQ(refusal(good_), "");
  Parts parts(good_);
  parts.sign();
  EXPECT_EQ(refusal(parts.file()), "");
  for (const Verdict v : {reach, collide, leave, undecided}) parts.leaf_with(v);
}

TEST_F(CheckMutation, RandomPlansAreAcceptedWhole) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    write_sample(fairway::random_plan(seed), folder_ / "random");
    EXPECT_EQ(refusal(read(folder_ / "random"), 3000), "") << "random plan " << seed;
  }
}

TEST_F(CheckMutation, OddPlansAreAcceptedHoweverTheirVolumesWereMeasured) {
  fairway::CertifyOptions options = quick_options();
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const fairway::Plan plan = fairway::odd_plan(seed);
    ASSERT_EQ(fairway::plan_defect(plan), "") << seed;
    options.samples = seed % 2 == 0 ? 1 : 5000;
    options.seed = seed;
    options.last_level = 4 + static_cast<int>(seed % 4);
    write_sample(plan, folder_ / "odd", options);
    EXPECT_EQ(refusal(read(folder_ / "odd"), 3000), "") << "odd plan " << seed;
  }
}

TEST_F(CheckMutation, FewSamplesBoundSharesAndTimesLoosely) {
  fairway::CertifyOptions options = quick_options();
  options.samples = 1000;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    options.seed = seed;
    write_sample(fairway::random_plan(7 + seed % 3), folder_ / "few", options);
    EXPECT_EQ(refusal(read(folder_ / "few")), "") << seed;
  }
  Parts changed(good_);
  for (const int samples : {1, 50, 999}) {
    changed.record["samples"] = samples;
    expect_refused(changed, "the shares rest on too few");
  }
}

TEST_F(CheckMutation, EveryOtherVerdictOfALeafIsRefused) {
  const Parts good(good_);
  for (const Verdict was : {reach, collide, leave}) {
    for (const Verdict now : {reach, collide, leave, trapped}) {
      if (now == was) continue;
      Parts changed = good;
      const std::size_t leaf = good.leaf_with(was);
      changed.put<std::uint8_t>("leaf_verdict", leaf, now);
      if (now == trapped) {
        changed.put<std::uint32_t>("leaf_rank", leaf, 0);
        changed.put("leaf_time_s", leaf, std::numeric_limits<float>::infinity());
      }
      expect_refused(changed, "could not be re-proved");
    }
  }
  Parts changed = good;
  changed.put<std::uint8_t>("leaf_verdict", 0, 5);
  expect_refused(changed, "has an invalid verdict, rank or time");
}

TEST_F(CheckMutation, UndecidedLeavesCannotBeClaimed) {
  const Parts good(good_);
  Parts changed = good;
  const std::size_t leaf = good.leaf_with(undecided);
  changed.put<std::uint8_t>("leaf_verdict", leaf, reach);
  changed.put<std::uint32_t>("leaf_rank", leaf, 1000000);
  changed.put("leaf_time_s", leaf, 1e6F);
  expect_refused(changed, "could not be re-proved");
}

TEST_F(CheckMutation, ALeafOnWhichOthersDependCannotBecomeUndecided) {
  const Parts good(good_);
  int refused = 0;
  for (std::size_t leaf = 0; leaf < good.leaves(); leaf += 11) {
    Parts changed = good;
    changed.put<std::uint8_t>("leaf_verdict", leaf, undecided);
    changed.put<std::uint32_t>("leaf_rank", leaf, 0);
    changed.put("leaf_time_s", leaf, 0.0F);
    changed.sign();
    const std::string why = refusal(changed.file(), 0);
    EXPECT_TRUE(why.empty() || why.find("undecided") != std::string::npos) << why;
    refused += why.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 3);
}

TEST_F(CheckMutation, RanksMustFallAndTimesMustBound) {
  const Parts good(good_);
  const std::size_t leaf = good.find([&](std::size_t i) {
    return good.at<std::uint8_t>("leaf_verdict", i) == reach &&
           good.at<std::uint32_t>("leaf_rank", i) > 3;
  });
  const float time_s = good.at<float>("leaf_time_s", leaf);
  Parts changed = good;
  changed.put<std::uint32_t>("leaf_rank", leaf, 0);
  expect_refused(changed, "its rank is 0");
  changed = good;
  for (std::size_t i = 0; i < good.leaves(); ++i)
    changed.put<std::uint32_t>("leaf_rank", i,
                               good.at<std::uint8_t>("leaf_verdict", i) == undecided ? 0 : 7);
  expect_refused(changed, "its rank is 7");
  changed = good;
  changed.put("leaf_time_s", leaf, 0.9F * time_s);
  expect_refused(changed, "takes up to");
  changed = good;
  changed.put("leaf_time_s", leaf, 10.0F * time_s);  // not false itself, but others build on it
  changed.sign();
  EXPECT_THAT(refusal(changed.file()), testing::AnyOf("", testing::HasSubstr("takes up to")));
  for (const float bad :
       {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    changed = good;
    changed.put("leaf_time_s", leaf, bad);
    expect_refused(changed, "has an invalid verdict, rank or time");
  }
}

TEST_F(CheckMutation, ShiftedLeavesAreRefused) {
  const Parts good(good_);
  // The last leaf of a verdict is stretched over everything between it and another verdict, and
  // over most of that.
  const auto verdict = [&](std::size_t i) { return good.at<std::uint8_t>("leaf_verdict", i); };
  std::size_t other = 0;
  const std::size_t leaf = good.find([&](std::size_t i) {
    other = i + 1;
    while (other < good.leaves() && verdict(other) == undecided) ++other;
    return verdict(i) != undecided && other < good.leaves() && verdict(other) != verdict(i) &&
           good.section_of(i) == good.section_of(other);
  });
  const bool last = good.at<std::uint32_t>("section_first", good.section_of(leaf) + 1) == other + 1;
  std::uint32_t begin = last ? 0xffffffffU : good.at<std::uint32_t>("leaf_begin", other + 1);
  Parts changed = good;
  for (std::size_t i = other; i > leaf; --i) changed.put("leaf_begin", i, --begin);
  expect_refused(changed, "could not be re-proved");
  changed = good;
  changed.put<std::uint32_t>("leaf_begin", leaf + 1, 0);
  expect_refused(changed, "leaves do not ascend");
}

TEST_F(CheckMutation, ChangedCommandsCellsAndGeometryAreRefused) {
  const Parts good(good_);
  const std::size_t cells = good.arrays.at("region").size();
  int refused = 0;
  for (std::size_t cell = 0; cell < cells; cell += 5) {
    if (good.at<std::uint8_t>("cell_kind", cell) != ordinary) continue;
    Parts changed = good;
    changed.put("heading_rad", cell, good.at<float>("heading_rad", cell) > 0.0F ? -1.3F : 1.7F);
    changed.sign();
    refused += refusal(changed.file(), 0).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 10);
  Parts changed = good;
  changed.put("heading_rad", 50, 3.2F);
  expect_refused(changed, "command, region or cell_kind");
  changed = good;
  changed.put<std::int8_t>("region", 50, 3);
  expect_refused(changed, "command, region or cell_kind");
  changed = good;
  changed.put<std::uint8_t>("cell_kind", 50, obstacle);
  expect_refused(changed, "command, region or cell_kind");
  changed = good;  // a new obstacle, where flights pass and leaves are
  changed.put<std::int8_t>("region", 4 * 12 + 10, 1);
  changed.put<std::uint8_t>("cell_kind", 4 * 12 + 10, obstacle);
  expect_refused(changed, "a section has leaves where it cannot");
  changed = good;
  changed.record["region_of_interest"] = "obstacle";
  expect_refused(changed, "command, region or cell_kind");
  const std::array<std::pair<std::size_t, double>, 7> bad{
      {{2, 20.0}, {2, -8.0}, {3, 7.0}, {4, 0.0}, {0, NAN}, {1, INFINITY}, {5, 0x1p31}}};
  for (const auto& [i, value] : bad) {
    changed = good;
    changed.put("geometry", i, value);
    expect_refused(changed, "geometry");
  }
  for (const auto& [i, value] : {std::pair<std::size_t, double>{2, 9.0}, {3, 19.0}, {4, 9.0}}) {
    changed = good;
    changed.put("geometry", i, value);
    expect_refused(changed, "could not be re-proved");
  }
}

TEST_F(CheckMutation, ClaimedSharesMustBeThoseOfSampledStates) {
  const Parts good(good_);
  Parts changed = good;
  changed.record["volume_fraction"]["reach"] =
      good.record["volume_fraction"]["reach"].get<double>() + 0.1;
  expect_refused(changed, "do not sum to 1");
  for (const char* portion :
       {"volume_fraction", "volume_fraction_free", "volume_fraction_buffer"}) {
    changed = good;
    json& shares = changed.record[portion];
    std::swap(shares["reach"], shares["undecided"]);
    expect_refused(changed, std::string(portion) + ": ");
  }
  changed = good;
  changed.record["worst_time_s"] = 0.001 * good.record["worst_time_s"].get<double>();
  expect_refused(changed, "worst_time_s");
}

TEST_F(CheckMutation, ThePlanIsComparedWholeWithItsFrameAndVehicle) {
  fairway::Plan plan = fairway::random_plan(7);
  plan.record.frame = fairway::Frame{{5.0, 6.0, 0.5}, fairway::GeoReference{47.0, 8.0, 0.1}, "WKT"};
  write_sample(plan, folder_ / "framed");
  const auto judged = [](const fairway::Plan& p) {
    fairway::write_plan(p, folder_ / "plan", fairway::Existing::replace);
    nlohmann::ordered_json report;
    return judge(folder_ / "framed", folder_ / "plan", 0, report);
  };
  EXPECT_EQ(judged(plan), "");
  const std::vector<std::function<void(fairway::Plan&)>> changes{
      [](fairway::Plan& p) { p.record.frame->world_from_grid.x_m = 5000.0; },
      [](fairway::Plan& p) { p.record.frame->world_from_grid.yaw_rad = 0.0; },
      [](fairway::Plan& p) { p.record.frame->geo->latitude_deg = 48.0; },
      [](fairway::Plan& p) { p.record.frame->geo.reset(); },
      [](fairway::Plan& p) { p.record.frame->projected_crs = "other"; },
      [](fairway::Plan& p) { p.record.frame.reset(); },
      [](fairway::Plan& p) { p.vehicle.speed_mps *= 2.0; },
      [](fairway::Plan& p) { p.vehicle.turn_radius_m *= 1.5; },
      [](fairway::Plan& p) { p.grid.x0_m += p.grid.cell_m; },
      [](fairway::Plan& p) { p.cost_m[0] = 7.0F; },
      [](fairway::Plan& p) { p.heading_rad[0] = 1.25F; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    fairway::Plan other = plan;
    changes[i](other);
    EXPECT_THAT(judged(other), testing::HasSubstr("is not the certificate of the plan")) << i;
  }
  // No frame, and the grid's own frame, are the same place.
  plan.record.frame.reset();
  write_sample(plan, folder_ / "framed");
  EXPECT_EQ(judged(plan), "");
  plan.record.frame.emplace();
  EXPECT_EQ(judged(plan), "");
}

TEST_F(CheckMutation, ASparseFileIsRefusedUnread) {
  std::ofstream(folder_ / "sparse", std::ios::binary) << good_;
  fs::resize_file(folder_ / "sparse", std::uintmax_t{30} << 30);
  nlohmann::ordered_json report;
  EXPECT_THROW(judge(folder_ / "sparse", "", 0, report), Defect);
}

TEST_F(CheckMutation, DeepAndRepeatedRecordsAreUnreadable) {
  const Parts good(good_);
  Parts changed = good;
  changed.record["options"] = json::parse(std::string(31, '[') + std::string(31, ']'));
  changed.sign();
  EXPECT_EQ(refusal(changed.file(), 0), "");
  const auto with_record = [&](const std::string& record) {
    json header = good.header;
    header["__metadata__"]["fairway"] = record;
    std::string all = header.dump();
    while (all.size() % 8 != 0) all += ' ';
    const std::uint64_t length = all.size();
    std::string file(8, '\0');
    std::memcpy(file.data(), &length, 8);
    std::uint64_t before = 0;
    std::memcpy(&before, good_.data(), 8);
    return refusal(file + all + good_.substr(8 + before), 0);
  };
  const std::string record = good.record.dump();
  EXPECT_EQ(with_record(record), "");
  const std::string deep = record.substr(0, record.size() - 1) +
                           ",\"x\":" + std::string(300000, '[') + std::string(300000, ']') + "}";
  EXPECT_THAT(with_record(deep), testing::HasSubstr("unreadable: nests"));
  EXPECT_THAT(with_record("{\"format\":\"x\"," + record.substr(1)),
              testing::HasSubstr("unreadable: has a key twice"));
  EXPECT_THAT(with_record(record + std::string(1, '\0')), testing::HasSubstr("zero byte"));
  changed = good;
  changed.record["region_of_interest"] = {0, 0, 1, 1, 2};
  changed.sign();
  EXPECT_THAT(refusal(changed.file()), testing::HasSubstr("four numbers"));
  changed = good;
  changed.record["format_version"] = 1.0;
  EXPECT_THAT(refusal(changed.file()), testing::StartsWith("unreadable: "));
}

TEST_F(CheckMutation, DamagedFilesAreNotJudgedOrRefused) {
  const Parts good(good_);
  for (std::size_t i = 0; i < good.arrays.at("leaf_begin").size(); i += 4001) {
    Parts changed = good;
    changed.arrays["leaf_begin"][i] = static_cast<char>(changed.arrays["leaf_begin"][i] ^ 1);
    EXPECT_THAT(refusal(changed.file()), testing::HasSubstr("leaf_begin: digest mismatch"));
  }
  for (const std::size_t size : {0UL, 5UL, 100UL, good_.size() / 2, good_.size() - 1}) {
    EXPECT_THAT(refusal(good_.substr(0, size)), testing::StartsWith("unreadable: ")) << size;
  }
  EXPECT_THAT(refusal(good_ + "x"), testing::HasSubstr("has bytes after its last array"));
  Parts changed = good;
  changed.record["plan_sha256"]["region"] = changed.record["plan_sha256"]["heading_rad"];
  EXPECT_THAT(refusal(changed.file()), testing::HasSubstr("not those of the plan"));
  for (const auto& [name, bytes] : good.arrays) {
    changed = good;
    changed.header.erase(name);
    EXPECT_THAT(refusal(changed.file()), testing::StartsWith("unreadable: ")) << name;
    changed = good;
    changed.header[name]["dtype"] = "U64";
    EXPECT_THAT(refusal(changed.file()), testing::StartsWith("unreadable: ")) << name;
    changed = good;
    changed.header[name]["data_offsets"][0] =
        changed.header[name]["data_offsets"][0].get<int>() + 1;
    EXPECT_THAT(refusal(changed.file()), testing::StartsWith("unreadable: ")) << name;
  }
  for (const auto& [key, value] : good.record.items()) {
    if (key == "program" || key == "frame") continue;  // what no verdict rests on
    changed = good;
    changed.record.erase(key);
    EXPECT_THAT(refusal(changed.file()), testing::StartsWith("unreadable: ")) << key;
  }
}

}  // namespace
}  // namespace fairway_check
