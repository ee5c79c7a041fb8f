#include "fairway/report/page.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/report/page_arrays.hpp"
#include "fairway/report/page_payload.hpp"
#include "fairway/report/page_template.hpp"
#include "fairway/report/testing/plans_to_draw.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

using nlohmann::json;
using testing::island_plan;
using testing::wild_plan;

constexpr const char* bare =
    "<!doctype html><title>@FAIRWAY_TITLE@</title><script id=r>@FAIRWAY_RECORD@</script>"
    "<script id=a>@FAIRWAY_ARRAYS@</script>";

/// What arrays.ts does, in C++: the payload's arrays back from its bytes.
class Decoded {
 public:
  explicit Decoded(std::string bytes) : bytes_(std::move(bytes)) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes_.data(), 8);
    begin_ = 8 + static_cast<std::size_t>(length);
    header = json::parse(bytes_.substr(8, static_cast<std::size_t>(length)));
  }

  template <typename Value>
  std::vector<Value> array(const std::string& name, std::size_t layer = 0) const {
    const json& entry = header.at(name);
    const std::string raw = inflated(entry.at("at").at(layer), entry.at("at").at(layer + 1));
    const std::size_t n = raw.size() / sizeof(Value);
    std::vector<Value> values(n);
    auto* to = reinterpret_cast<char*>(values.data());
    const bool planes = entry.at("filter") != "none";
    for (std::size_t i = 0; i < raw.size(); ++i) {
      to[i] = planes ? raw[i % sizeof(Value) * n + i / sizeof(Value)] : raw[i];
    }
    if (entry.at("filter") == "delta") {
      for (std::size_t i = 1; i < n; ++i) values[i] = static_cast<Value>(values[i] + values[i - 1]);
    }
    return values;
  }

  json header;

 private:
  std::string inflated(std::size_t from, std::size_t to) const {
    std::string raw(1, '\0');
    for (;;) {
      uLongf size = raw.size();
      const int status =
          uncompress(reinterpret_cast<Bytef*>(raw.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes_.data() + begin_ + from), to - from);
      if (status == Z_OK) {
        raw.resize(size);
        return raw;
      }
      if (status != Z_BUF_ERROR) throw std::runtime_error("not a zlib stream");
      raw.resize(2 * raw.size());
    }
  }

  std::string bytes_;
  std::size_t begin_ = 0;
};

std::string of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 255U);
  }
  return bytes;
}

/// The text between two marks of a page.
std::string between(const std::string& page, const std::string& from, const std::string& to) {
  const std::size_t begin = page.find(from) + from.size();
  return page.substr(begin, page.find(to, begin) - begin);
}
json record_of(const std::string& page) {
  return json::parse(between(page, "<script id=r>", "</script>"));
}
Decoded arrays_of(const std::string& page) {
  return Decoded(of_base64(between(page, "<script id=a>", "</script>")));
}

Flight flight_of(std::vector<FlightSegment> segments, Outcome outcome) {
  Flight flight;
  flight.start = segments.front().start;
  flight.result = {outcome, 7.0, 70.0};
  flight.segments = std::move(segments);
  return flight;
}

const Mission goal = GoalMission{{60.0, 40.0}, {}};

TEST(Base64, MatchesTheRfc) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

