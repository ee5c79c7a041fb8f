#include "fairway/report/draw_verdicts.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/report/draw_modes.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/mode_style.hpp"
#include "fairway/report/testing/reading_pictures.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

using testing::elements_of_layer;
using testing::has_layer;
using testing::has_text;
using testing::read_png;

constexpr int states = 32;
constexpr std::array<Verdict, 5> all_verdicts{Verdict::undecided, Verdict::reach, Verdict::collide,
                                              Verdict::leave, Verdict::trapped};

/// `kind(ix, iy)` and `verdict(heading, ix, iy)` give the contents; all states of a cell have the
/// verdict of its first heading.
template <typename Kind, typename Of>
VerdictMap map_of(int nx, int ny, int headings, const Kind& kind, const Of& verdict) {
  VerdictMap map;
  map.grid = {nx, ny, 100.0, -50.0, 8.0};
  map.nx = nx;
  map.ny = ny;
  map.states_per_sample = states;
  for (int h = 0; h < headings; ++h) {
    map.heading_rad.push_back(Heading::from_rad(two_pi * h / headings).rad());
  }
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      map.kind.push_back(kind(ix, iy));
      map.count.push_back({});
    }
  }
  for (int h = 0; h < headings; ++h) {
    for (int i = 0; i < nx * ny; ++i) {
      const bool flown = map.kind[static_cast<std::size_t>(i)] == CellKind::ordinary;
      const Verdict v = flown ? verdict(h, i % nx, i / nx) : Verdict::undecided;
      map.verdict.push_back(v);
      if (h > 0 || !flown) continue;
      map.count[static_cast<std::size_t>(i)][static_cast<std::size_t>(v)] = states;
    }
  }
  return map;
}

CellKind with_rock_and_goal(int ix, int iy) {
  if (ix == 3 && iy == 5) return CellKind::obstacle;
  return ix >= 8 && iy >= 8 ? CellKind::target : CellKind::ordinary;
}

/// Ten columns, two for each verdict.
VerdictMap stripes(int headings = 8) {
  return map_of(10, 10, headings, with_rock_and_goal,
                [](int, int ix, int) { return all_verdicts[static_cast<std::size_t>(ix / 2)]; });
}

/// The colour at the centre of a cell of the first panel, which has the same place in every
/// picture.
Color color_at(const testing::PngPicture& png, const VerdictMap& map, double panel_pt, Vec2 cell) {
  const MapPanels page(map, {"", 1, panel_pt, 2.0}, {{"panel"}}, {});
  const Grid& g = map.grid;
  const Vec2 at = page.frame(0).to_page({g.x0_m + cell.x * g.cell_m, g.y0_m + cell.y * g.cell_m});
  return png.at(2.0 * at.x, 2.0 * at.y);
}

