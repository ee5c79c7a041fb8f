#include "fairway/plan/plan_file.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr float infinity = std::numeric_limits<float>::infinity();
const float nan_f = std::numeric_limits<float>::quiet_NaN();

Plan random_plan(int nx, int ny, std::uint64_t seed) {
  Random random(seed);
  Plan plan;
  plan.grid = {nx, ny, random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 1.5};
  plan.vehicle = {12.25, 5.0};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const auto region = static_cast<Region>(static_cast<int>(random.below(4)) - 1);
    const bool reachable = random.unit() < 0.8;
    plan.region.push_back(region);
    plan.cost_m.push_back(reachable ? static_cast<float>(random.uniform(0.0, 500.0)) : infinity);
    plan.heading_rad.push_back(reachable ? Heading::stored(random.uniform(-4.0, 4.0)) : nan_f);
  }
  plan.record.mission = GoalMission{plan.grid.center({0, 0}), {}};
  plan.record.options_json = R"({"plan":{"alpha":2.0}})";
  return plan;
}

std::string bytes_of(const Plan& plan) {
  const fs::path path = fs::path(testing::TempDir()) / "plan_file_test.safetensors";
  write_plan(plan, path, Existing::replace);
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  fs::remove(path);
  return bytes;
}

Plan read_bytes(const std::string& bytes) {
  return plan_of_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), "p");
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(PlanFile, GivesBackWhatWasWrittenAndTheSameBytesAgain) {
  rc::check([] {
    const Plan plan = random_plan(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40),
                                  *rc::gen::arbitrary<std::uint64_t>());
    const std::string bytes = bytes_of(plan);
    const Plan back = read_bytes(bytes);
    RC_ASSERT(back.grid == plan.grid);
    RC_ASSERT(back.vehicle == plan.vehicle);
    RC_ASSERT(same_bits(back.heading_rad, plan.heading_rad));
    RC_ASSERT(same_bits(back.region, plan.region));
    RC_ASSERT(same_bits(back.cost_m, plan.cost_m));
    RC_ASSERT(json_text(back.record) == json_text(plan.record));
    RC_ASSERT(bytes_of(back) == bytes);
  });
}

TEST(PlanFile, HoldsAContractThatSuitsItsVehicle) {
  Plan plan = random_plan(7, 5, 11);
  plan.record.contract = VehicleContract::of(plan.vehicle);
  plan.record.contract->turn_radius_m = {4.5, 5.5};
  plan.record.contract->heading_error_rad = 0.1;
  const std::string bytes = bytes_of(plan);
  const Plan back = read_bytes(bytes);
  EXPECT_EQ(back.record.contract, plan.record.contract);
  EXPECT_EQ(bytes_of(back), bytes);

  std::string other = bytes;
  const std::string range = "[4.5,5.5]";
  other.replace(other.find(range), range.size(), "[5.1,5.5]");
  try {
    (void)read_bytes(other);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "p: fairway.contract.turn_radius_m: is [5.1, 5.5] m and does not contain the plan's "
              "5 m, expected a range that contains it, such as [5, 5.5]");
  }
  plan.record.contract->turn_radius_m = {5.1, 5.5};
  EXPECT_THROW(bytes_of(plan), PreconditionViolation);
}

TEST(PlanFile, EdgesOfTheValueRangesPass) {
  Plan plan = random_plan(3, 2, 1);
  plan.heading_rad = {
      Heading::stored(pi), Heading::stored(-pi + 1e-12), 0.0F, -0.0F, nan_f, 0x1p-52F};
  plan.cost_m = {0.0F, 1e-40F, 3e38F, infinity, infinity, 1.0F};
  plan.region = {Region::goal,     Region::free, Region::buffer,
                 Region::obstacle, Region::free, Region::free};
  EXPECT_TRUE(same_bits(read_bytes(bytes_of(plan)).heading_rad, plan.heading_rad));
}