RC_GTEST_PROP(PagePayload, GivesEveryArrayBack, ()) {
  const auto u8 = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  const auto u16 = *rc::gen::arbitrary<std::vector<std::uint16_t>>();
  const auto u32 = *rc::gen::arbitrary<std::vector<std::uint32_t>>();
  const auto f32 = *rc::gen::container<std::vector<float>>(
      rc::gen::map(rc::gen::arbitrary<int>(), [](int i) { return static_cast<float>(i) * 0.37F; }));
  PagePayload payload;
  payload.add("u8", {u8.size()}, std::span<const std::uint8_t>(u8));
  payload.add("u16", {u16.size()}, std::span<const std::uint16_t>(u16), PageFilter::delta);
  payload.add("u16 planes", {1, u16.size()}, std::span<const std::uint16_t>(u16),
              PageFilter::planes);
  payload.add("u32", {u32.size()}, std::span<const std::uint32_t>(u32), PageFilter::delta);
  payload.add("f32", {f32.size()}, f32);
  const Decoded back(payload.bytes());
  RC_ASSERT(back.array<std::uint8_t>("u8") == u8);
  RC_ASSERT(back.array<std::uint16_t>("u16") == u16);
  RC_ASSERT(back.array<std::uint16_t>("u16 planes") == u16);
  RC_ASSERT(back.array<std::uint32_t>("u32") == u32);
  RC_ASSERT(back.array<float>("f32") == f32);
  RC_ASSERT(back.header["u16 planes"]["shape"] == json({1, u16.size()}));
}

TEST(PagePayload, LayersComeOneByOne) {
  std::vector<std::uint8_t> codes(7 * 100);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::uint8_t>(i / 90);
  PagePayload payload;
  payload.add_layers("layers", {7, 10, 10}, codes);
  const Decoded back(payload.bytes());
  for (std::size_t k = 0; k < 7; ++k) {
    const auto layer = back.array<std::uint8_t>("layers", k);
    EXPECT_TRUE(std::equal(layer.begin(), layer.end(), codes.begin() + 100 * k,
                           codes.begin() + 100 * (k + 1)));
  }
}

TEST(PagePayload, RefusesShapesThatDoNotFitAndNamesUsedTwice) {
  const std::vector<std::uint8_t> three(3);
  PagePayload payload;
  payload.add("a", {3}, std::span<const std::uint8_t>(three));
  EXPECT_THROW(payload.add("a", {3}, std::span<const std::uint8_t>(three)), PreconditionViolation);
  EXPECT_THROW(payload.add("b", {2, 2}, std::span<const std::uint8_t>(three)),
               PreconditionViolation);
  EXPECT_THROW(payload.add_layers("c", {}, three), PreconditionViolation);
}

RC_GTEST_PROP(Page, ShowsThePlanWithinItsSteps, (std::uint64_t seed)) {
  Random random = Random::stream(seed, 0);
  const Plan plan = wild_plan(random);
  const std::string page = page_html({"t", plan, goal, {}}, bare);
  const Decoded arrays = arrays_of(page);
  const double step_m = record_of(page)["cost_step_m"];
  const auto region = arrays.array<std::uint8_t>("region");
  const auto heading = arrays.array<std::uint16_t>("heading");
  const auto cost = arrays.array<std::uint16_t>("cost");
  RC_ASSERT(region.size() == plan.grid.size());
  for (std::size_t i = 0; i < region.size(); ++i) {
    RC_ASSERT(region[i] - 1 == static_cast<int>(plan.region[i]));
    RC_ASSERT((cost[i] == 65535) == std::isinf(plan.cost_m[i]));
    if (cost[i] != 65535) RC_ASSERT(std::abs(cost[i] * step_m - plan.cost_m[i]) <= 0.51 * step_m);
    RC_ASSERT((heading[i] == 65535) == std::isnan(plan.heading_rad[i]));
    if (heading[i] == 65535) continue;
    const double off = std::remainder(heading[i] * two_pi / 65535 - plan.heading_rad[i], two_pi);
    RC_ASSERT(std::abs(off) <= 0.51 * two_pi / 65535);
  }
}