double grey_lightness(const Color& c) {
  const auto linear = [](double byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

/// Each is what its kind of mission asks; no picture has both.
bool mean_the_same(Verdict one, Verdict other) {
  const auto is_asked = [](Verdict v) { return v == Verdict::reach || v == Verdict::follow; };
  return is_asked(one) && is_asked(other);
}

TEST(VerdictStyle, GroundsDifferInGreyPrintAndFromObstacles) {
  for (std::size_t i = 0; i < verdicts_in_order.size(); ++i) {
    const double one = grey_lightness(style_of(verdicts_in_order[i]).ground);
    EXPECT_GT(one, grey_lightness(palette::obstacle) + 8.0) << name_of(verdicts_in_order[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if (mean_the_same(verdicts_in_order[i], verdicts_in_order[k])) continue;
      EXPECT_GT(std::abs(one - grey_lightness(style_of(verdicts_in_order[k]).ground)), 8.0)
          << name_of(verdicts_in_order[i]) << " and " << name_of(verdicts_in_order[k]);
    }
  }
}

TEST(VerdictStyle, EveryVerdictHasItsOwnPattern) {
  const auto pattern = [](Verdict v) {
    const VerdictStyle s = style_of(v);
    return std::tuple(s.rising, s.falling, s.rising || s.falling ? s.pen.dash_pt.size() : 0);
  };
  for (std::size_t i = 0; i < verdicts_in_order.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (mean_the_same(verdicts_in_order[i], verdicts_in_order[k])) continue;
      EXPECT_NE(pattern(verdicts_in_order[i]), pattern(verdicts_in_order[k]));
    }
  }
}

TEST(VerdictStyle, StatesAtRiskHaveAPatternOfTheirOwnAndDifferInGreyFromThoseAround) {
  const VerdictStyle s = at_risk_style();
  for (const Verdict verdict : verdicts_in_order) {
    const VerdictStyle other = style_of(verdict);
    EXPECT_NE(std::tuple(s.rising, s.falling, s.pen.dash_pt.empty()),
              std::tuple(other.rising, other.falling, other.pen.dash_pt.empty()));
    if (verdict == Verdict::leave || verdict == Verdict::trapped) continue;  // both are rare
    EXPECT_GT(std::abs(grey_lightness(s.ground) - grey_lightness(other.ground)), 8.0)
        << name_of(verdict);
  }
}

TEST(DrawVerdicts, StatesAtRiskHaveALookAndALineOfTheLegendOfTheirOwn) {
  const VerdictMap map =
      map_of(10, 10, 2, with_rock_and_goal, [](int, int, int) { return Verdict::undecided; });
  std::vector<std::uint8_t> at_risk(map.verdict.size());
  at_risk[23] = 1;  // of the first heading
  const Picture plain = draw_verdicts(map, {.panel_pt = 200.0});
  const Picture risky = draw_verdicts(map, {.panel_pt = 200.0, .at_risk = &at_risk});
  EXPECT_FALSE(has_text(plain.svg, "at risk"));
  EXPECT_TRUE(has_text(risky.svg, "at risk"));
  const testing::PngPicture png = read_png(risky.png);
  // Between the strokes of the pattern.
  const auto lightest = [&](int ix, int iy) {
    Color best{};
    for (double dx = 0.1; dx < 1.0; dx += 0.1) {
      const Color c = color_at(png, map, 200.0, {ix + dx, iy + 0.5});
      if (grey_lightness(c) > grey_lightness(best)) best = c;
    }
    return best;
  };
  EXPECT_EQ(lightest(3, 2), at_risk_style().ground);
  EXPECT_EQ(lightest(5, 2), style_of(Verdict::undecided).ground);
  at_risk.pop_back();
  EXPECT_THROW((void)draw_verdicts(map, {.at_risk = &at_risk}), PreconditionViolation);
}

TEST(DrawVerdicts, HasAPanelForEachHeadingAndNamesAll) {
  const Picture picture = draw_verdicts(stripes(), {.title = "A plan & its <verdicts>"});
  for (int k = 1; k <= 8; ++k) {
    EXPECT_TRUE(has_layer(picture.svg, "panel-" + std::to_string(k))) << k;
    EXPECT_TRUE(has_text(picture.svg, "heading " + std::to_string(45 * (k - 1)) + "°")) << k;
  }
  EXPECT_FALSE(has_layer(picture.svg, "panel-9"));
  for (const char* text :
       {"A plan & its <verdicts>", "proved: reach", "proved: collide", "proved: leave",
        "proved: trapped", "undecided", "obstacle", "goal", "20 m"}) {
    EXPECT_TRUE(has_text(picture.svg, text)) << text;
  }
  EXPECT_TRUE(has_layer(picture.svg, "legend"));
  EXPECT_GT(read_png(picture.png).width, 1200);
}

TEST(DrawVerdicts, ArrowsPointAlongTheHeadings) {
  const Picture picture = draw_verdicts(stripes(4), {});
  for (int k = 0; k < 4; ++k) {
    const auto drawn = elements_of_layer(picture.svg, "caption-" + std::to_string(k + 1));
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    ASSERT_EQ(
        std::sscanf(drawn.at(1).attributes.at("d").c_str(), "M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1),
        4);
    EXPECT_NEAR(std::atan2(y0 - y1, x1 - x0) - pi / 2 * k, k == 3 ? -two_pi : 0.0, 0.01);
  }
}

TEST(DrawVerdicts, ColoursAreWhereTheVerdictsAre) {
  const VerdictMap map = stripes();
  const auto png = read_png(draw_verdicts(map, {.panel_pt = 300.0}).png);
  const auto at = [&](Vec2 cell) { return color_at(png, map, 300.0, cell); };
  EXPECT_EQ(at({3.5, 1.5}), style_of(Verdict::reach).ground);
  EXPECT_EQ(at({2.5, 9.5}), style_of(Verdict::reach).ground);
  EXPECT_EQ(at({3.5, 5.5}), palette::obstacle);
  // Others lie under strokes: their ground shows between them.
  for (const auto& [verdict, column] : {std::pair{Verdict::undecided, 1},
                                        {Verdict::collide, 5},
                                        {Verdict::leave, 7},
                                        {Verdict::trapped, 9}}) {
    int ground = 0;
    for (double y = 1.0; y < 7.0; y += 0.05) {
      ground += at({column - 0.3, y}) == style_of(verdict).ground ? 1 : 0;
    }
    EXPECT_GT(ground, 12) << name_of(verdict);
  }
}

TEST(DrawVerdicts, APatternIsThereOnlyWhereItsVerdictIs) {
  const auto strokes = [](Verdict verdict) {
    const VerdictMap map = map_of(
        6, 6, 1, [](int, int) { return CellKind::ordinary; },
        [&](int, int, int) { return verdict; });
    std::size_t count = 0;
    for (const auto& e : elements_of_layer(draw_verdicts(map, {}).svg, "panel-1")) {
      count += e.name == "path" ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(strokes(Verdict::reach), 0U);
  EXPECT_EQ(strokes(Verdict::collide), 1U);
  EXPECT_EQ(strokes(Verdict::leave), 1U);
  EXPECT_EQ(strokes(Verdict::undecided), 1U);
  EXPECT_EQ(strokes(Verdict::trapped), 2U);
}

TEST(DrawVerdicts, ShareOfHeadingsThatReachIsWrittenAndNeverRoundedToAll) {
  const auto everywhere = [](int, int) { return CellKind::ordinary; };
  const auto with_failing = [&](int failing) {
    return map_of(100, 100, 1, everywhere, [&](int, int ix, int iy) {
      return ix + 100 * iy < failing ? Verdict::leave : Verdict::reach;
    });
  };
  EXPECT_TRUE(has_text(draw_verdicts(with_failing(0), {}).svg, "100 % reach"));
  EXPECT_TRUE(has_text(draw_verdicts(with_failing(1), {}).svg, "> 99.9 % reach"));
  EXPECT_TRUE(has_text(draw_verdicts(with_failing(2500), {}).svg, "75.0 % reach"));
  EXPECT_TRUE(has_text(draw_verdicts(with_failing(9999), {}).svg, "< 0.1 % reach"));
  EXPECT_TRUE(has_text(draw_verdicts(with_failing(10000), {}).svg, "0 % reach"));
}

TEST(DrawProvedShares, ThreePanelsCountTheStatesOfAllHeadings) {
  VerdictMap map = stripes(1);
  const Picture picture = draw_proved_shares(map, {.title = "shares"});
  for (const char* text : {"shares", "proved to reach", "proved to fail", "undecided",
                           "of 32 states per cell", "all", "none", "up to 1/8", "obstacle"}) {
    EXPECT_TRUE(has_text(picture.svg, text)) << text;
  }
  EXPECT_TRUE(has_layer(picture.svg, "panel-3"));
  EXPECT_FALSE(has_layer(picture.svg, "panel-4"));
  // 95 ordinary cells: 19 reach, 20 are undecided, 56 fail.
  EXPECT_TRUE(has_text(picture.svg, "20.0 %"));
  EXPECT_TRUE(has_text(picture.svg, "21.1 %"));
  EXPECT_TRUE(has_text(picture.svg, "58.9 %"));
}

TEST(DrawProvedShares, OneStateAmongAllShows) {
  VerdictMap map = map_of(
      4, 4, 1, [](int, int) { return CellKind::ordinary; },
      [](int, int, int) { return Verdict::reach; });
  const auto shade = [&](int reaching) {
    map.count[map.index(1, 1)] = {};
    map.count[map.index(1, 1)][1] = static_cast<std::uint16_t>(reaching);
    map.count[map.index(1, 1)][4] = static_cast<std::uint16_t>(states - reaching);
    return grey_lightness(color_at(read_png(draw_proved_shares(map, {.panel_pt = 200.0}).png), map,
                                   200.0, {1.5, 1.5}));
  };
  EXPECT_EQ(shade(0), grey_lightness(palette::white));
  double last = shade(0);
  for (const int reaching : {1, 16, 28, 31, 32}) {
    const double darker = shade(reaching);
    EXPECT_LT(darker, last - 3.0) << reaching;
    last = darker;
  }
}

RC_GTEST_PROP(DrawVerdicts, AnyMapGivesPictures, (std::uint64_t seed)) {
  Random random(seed);
  const VerdictMap map = map_of(
      static_cast<int>(random.below(9)), static_cast<int>(random.below(9)),
      1 + static_cast<int>(random.below(9)),
      [&](int, int) { return static_cast<CellKind>(random.below(3)); },
      [&](int, int, int) { return all_verdicts[random.below(5)]; });
  const VerdictPictureOptions options{.title = "wild", .panel_pt = 40.0, .pixels_per_pt = 1.0};
  for (const Picture& picture : {draw_verdicts(map, options), draw_proved_shares(map, options)}) {
    RC_ASSERT(has_layer(picture.svg, "legend"));
    RC_ASSERT(read_png(picture.png).height > 40);
  }
}

TEST(DrawVerdicts, ACoarseMapIsCutAtTheGridsEdge) {
  VerdictMap map = stripes();
  map.grid.nx = 28;  // the last block holds one column of cells alone
  map.grid.ny = 30;
  map.cells_per_sample = 3;
  const auto png = read_png(draw_verdicts(map, {.panel_pt = 300.0}).png);
  EXPECT_EQ(color_at(png, map, 300.0, {3 * 3.5, 3 * 1.5}), style_of(Verdict::reach).ground);
  EXPECT_EQ(color_at(png, map, 300.0, {3 * 3.5, 3 * 5.5}), palette::obstacle);
  EXPECT_EQ(color_at(png, map, 300.0, {28.6, 10.0}), palette::white);  // beside the panel
}

TEST(DrawVerdicts, AMapOfABigCitysPlanGivesSvgsSmallEnoughForAPaper) {
  Random random(5);
  const auto blob = [](double x, double y) { return std::sin(0.11 * x) + std::sin(0.07 * y); };
  VerdictMap map = map_of(
      256, 256, 8,
      [&](int ix, int iy) { return blob(ix, iy) > 1.3 ? CellKind::obstacle : CellKind::ordinary; },
      [&](int h, int ix, int iy) {
        if (random.below(50) == 0) return all_verdicts[random.below(5)];
        return blob(ix + 5 * h, iy) > 0.9 ? Verdict::collide : Verdict::reach;
      });
  map.grid.nx = map.grid.ny = 512;
  map.cells_per_sample = 2;
  EXPECT_LT(draw_verdicts(map, {}).svg.size(), 1'000'000U);
  EXPECT_LT(draw_proved_shares(map, {}).svg.size(), 1'000'000U);
}

TEST(DrawVerdicts, CallerMistakesAreReported) {
  VerdictMap map = stripes();
  EXPECT_THROW(static_cast<void>(draw_verdicts(map, {.panel_pt = 5.0})), PreconditionViolation);
  EXPECT_THROW(static_cast<void>(draw_verdicts(map, {.pixels_per_pt = 99.0})),
               PreconditionViolation);
  map.count.pop_back();
  EXPECT_THROW(static_cast<void>(draw_proved_shares(map, {})), PreconditionViolation);
  VerdictMap without = stripes(0);
  EXPECT_THROW(static_cast<void>(draw_verdicts(without, {})), PreconditionViolation);
  without = stripes();
  without.states_per_sample = 0;
  EXPECT_THROW(static_cast<void>(draw_proved_shares(without, {})), PreconditionViolation);
}

/// Columns served by modes 0 to 3, two each; the last two by none.
VerdictMap served_by_columns() {
  VerdictMap map = map_of(10, 10, 2, with_rock_and_goal, [](int, int ix, int) {
    return ix < 8 ? Verdict::reach : Verdict::collide;
  });
  map.modes = 5;
  for (std::size_t k = 0; k < map.verdict.size(); ++k) {
    const bool reaches = map.verdict[k] == Verdict::reach;
    map.mode.push_back(reaches ? static_cast<std::uint8_t>(k % 10 / 2) : no_mode);
  }
  return map;
}

const std::vector<ModeRecord> four_modes{
    {"direction", 0.0}, {"direction", pi / 2}, {"turning_places", {}}, {"direction", -pi / 4}};

TEST(DrawModes, PaintsEachStateByTheModeThatServesIt) {
  const VerdictMap map = served_by_columns();
  const auto looks = mode_looks(map.modes, four_modes);
  ASSERT_EQ(looks.size(), 5U);
  const Picture picture = draw_modes(map, looks, {.title = "M", .panel_pt = 300.0});
  const auto png = read_png(picture.png);
  for (int ix = 0; ix < 8; ++ix) {
    const Color painted = color_at(png, map, 300.0, {ix + 0.25, 2.5});
    int same = 0;
    int own = 0;
    for (int dy = 1; dy < 8; ++dy) {  // most of a cell is ground, whatever its pattern
      const Color c = color_at(png, map, 300.0, {ix + 0.5, 2.0 + dy / 8.0});
      own += c == looks[static_cast<std::size_t>(ix / 2)].style.ground ? 1 : 0;
      same += c == painted ? 1 : 0;
    }
    EXPECT_GT(own, 2) << ix << " " << same;
  }
  for (const char* words :
       {"mode 0: the plan's own", "mode 1: on towards 0 degrees", "mode 2: on towards 90 degrees",
        "mode 3: turning places", "no mode is proved to reach"}) {
    EXPECT_TRUE(has_text(picture.svg, words)) << words;
  }
  EXPECT_FALSE(has_text(picture.svg, looks[4].name)) << "it serves no state";
  // Of 10 x 10 samples 1 is a rock, 4 are the goal, all of them served by none.
  EXPECT_TRUE(has_text(picture.svg, "62.1 % by further modes"));
}

TEST(DrawModes, OfAPlanWithoutModesIsWhatReaches) {
  VerdictMap map = served_by_columns();
  map.mode.clear();
  map.modes = 1;
  const Picture picture = draw_modes(map, mode_looks(1, {}), {.title = "M"});
  EXPECT_TRUE(has_text(picture.svg, "mode 0: the plan's own"));
  EXPECT_TRUE(has_text(picture.svg, "0 % by further modes"));
}

TEST(DrawModes, RejectsLooksAndModesThatDoNotFit) {
  VerdictMap map = served_by_columns();
  EXPECT_THROW((void)draw_modes(map, mode_looks(4, four_modes), {}), PreconditionViolation);
  map.mode[0] = 5;
  EXPECT_THROW((void)draw_modes(map, mode_looks(5, four_modes), {}), PreconditionViolation);
  map.mode.pop_back();
  EXPECT_THROW((void)draw_modes(map, mode_looks(5, four_modes), {}), PreconditionViolation);
}

TEST(ModeLooks, AreHuesOfDirectionsAndNeighboursDifferInPattern) {
  std::vector<ModeRecord> records;
  for (int k = 0; k < 8; ++k) records.push_back({"direction", pi / 4 * k});
  const auto looks = mode_looks(9, records);
  for (std::size_t a = 1; a < looks.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_FALSE(looks[a].style.ground == looks[b].style.ground) << a << " " << b;
    }
    const VerdictStyle& one = looks[a].style;
    const VerdictStyle& last = looks[a - 1].style;
    EXPECT_FALSE(a > 1 && one.rising == last.rising && one.falling == last.falling) << a;
  }
  // A whole turn more is the same direction; a record may lack some.
  records[2].direction_rad = *records[2].direction_rad - two_pi;
  EXPECT_EQ(mode_looks(9, records)[3].name, looks[3].name);
  EXPECT_EQ(looks[3].name, "mode 3: on towards 90 degrees");
  EXPECT_EQ(mode_looks(3, {}).size(), 3U);
  EXPECT_EQ(mode_looks(3, {})[2].name, "mode 2");
}

}  // namespace
}  // namespace fairway