// A file taken apart: the header's JSON, the metadata's JSON, the arrays; reassembled without any
// of the writer's checks, so that every kind of damage can be made.
struct Parts {
  json header;
  json record;
  std::string arrays;

  explicit Parts(const std::string& bytes) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);
    header = json::parse(bytes.substr(8, length));
    record = json::parse(header["__metadata__"]["fairway"].get<std::string>());
    arrays = bytes.substr(8 + length);
  }
  std::string bytes(bool digests_follow = true) {
    for (const char* name : {"heading_rad", "cost_m", "region"}) {
      if (!digests_follow || !header.contains(name)) continue;
      try {
        const auto begin = header[name]["data_offsets"][0].get<std::size_t>();
        const auto end = header[name]["data_offsets"][1].get<std::size_t>();
        const std::string data = arrays.substr(begin, end - begin);
        record["sha256"][name] = sha256_hex(std::as_bytes(std::span(data.data(), data.size())));
      } catch (const std::exception&) {  // offsets damaged on purpose
      }
    }
    if (header.contains("__metadata__") && header["__metadata__"].contains("fairway")) {
      header["__metadata__"]["fairway"] = record.dump();
    }
    const std::string text = header.dump();
    std::string all(8, '\0');
    const std::uint64_t length = text.size();
    std::memcpy(all.data(), &length, 8);
    return all + text + arrays;
  }
  void poke(const char* name, std::size_t index, const void* value, std::size_t width) {
    std::memcpy(arrays.data() + header[name]["data_offsets"][0].get<std::size_t>() + index * width,
                value, width);
  }
};