TEST(Page, OfTheLargestPlansItCarriesOneCellOfEachBlock) {
  const Plan plan = island_plan({2500, 7, 0.0, 0.0, 1.0}, {2000.0, 3.0}, {40, 3});
  const std::string page = page_html({"t", plan, goal, {}}, bare);
  const json values = record_of(page)["values"];
  EXPECT_EQ(values, json({{"nx", 834}, {"ny", 3}, {"cells_per_value", 3}}));
  const auto region = arrays_of(page).array<std::uint8_t>("region");
  ASSERT_EQ(region.size(), 834U * 3U);
  EXPECT_EQ(region[1 * 834 + 13], 1 + static_cast<int>(Region::obstacle));  // cell (40, 4)
  EXPECT_EQ(region[1 * 834 + 666], 1 + static_cast<int>(Region::goal));     // cell (1999, 4)
  // The last block is cut by the grid's edge, but its cell is on the grid.
  EXPECT_EQ(page_values(plan.grid).cell_of(833, 2, plan.grid), (Cell{2499, 6}));
}

VerdictMap verdicts_of(const Plan& plan) {
  VerdictMap map;
  map.grid = plan.grid;
  map.nx = plan.grid.nx;
  map.ny = plan.grid.ny;
  map.heading_rad = {0.0005, 2.0, -2.0};
  Random random = Random::stream(3, 0);
  for (std::size_t i = 0; i < map.samples(); ++i) {
    map.kind.push_back(plan.region[i] == Region::obstacle ? CellKind::obstacle
                       : plan.region[i] == Region::goal   ? CellKind::target
                                                          : CellKind::ordinary);
  }
  for (std::size_t k = 0; k < 3 * map.samples(); ++k) {
    map.verdict.push_back(static_cast<Verdict>(random.below(verdict_count)));
  }
  map.count.resize(map.samples());
  return map;
}

TEST(Page, EveryVerdictLayerIsThatOfTheMap) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const VerdictMap map = verdicts_of(plan);
  const std::string page = page_html({"t", plan, goal, {}, &map}, bare);
  const Decoded arrays = arrays_of(page);
  const json info = record_of(page)["verdicts"];
  const json codes = record_of(page)["codes"];
  const auto counts = arrays.array<std::uint8_t>("verdict_count");
  std::vector<std::size_t> sums(verdict_count * map.samples());
  for (std::size_t h = 0; h < 3; ++h) {
    const auto layer = arrays.array<std::uint8_t>("verdict", h);
    ASSERT_EQ(layer.size(), map.samples());
    std::array<std::size_t, verdict_count> seen{};
    for (std::size_t i = 0; i < layer.size(); ++i) {
      if (map.kind[i] != CellKind::ordinary) {
        EXPECT_EQ(layer[i], codes[map.kind[i] == CellKind::obstacle ? "obstacle" : "target"]);
        continue;
      }
      EXPECT_EQ(layer[i], static_cast<int>(map.verdict_at(h, i)));
      ++seen[layer[i]];
      ++sums[layer[i] * map.samples() + i];
    }
    EXPECT_EQ(info["count"][h], json(seen));
  }
  for (std::size_t k = 0; k < sums.size(); ++k) EXPECT_EQ(counts[k], sums[k]);
  EXPECT_EQ(info["heading_rad"], json(map.heading_rad));
  // The place of a sample, as given by the page.
  const Vec2 place = map.place_m(17);
  const Vec2 middle = map.grid.center(map.cell_of_sample(17));
  EXPECT_NEAR(info["offset_m"][0].get<double>(), place.x - middle.x, 1e-9);
  EXPECT_NEAR(info["offset_m"][1].get<double>(), place.y - middle.y, 1e-9);
}