std::string refusal(const std::string& bytes) {
  try {
    (void)read_bytes(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlanFile, AnotherWritersOrderAndSpacingAreAccepted) {
  const Plan plan = random_plan(5, 4, 2);
  Parts parts(bytes_of(plan));
  EXPECT_TRUE(same_bits(read_bytes(parts.bytes()).cost_m, plan.cost_m));
  // region first: 20 bytes, then the two F32 arrays.
  parts.arrays = parts.arrays.substr(160) + parts.arrays.substr(0, 160);
  parts.header["region"]["data_offsets"] = {0, 20};
  parts.header["heading_rad"]["data_offsets"] = {20, 100};
  parts.header["cost_m"]["data_offsets"] = {100, 180};
  const Plan back = read_bytes(parts.bytes());
  EXPECT_TRUE(same_bits(back.heading_rad, plan.heading_rad));
  EXPECT_TRUE(same_bits(back.region, plan.region));
}

TEST(PlanFile, EveryFieldThatIsWrongIsRefusedByName) {
  const std::string good = bytes_of(random_plan(5, 4, 2));
  struct Case {
    const char* expect;
    std::function<void(Parts&)> damage;
  };
  const auto header = [](const char* name, const char* key, json value) {
    return [=](Parts& p) { p.header[name][key] = value; };
  };
  const auto record = [](const char* key, json value) {
    return [=](Parts& p) { p.record[key] = value; };
  };
  const auto poke = [](const char* name, auto value) {
    return [=](Parts& p) { p.poke(name, 7, &value, sizeof(value)); };
  };
  const float just_above_pi = std::nextafter(static_cast<float>(pi), 4.0F);
  const std::vector<Case> cases{
      {"\"heading_rad\".data_offsets", header("heading_rad", "dtype", "F64")},
      {"\"heading_rad\".dtype", header("heading_rad", "dtype", "I32")},
      {"\"cost_m\".dtype", header("cost_m", "dtype", "I32")},
      {"\"region\".dtype", header("region", "dtype", "U8")},
      {"\"region\".dtype", header("region", "dtype", 3)},
      {"\"cost_m\".data_offsets", header("cost_m", "shape", {4, 6})},
      {"\"cost_m\".shape", header("cost_m", "shape", {5, 4})},
      {"\"cost_m\".shape", header("cost_m", "shape", {20})},
      {"\"cost_m\".shape", header("cost_m", "shape", "4x5")},
      {"\"cost_m\".shape", header("cost_m", "shape", {-4, -5})},
      {"\"cost_m\".shape", header("cost_m", "shape", {4.0, 5.0})},
      {"larger than any file", header("cost_m", "shape", {1ULL << 62, 1ULL << 62})},
      {"\"cost_m\".data_offsets", header("cost_m", "data_offsets", {80, 161})},
      {"\"cost_m\".data_offsets", header("cost_m", "data_offsets", {160, 80})},
      {"\"cost_m\".data_offsets", header("cost_m", "data_offsets", {80})},
      {"\"cost_m\".data_offsets", header("cost_m", "data_offsets", {80, 1e30})},
      {"must be contiguous", header("cost_m", "data_offsets", {84, 164})},
      {"must be contiguous", header("cost_m", "data_offsets", {0, 80})},
      {"unknown key", header("cost_m", "stride", 4)},
      {"lacks the array \"region\"",
       [](Parts& p) { p.header.erase("region"), p.arrays.resize(160); }},
      {"arrays other than",
       [](Parts& p) {
         p.header["x"] = {{"dtype", "I8"}, {"shape", {0}}, {"data_offsets", {0, 0}}};
       }},
      {"after its last array", [](Parts& p) { p.arrays += "x"; }},
      {"__metadata__", [](Parts& p) { p.header.erase("__metadata__"); }},
      {"__metadata__", [](Parts& p) { p.header["__metadata__"] = 1; }},
      {"__metadata__", [](Parts& p) { p.header["__metadata__"]["other"] = 1; }},
      {"fairway.format_version", record("format_version", 2)},
      {"fairway.format_version", record("format_version", "1")},
      {"fairway.origin_m", record("origin_m", {1.0})},
      {"fairway.origin_m", record("origin_m", {1.0, nullptr})},
      {"origin_m", record("origin_m", {1e300, 0.0})},
      {"fairway.cell_m", record("cell_m", nullptr)},
      {"cell_m", record("cell_m", 0.0)},
      {"cell_m", record("cell_m", -1.5)},
      {"cell_m", record("cell_m", 1e-16)},
      {"cell_m", record("cell_m", 1e300)},
      {"origin_m", record("origin_m", {3e9, 0.0})},
      {"turn_radius_m", record("vehicle", {{"speed_mps", 1.0}, {"turn_radius_m", 1e12}})},
      {"speed_mps", record("vehicle", {{"speed_mps", 1e-16}, {"turn_radius_m", 5.0}})},
      {"speed_mps", record("vehicle", {{"speed_mps", 1e300}, {"turn_radius_m", 5.0}})},
      {"turn_radius_m", record("cell_m", 5.0)},
      {"fairway.vehicle", record("vehicle", {{"speed_mps", 1.0}})},
      {"fairway.vehicle", record("vehicle", 1)},
      {"speed_mps", record("vehicle", {{"speed_mps", 0.0}, {"turn_radius_m", 5.0}})},
      {"turn_radius_m", record("vehicle", {{"speed_mps", 1.0}, {"turn_radius_m", -5.0}})},
      {"unknown key", record("vehicle", {{"speed_mps", 1.0}, {"turn_radius_m", 5.0}, {"m", 1}})},
      {"heading_rad is", poke("heading_rad", just_above_pi)},
      {"heading_rad is", poke("heading_rad", static_cast<float>(-pi))},
      {"heading_rad is", poke("heading_rad", infinity)},
      {"heading_rad is", poke("heading_rad", 1e-45F)},
      {"heading_rad is", poke("heading_rad", -1e-16F)},
      {"cost_m is", poke("cost_m", -1e-30F)},
      {"cost_m is", poke("cost_m", nan_f)},
      {"region is", poke("region", std::int8_t{3})},
      {"region is", poke("region", std::int8_t{-2})},
      {"cell ix 2 iy 1",
       [](Parts& p) {
         const std::int8_t free = 0;
         const float cost = 1.0F;
         p.poke("region", 7, &free, 1), p.poke("cost_m", 7, &cost, 4),
             p.poke("heading_rad", 7, &nan_f, 4);
       }},
  };
  for (const Case& c : cases) {
    Parts parts(good);
    c.damage(parts);
    const std::string message = refusal(parts.bytes());
    EXPECT_NE(message.find(c.expect), std::string::npos)
        << "expected the refusal to name " << c.expect << ", it says: " << message;
    EXPECT_TRUE(message.starts_with("p: ")) << message;
  }
}

TEST(PlanFile, DigestMismatchesAreRefused) {
  const std::string good = bytes_of(random_plan(5, 4, 2));
  for (const char* name : {"heading_rad", "cost_m", "region"}) {
    Parts parts(good);
    parts.record["sha256"][name] = std::string(64, '0');
    EXPECT_NE(refusal(parts.bytes(false)).find(std::string("sha256.") + name), std::string::npos);
    Parts lacking(good);
    lacking.record["sha256"].erase(name);
    EXPECT_NE(refusal(lacking.bytes(false)).find(name), std::string::npos);
  }
}

TEST(PlanFile, EveryBitOfTheArraysIsGuarded) {
  const std::string good = bytes_of(random_plan(3, 2, 3));
  const std::size_t arrays = good.size() - 3 * 2 * 9;
  for (std::size_t i = arrays; i < good.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ (1 << bit));
      EXPECT_NE(refusal(bad), "") << "byte " << i << " bit " << bit;
    }
  }
}