TEST(Page, OfAPlanWithModesTellsWhichServesEachSampleAndWhatItCommands) {
  Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  VerdictMap map = verdicts_of(plan);
  const std::string without = page_html({"t", plan, goal, {}, &map}, bare);
  EXPECT_FALSE(arrays_of(without).header.contains("mode"));
  EXPECT_FALSE(record_of(without)["verdicts"].contains("mode_count"));
  EXPECT_FALSE(record_of(without)["styles"].contains("mode"));

  Random random = Random::stream(4, 0);
  map.modes = 3;
  for (std::size_t k = 0; k < map.verdict.size(); ++k) {
    const bool serves =
        map.kind[k % map.samples()] == CellKind::ordinary && map.verdict[k] == Verdict::reach;
    map.mode.push_back(serves ? static_cast<std::uint8_t>(random.below(3)) : no_mode);
  }
  for (std::size_t i = 0; i < 2 * plan.grid.size(); ++i) {
    plan.mode_heading_rad.push_back(random.below(5) == 0
                                        ? std::numeric_limits<float>::quiet_NaN()
                                        : Heading::stored(random.uniform(-pi, pi)));
  }
  plan.record.modes = {{"direction", 0.0}, {"<b>", {}}};
  const std::string page = page_html({"t", plan, goal, {}, &map}, bare);
  const Decoded arrays = arrays_of(page);
  const json record = record_of(page);
  ASSERT_EQ(record["styles"]["mode"].size(), 3U);
  EXPECT_EQ(record["styles"]["mode"][1]["words"], "mode 1: on towards 0 degrees");
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(record["codes"]["no_mode"], no_mode);
  for (std::size_t h = 0; h < 3; ++h) {
    const auto layer = arrays.array<std::uint8_t>("mode", h);
    ASSERT_EQ(layer.size(), map.samples());
    std::array<std::size_t, 3> seen{};
    for (std::size_t i = 0; i < layer.size(); ++i) {
      if (map.kind[i] != CellKind::ordinary) {
        EXPECT_EQ(layer[i], map.kind[i] == CellKind::obstacle ? page_obstacle : page_target);
        continue;
      }
      EXPECT_EQ(layer[i], map.mode[h * map.samples() + i]);
      if (layer[i] != no_mode) ++seen[layer[i]];
    }
    EXPECT_EQ(record["verdicts"]["mode_count"][h], json(seen));
  }
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const auto layer = arrays.array<std::uint8_t>("mode_heading", mode);
    ASSERT_EQ(layer.size(), plan.grid.size());
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const float rad = plan.mode_heading_rad[mode * plan.grid.size() + i];
      EXPECT_EQ(layer[i] == 255, std::isnan(rad));
      if (layer[i] == 255) continue;
      const double told = two_pi * layer[i] / 255.0;
      EXPECT_LT(std::abs(Heading::from_rad(told).turn_to(Heading::from_rad(rad))),
                1.001 * pi / 255.0);
    }
  }
  plan.mode_heading_rad.resize(plan.grid.size());
  EXPECT_THROW((void)page_html({"t", plan, goal, {}, &map}, bare), PreconditionViolation);
}

TEST(Page, VerdictsUnderAContractAreASecondLayerAndWithoutThemNothingChanges) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const VerdictMap map = verdicts_of(plan);
  VerdictMap under = VerdictMap::over(plan.grid, 2, 5);
  under.kind.assign(under.samples(), CellKind::ordinary);
  for (std::size_t i = 0; i < under.verdict.size(); ++i) {
    under.verdict[i] = static_cast<Verdict>(i % verdict_count);
  }
  const auto page_with = [&](const VerdictMap* contract_verdicts) {
    PageContent content{"t", plan, goal, {}, &map};
    content.contract_verdicts = contract_verdicts;
    return page_html(content, bare);
  };
  const std::string without = page_with(nullptr);
  EXPECT_EQ(without, page_html({"t", plan, goal, {}, &map}, bare));
  EXPECT_FALSE(record_of(without).contains("contract_verdicts"));

  const std::string page = page_with(&under);
  json record = record_of(page);
  EXPECT_EQ(record["contract_verdicts"]["nx"], under.nx);
  EXPECT_EQ(record["contract_verdicts"]["heading_rad"], json(under.heading_rad));
  record.erase("contract_verdicts");
  EXPECT_EQ(record, record_of(without));
  const Decoded arrays = arrays_of(page);
  for (std::size_t h = 0; h < 2; ++h) {
    const auto layer = arrays.array<std::uint8_t>("contract_verdict", h);
    ASSERT_EQ(layer.size(), under.samples());
    for (std::size_t i = 0; i < layer.size(); ++i) {
      EXPECT_EQ(layer[i], static_cast<int>(under.verdict_at(h, i)));
    }
  }
  EXPECT_EQ(arrays.array<std::uint8_t>("contract_verdict_count").size(),
            verdict_count * under.samples());
  EXPECT_EQ(arrays.array<std::uint8_t>("verdict", 1),
            arrays_of(without).array<std::uint8_t>("verdict", 1));
}

TEST(Page, ThatAPathIsFollowedComesWithItsLineAndTheTubesOutline) {
  const Plan plan = island_plan({20, 20, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const VerdictMap map = verdicts_of(plan);
  FollowProof proof;
  proof.path = {{{30.0, 35.0}, {90.00049, 35.0}, {60.0, 95.0}}, true, 1.0, 0.5};
  proof.tube = {{7.0F, 0.3F}, {9.0F, 0.3F}};
  PageContent content{"t", plan, proof.path, {}, &map};
  content.contract_verdicts = &map;
  const std::string without = page_html(content, bare);
  EXPECT_FALSE(record_of(without).contains("follow"));
  EXPECT_FALSE(arrays_of(without).header.contains("tube_x"));
  content.follow = &proof;
  content.exact_contract = true;
  const json record = record_of(page_html(content, bare));
  EXPECT_EQ(record["follow"],
            json({{"closed", true}, {"line_m", {{30.0, 35.0}, {90.0, 35.0}, {60.0, 95.0}}}}));
  EXPECT_EQ(record["exact_contract"], true);
  // Every vertex of the outline is a tube's width away from the line.
  const Decoded arrays = arrays_of(page_html(content, bare));
  const auto x = arrays.array<std::uint16_t>("tube_x");
  const auto y = arrays.array<std::uint16_t>("tube_y");
  ASSERT_EQ(x.size(), y.size());
  EXPECT_EQ(arrays.array<std::uint32_t>("tube_begin").back(), x.size());
  ASSERT_GT(x.size(), 20U);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec2 p{-3.0 + x[i] / 65535.0 * 120.0, 5.0 + y[i] / 65535.0 * 120.0};
    const double distance_m = nearest_on_path(p, proof.path).distance_m;
    EXPECT_GT(distance_m, 6.5);
    EXPECT_LT(distance_m, 9.5);
  }
}

/// Two witnesses: of three steps, and of none.
PageWitnesses witnesses_of(const VerdictMap& map) {
  PageWitnesses made;
  made.at_risk.assign(map.verdict.size(), 0);
  for (std::size_t k = 0; k < map.verdict.size(); k += 3) {
    made.at_risk[k] = map.verdict[k] == Verdict::undecided ? 1 : 0;
  }
  made.not_searched = 7;
  const State start{map.place_m(3), Heading::from_rad(map.heading_rad[1])};
  ExplainedBehaviour behaviour{{}, start, 1.0};
  behaviour.steps.push_back({start, 0.0, 4.0, 18.0, +1, 1.25, map.grid.center({2, 3})});
  behaviour.steps.push_back({start, 0.4, 2.5, 0.0, 0, -1.25, map.grid.center({3, 3})});
  behaviour.steps.push_back({start, 0.65, 3.0, 22.0, -1, pi, Vec2{-1e3, 1e9}});
  made.shown = {{1, 3, Verdict::leave, behaviour}, {0, 5, Verdict::collide, {{}, start, 0.0}}};
  return made;
}

TEST(Page, StatesAtRiskHaveACodeOfTheirOwnAndAreCounted) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const VerdictMap exact = verdicts_of(plan);
  VerdictMap under = VerdictMap::over(plan.grid, 2, 5);
  under.kind.assign(under.samples(), CellKind::ordinary);
  for (std::size_t i = 0; i < under.verdict.size(); ++i) {
    under.verdict[i] = static_cast<Verdict>(i % 2);
  }
  const PageWitnesses witnesses = witnesses_of(under);
  PageContent content{"t", plan, goal, {}, &exact};
  content.contract_verdicts = &under;
  const json plain = record_of(page_html(content, bare));
  EXPECT_FALSE(plain["codes"].contains("at_risk") || plain["styles"].contains("at_risk"));
  content.witnesses = &witnesses;
  const std::string page = page_html(content, bare);
  const json record = record_of(page);
  const Decoded arrays = arrays_of(page);
  const std::uint8_t code = record["codes"]["at_risk"];
  EXPECT_GE(code, verdict_count);
  EXPECT_NE(record["styles"]["at_risk"]["ground"], record["styles"]["verdict"][0]["ground"]);
  std::vector<std::size_t> by_heading(2);
  std::vector<std::uint8_t> by_sample(under.samples());
  for (std::size_t k = 0; k < under.verdict.size(); ++k) {
    const auto layer = arrays.array<std::uint8_t>("contract_verdict", k / under.samples());
    const bool at_risk = witnesses.at_risk[k] != 0;
    EXPECT_EQ(layer[k % under.samples()], at_risk ? code : static_cast<int>(under.verdict[k]));
    by_heading[k / under.samples()] += at_risk ? 1 : 0;
    if (at_risk) ++by_sample[k % under.samples()];
  }
  EXPECT_GT(by_heading[0], 0U);
  EXPECT_EQ(record["contract_verdicts"]["at_risk"], json(by_heading));
  EXPECT_EQ(record["contract_verdicts"]["count"], plain["contract_verdicts"]["count"]);
  EXPECT_EQ(record["contract_verdicts"]["not_searched"], 7);
  EXPECT_EQ(arrays.array<std::uint8_t>("contract_at_risk_count"), by_sample);
}