TEST(PlanFile, CutShortAnywhereItIsRefused) {
  const std::string good = bytes_of(random_plan(7, 5, 4));
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(refusal(good.substr(0, size)), "") << size << " of " << good.size() << " bytes";
  }
}

TEST(PlanFile, AChangedHeaderByteIsRefusedOrMeansTheSamePlan) {
  const Plan plan = random_plan(3, 2, 5);
  const std::string good = bytes_of(plan);
  Random random(7);
  for (int trial = 0; trial < 4000; ++trial) {
    std::string bad = good;
    const std::size_t header_end = good.size() - 54;
    bad[random.below(header_end)] = static_cast<char>(random.below(256));
    try {
      const Plan back = read_bytes(bad);  // numbers and the record may differ; the arrays may not
      EXPECT_TRUE(same_bits(back.heading_rad, plan.heading_rad));
      EXPECT_TRUE(same_bits(back.cost_m, plan.cost_m));
      EXPECT_EQ(plan_defect(back), "");
    } catch (const InputError&) {
    }
  }
}

TEST(PlanFile, HostileJsonIsRefused) {
  const auto with_header = [](const std::string& text) {
    std::string all(8, '\0');
    const std::uint64_t length = text.size();
    std::memcpy(all.data(), &length, 8);
    return refusal(all + text);
  };
  EXPECT_NE(with_header(std::string(1000000, '[')), "");
  EXPECT_NE(with_header("{\"a\":" + std::string(1000000, '[')).find("32 levels"),
            std::string::npos);
  EXPECT_NE(with_header("{\"a\":1,\"a\":1}").find("twice"), std::string::npos);
  EXPECT_NE(with_header("{\"a\":1e999}"), "");
  EXPECT_NE(with_header("{\"\xff\":1}"), "");
  EXPECT_NE(with_header(""), "");
  EXPECT_NE(with_header("{}").find("is not a plan"), std::string::npos);
}

TEST(PlanFile, APlanWithADefectIsNeverWritten) {
  const fs::path path = fs::path(testing::TempDir()) / "defective.safetensors";
  Plan plan = random_plan(4, 4, 6);
  plan.heading_rad[3] = 4.0F;
  EXPECT_THROW(write_plan(plan, path, Existing::replace), PreconditionViolation);
  plan = random_plan(4, 4, 6);
  plan.cost_m.pop_back();
  EXPECT_THROW(write_plan(plan, path, Existing::replace), PreconditionViolation);
  plan = random_plan(4, 4, 6);
  plan.record.options_json = "[]";
  EXPECT_THROW(write_plan(plan, path, Existing::replace), PreconditionViolation);
  plan.record.options_json.clear();
  plan.record.more_json = R"({"cell_m":3})";
  EXPECT_THROW(write_plan(plan, path, Existing::replace), PreconditionViolation);
  EXPECT_FALSE(fs::exists(path));
}