TEST(Page, WitnessesComeStepByStepWithTheCellWhoseCommandIsInForce) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const VerdictMap exact = verdicts_of(plan);
  const PageWitnesses witnesses = witnesses_of(exact);
  PageContent content{"t", plan, goal, {}, &exact};
  content.contract_verdicts = &exact;
  content.witnesses = &witnesses;
  const Decoded arrays = arrays_of(page_html(content, bare));
  EXPECT_EQ(arrays.array<std::uint32_t>("witness_sample"), (std::vector<std::uint32_t>{3, 5}));
  EXPECT_EQ(arrays.array<std::uint8_t>("witness_heading"), (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(arrays.array<std::uint8_t>("witness_end"),
            (std::vector<std::uint8_t>{static_cast<std::uint8_t>(Verdict::leave),
                                       static_cast<std::uint8_t>(Verdict::collide)}));
  EXPECT_EQ(arrays.array<std::uint32_t>("witness_begin"), (std::vector<std::uint32_t>{0, 3, 3}));
  EXPECT_EQ(arrays.array<float>("witness_length_m"), (std::vector<float>{4.0F, 2.5F, 3.0F}));
  EXPECT_EQ(arrays.array<float>("witness_curvature_per_m"),
            (std::vector<float>{1.0F / 18.0F, 0.0F, -1.0F / 22.0F}));
  const auto command = arrays.array<std::uint16_t>("witness_command");
  EXPECT_NEAR(command[0] * two_pi / 65535, 1.25, 1e-4);
  EXPECT_NEAR(command[1] * two_pi / 65535, two_pi - 1.25, 1e-4);
  const Grid& g = plan.grid;
  EXPECT_EQ(arrays.array<std::uint32_t>("witness_cell"),
            (std::vector<std::uint32_t>{static_cast<std::uint32_t>(g.index({2, 3})),
                                        static_cast<std::uint32_t>(g.index({3, 3})),
                                        static_cast<std::uint32_t>(g.index({0, g.ny - 1}))}))
      << "of a place outside the grid, the nearest";

  PageWitnesses wrong = witnesses;
  wrong.at_risk.pop_back();
  content.witnesses = &wrong;
  EXPECT_THROW((void)page_html(content, bare), PreconditionViolation);
  wrong = witnesses;
  wrong.shown[0].sample = exact.samples();
  EXPECT_THROW((void)page_html(content, bare), PreconditionViolation);
}

TEST(Page, TheRecordListsEveryVerdictAndOutcomeOnce) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const json record = record_of(page_html({"t", plan, goal, {}}, bare));
  const json& codes = record["codes"];
  std::set<int> listed;
  for (const json& code : codes["order"]) {
    EXPECT_TRUE(listed.insert(code.get<int>()).second);
    EXPECT_EQ(record["styles"]["verdict"].at(code.get<std::size_t>())["name"],
              name_of(static_cast<Verdict>(code.get<int>())));
  }
  EXPECT_EQ(listed.size(), record["styles"]["verdict"].size());
  EXPECT_EQ(codes["failing"].size() + codes["safe"].size() + 1, listed.size());
  for (const char* name : {"obstacle", "target"}) {
    EXPECT_EQ(listed.count(codes[name].get<int>()), 0U) << name;
  }
  for (const Outcome outcome : outcomes_in_order) {
    EXPECT_EQ(record["styles"]["outcome"][name_of(outcome)]["color"].get<std::string>().size(), 7U);
  }
}

TEST(Page, FlightsComeWithTheirPiecesAndLegsAndSayHowManyAreLeftOut) {
  const Plan plan = island_plan({14, 12, -300.0, 5.0, 6.0}, {-240.0, 40.0}, {4, 6});
  const State start{{-290.0, 20.0}, Heading::from_rad(1.0)};
  const State later{{-280.0, 30.0}, Heading::from_rad(0.5)};
  Flight with_leg = flight_of({{start, 0.0, 12.0, 0.1}, {later, 1.2, 3.0, 0.0}}, Outcome::reach);
  with_leg.final_leg.state = FinalLegState::shortest;
  with_leg.final_leg.segments = {{later, 1.5, 2.0, -0.1}};
  Flight trapped = flight_of({{start, 0.0, 9.0, 0.0}}, Outcome::trapped);
  trapped.result.time_s = trapped.result.length_m = INFINITY;
  const std::vector<Flight> flights{with_leg, trapped, trapped};
  const std::string page = page_html({"t", plan, goal, {{"given", flights, 2}}}, bare);
  const json record = record_of(page);
  const auto failing =
      record_of(page_html({"t", plan, goal, {{"failing", flights, 1, "cut_off"}}}, bare));
  EXPECT_EQ(failing["flights"][0]["ground"], "cut_off");
  EXPECT_FALSE(record["flights"][0].contains("ground"));
  EXPECT_FALSE(record["flights"][0].contains("after"));
  ASSERT_EQ(record["flights"].size(), 2U);
  EXPECT_EQ(record["flights_left_out"], json({{"given", 1}}));
  EXPECT_EQ(record["flights"][0]["pieces"], json({0, 2}));
  EXPECT_EQ(record["flights"][0]["leg"]["pieces"], json({2, 3}));
  EXPECT_EQ(record["flights"][1]["pieces"], json({3, 4}));
  EXPECT_TRUE(record["flights"][1]["time_s"].is_null());
  const Decoded arrays = arrays_of(page);
  EXPECT_EQ(arrays.array<float>("piece_x_m"), (std::vector<float>{10.0F, 20.0F, 20.0F, 10.0F}));
  EXPECT_EQ(arrays.array<float>("piece_length_m"), (std::vector<float>{12.0F, 3.0F, 2.0F, 9.0F}));
}