TEST(PlanFile, TheFirstDefectiveCellIsNamedWhateverTheThreadsDo) {
  Plan plan = random_plan(700, 700, 8);
  for (const int i : {489999, 300000, 123456, 70001}) plan.cost_m[static_cast<std::size_t>(i)] = -1;
  EXPECT_NE(plan_defect(plan).find("cell ix 1 iy 100:"), std::string::npos) << plan_defect(plan);
}

Plan plan_with_modes(std::uint64_t seed) {
  Plan plan = random_plan(7, 5, seed);
  Random random(seed + 1);
  for (std::size_t i = 0; i < 3 * plan.grid.size(); ++i) {
    plan.mode_heading_rad.push_back(
        random.below(5) == 0 ? nan_f : Heading::stored(random.uniform(-4.0, 4.0)));
  }
  plan.record.modes = {{"direction", 0.5}, {"turning_places"}, {"direction", -2.0}};
  return plan;
}

TEST(PlanFile, ModesAreReadAsTheyWereWritten) {
  const Plan plan = plan_with_modes(4);
  const std::string bytes = bytes_of(plan);
  const Plan again = read_bytes(bytes);
  EXPECT_EQ(again.record.modes, plan.record.modes);
  ASSERT_EQ(again.further_modes(), 3U);
  ASSERT_EQ(again.mode_heading_rad.size(), plan.mode_heading_rad.size());
  EXPECT_EQ(0, std::memcmp(again.mode_heading_rad.data(), plan.mode_heading_rad.data(),
                           sizeof(float) * plan.mode_heading_rad.size()));
  EXPECT_EQ(bytes_of(again), bytes);
}

TEST(PlanFile, OneModeLeavesNoTraceInTheFile) {
  EXPECT_EQ(bytes_of(random_plan(7, 5, 4)).find("mode"), std::string::npos);
}

TEST(PlanFile, SaysWhatIsWrongWithModes) {
  const auto defect = [](const std::function<void(Plan&)>& spoil) {
    Plan plan = plan_with_modes(4);
    spoil(plan);
    return plan_defect(plan);
  };
  EXPECT_EQ(defect([](Plan&) {}), "");
  EXPECT_EQ(defect([](Plan& p) { p.mode_heading_rad[7 * 5 + 8] = 3.5F; }),
            "mode 2, cell ix 1 iy 1: mode_heading_rad is 3.5, expected (-pi, pi], 0 or at least "
            "2^-52 from it, or NaN");
  EXPECT_EQ(defect([](Plan& p) { p.mode_heading_rad.pop_back(); }),
            "mode_heading_rad does not have one entry per mode and cell");
  EXPECT_EQ(defect([](Plan& p) { p.record.modes.pop_back(); }),
            "has 3 further modes, but its record tells of 2");
  EXPECT_EQ(defect([](Plan& p) {
              p.mode_heading_rad.assign(64 * p.grid.size(), 0.0F);
              p.record.modes.assign(64, {"direction", 0.0});
            }),
            "has 65 modes, expected at most 64");
}

TEST(PlanFile, AnAlteredCommandOfAModeIsFound) {
  std::string bytes = bytes_of(plan_with_modes(4));
  // The arrays are the end of the file: headings, costs, modes, regions.
  bytes[bytes.size() - 7 * 5 - 6] ^= 1;
  try {
    static_cast<void>(read_bytes(bytes));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mode_heading_rad"), std::string::npos);
  }
}

}  // namespace
}  // namespace fairway