TEST(Page, FollowedFlightsSayWhatComesAfterReaching) {
  const Plan plan = island_plan({14, 12, -300.0, 5.0, 6.0}, {-240.0, 40.0}, {4, 6});
  const State start{{-290.0, 20.0}, Heading::from_rad(1.0)};
  std::vector<Flight> flights(4, flight_of({{start, 0.0, 12.0, 0.1}}, Outcome::reach));
  for (std::size_t i = 0; i < flights.size(); ++i) flights[i].onward.after = afters_in_order[i];
  const json shown =
      record_of(page_html({"t", plan, goal, {{"given", flights, 4}}}, bare))["flights"];
  EXPECT_EQ(shown[0]["after"], "follow");
  EXPECT_EQ(shown[1]["after"], "hold");
  EXPECT_EQ(shown[2]["after"], "collide");
  EXPECT_EQ(shown[3]["after"], "leave");
  for (const json& flight : shown) EXPECT_EQ(flight["outcome"], "reach");
}

TEST(Page, NoTextOfAFileBecomesMarkup) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const std::string evil = "</script><script>alert(1)</script><!-- & \"x\" 'y' @FAIRWAY_ARRAYS@";
  const json summary = {{"inputs", {{{"path", evil}, {"sha256", evil}}}}, {evil, evil}};
  const std::string page = page_html({evil, plan, goal, {}, nullptr, {evil}, summary.dump()}, bare);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_NE(page.find("<title>&lt;/script&gt;&lt;script&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<script"), page.find("<script id=r>"));
  const json record = record_of(page);
  EXPECT_EQ(record["words"][0], evil);
  EXPECT_EQ(record["title"], evil);
  EXPECT_EQ(record["summary"], summary);
  EXPECT_TRUE(record["verdicts"].is_null());
  EXPECT_NO_THROW((void)arrays_of(page).array<std::uint8_t>("region"));
}

TEST(Page, BytesThatAreNotTextDoNotBreakIt) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  const std::string page = page_html({"\xff\xfe", plan, goal, {}, nullptr, {"\xc3("}}, bare);
  EXPECT_EQ(record_of(page)["words"].size(), 1U);
}

TEST(Page, ATemplateWithoutAMarkIsRefused) {
  const Plan plan = island_plan({14, 12, -3.0, 5.0, 6.0}, {60.0, 40.0}, {4, 6});
  EXPECT_THROW((void)page_html({"t", plan, goal, {}}, "@FAIRWAY_TITLE@ @FAIRWAY_RECORD@"),
               PreconditionViolation);
}

TEST(PageTemplate, IsAPageThatFetchesNothingOrSaysWhyThereIsNone) {
  const std::string_view html = page_template();
  ASSERT_FALSE(html.empty());
  if (!has_page_template()) {
    EXPECT_NE(html.find("when fairway was built"), std::string_view::npos) << html;
    return;
  }
  EXPECT_LT(html.size(), 700'000U);
  EXPECT_TRUE(html.find("</html>") != std::string_view::npos);
  for (const char* fetches : {" src=\"", "@import", "url(http", "<link"}) {
    EXPECT_EQ(html.find(fetches), std::string_view::npos) << fetches;
  }
}

TEST(Contours, OfThePageHaveRoundLevelsNotTooMany) {
  for (const double far_m : {3.0, 17.0, 99.0, 1000.0, 12345.0}) {
    Plan plan = island_plan({14, 12, 0.0, 0.0, 6.0}, {60.0, 40.0}, {4, 6});
    for (float& cost : plan.cost_m) {
      if (std::isfinite(cost)) cost = static_cast<float>(far_m);
    }
    const std::vector<double> levels = page_contour_levels_m(plan);
    ASSERT_GE(levels.size(), 4U) << far_m;
    EXPECT_LE(levels.size(), 12U) << far_m;
    EXPECT_LT(levels.back(), far_m);
    const double digit = levels[0] / std::pow(10.0, std::floor(std::log10(levels[0]) + 1e-9));
    EXPECT_TRUE(std::abs(digit - 1.0) < 1e-9 || std::abs(digit - 2.0) < 1e-9 ||
                std::abs(digit - 5.0) < 1e-9)
        << levels[0];
  }
}

}  // namespace
}  // namespace fairway
