#include "fairway/report/draw_flights.hpp"

#include <array>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/report/flight_path.hpp"
#include "fairway/report/map_page.hpp"
#include "fairway/report/testing/plans_to_draw.hpp"
#include "fairway/report/testing/reading_pictures.hpp"

namespace fairway {
namespace {

using testing::has_layer;
using testing::has_text;
using testing::read_png;

const Grid grid{40, 30, 0.0, 0.0, 8.0};

Plan open_water() {
  return testing::plan_of(
      grid, [](Vec2) { return 1.0; }, [](Vec2) { return 0.0; });
}

/// The state at the end of a piece, by the model's formulas.
State end_of(const FlightSegment& piece) {
  const double h = piece.start.heading.rad();
  const double k = piece.curvature_per_m;
  const double h1 = h + k * piece.length_m;
  const Vec2 moved = k == 0.0
                         ? piece.length_m * Vec2{std::cos(h), std::sin(h)}
                         : 1.0 / k * Vec2{std::sin(h1) - std::sin(h), std::cos(h) - std::cos(h1)};
  return {piece.start.position_m + moved, Heading::from_rad(h1)};
}

Flight flight_of(const State& start, const std::vector<std::pair<double, double>>& pieces,
                 Outcome outcome = Outcome::reach) {
  Flight flight{start, {outcome, 0.0, 0.0}, {}};
  State here = start;
  for (const auto& [length_m, curvature_per_m] : pieces) {
    flight.segments.push_back({here, flight.result.time_s, length_m, curvature_per_m});
    flight.result.time_s += length_m / 10.0;
    flight.result.length_m += length_m;
    here = end_of(flight.segments.back());
  }
  return flight;
}

RC_GTEST_PROP(FlightPath, ItsPiecesEndWhereTheFlightDoes, (std::uint64_t seed)) {
  Random random(seed);
  std::vector<std::pair<double, double>> pieces;
  for (std::uint64_t i = 0, n = 1 + random.below(6); i < n; ++i) {
    const double curvature = std::array{0.0, 0.05, -0.05, -0.2}[random.below(4)];
    pieces.push_back({random.uniform(0.0, 200.0), curvature});
  }
  const Flight flight = flight_of({{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)},
                                   Heading::from_rad(random.uniform(-4.0, 4.0))},
                                  pieces);
  const PlotFrame frame{{10.0, 20.0, 300.0, 300.0}, {-100.0, 200.0, "", 6}, {-50.0, 250.0, "", 6}};
  const DrawingPath path = flight_path(flight, frame);
  const Vec2 end = frame.to_page(end_of(flight.segments.back()).position_m);
  RC_ASSERT(norm(path.pieces().back().end - end) < 1e-6);
  Vec2 last = path.pieces().front().end;
  RC_ASSERT(norm(last - frame.to_page(flight.start.position_m)) < 1e-9);
  for (const auto& piece : path.pieces()) {  // each arc starts where the piece before it ended
    if (piece.kind == DrawingPath::Kind::arc) {
      const Vec2 from{piece.center.x + piece.radius * std::cos(piece.from_rad),
                      piece.center.y + piece.radius * std::sin(piece.from_rad)};
      RC_ASSERT(norm(from - last) < 1e-6);
    }
    last = piece.end;
  }
}

TEST(FlightPath, PiecesOfTheSameTurnBecomeOneArc) {
  const Flight flight =
      flight_of({{0.0, 0.0}, Heading()}, {{5.0, 0.05}, {6.0, 0.05}, {7.0, 0.05}, {5.0, 0.0}});
  const PlotFrame frame{{0.0, 0.0, 100.0, 100.0}, {0.0, 100.0, "", 6}, {0.0, 100.0, "", 6}};
  EXPECT_EQ(flight_path(flight, frame).pieces().size(), 3U);
}

TEST(FlightPath, ArcsTooFlatToSeeAreDrawnAsLinesToTheirEnds) {
  // Of a radius of 1e14 m the centre would be a hundredth of a metre off.
  const Flight flight = flight_of({{10.0, 20.0}, Heading::from_rad(0.3)}, {{50.0, 1e-14}});
  const PlotFrame frame{{0.0, 0.0, 100.0, 100.0}, {0.0, 100.0, "", 6}, {0.0, 100.0, "", 6}};
  const DrawingPath path = flight_path(flight, frame);
  EXPECT_EQ(path.pieces().back().kind, DrawingPath::Kind::line);
  const Vec2 end{10.0 + 50.0 * std::cos(0.3), 100.0 - 20.0 - 50.0 * std::sin(0.3)};
  EXPECT_LT(norm(path.pieces().back().end - end), 1e-9);
}

TEST(DrawFlights, AQuarterTurnIsDrawnOnItsCircle) {
  const Plan plan = open_water();
  const double r = 60.0;
  const std::vector<Flight> flights{
      flight_of({{100.0, 100.0}, Heading::from_rad(0.0)}, {{0.5 * pi * r, 1.0 / r}})};
  const FlightPictureOptions options{};
  MapPage page(plan, {"", false, {}, options.frame_pt, options.pixels_per_pt}, {});
  const auto png = read_png(draw_flights(plan, flights, options).png);
  for (const double angle : {0.5, 1.0, 1.4}) {  // from the centre (100, 160)
    const Vec2 on{100.0 + r * std::sin(angle), 160.0 - r * std::cos(angle)};
    const Vec2 at = page.frame().to_page(on);
    const Color c = png.at(at.x * options.pixels_per_pt, at.y * options.pixels_per_pt);
    EXPECT_LT(c.red, 150) << angle;
    const Vec2 beside = page.frame().to_page(Vec2{100.0, 160.0} + 0.8 * (on - Vec2{100.0, 160.0}));
    EXPECT_EQ(png.at(beside.x * options.pixels_per_pt, beside.y * options.pixels_per_pt),
              palette::free);
  }
}

TEST(DrawFlights, TheLegendCountsOutcomesAndEachHasALayer) {
  const State start{{100.0, 100.0}, Heading()};
  std::vector<Flight> flights(3, flight_of(start, {{50.0, 0.0}}));
  flights.push_back(flight_of(start, {{10.0, 0.0}}, Outcome::collide));
  flights.push_back(flight_of(start, {{500.0, 0.05}}, Outcome::trapped));
  const Picture picture = draw_flights(open_water(), flights, {.title = "counts"});
  EXPECT_TRUE(has_text(picture.svg, "reach (3)"));
  EXPECT_TRUE(has_text(picture.svg, "collide (1)"));
  EXPECT_TRUE(has_text(picture.svg, "trapped (1)"));
  EXPECT_TRUE(has_layer(picture.svg, "flights-reach"));
  EXPECT_TRUE(has_layer(picture.svg, "flights-collide"));
  EXPECT_FALSE(has_layer(picture.svg, "flights-leave"));
}

TEST(DrawFlights, PiecesInFurtherModesAreDashedOverTheFlightOnlyWhereThereAreAny) {
  const State start{{100.0, 100.0}, Heading()};
  std::vector<Flight> flights(3, flight_of(start, {{50.0, 0.0}, {40.0, 0.02}, {60.0, 0.0}}));
  const Picture plain = draw_flights(open_water(), flights, {});
  flights[1].segments[0].mode = 2;
  flights[1].segments[1].mode = 1;
  flights[2].segments[0].mode = 3;
  const Picture modal = draw_flights(open_water(), flights, {});
  EXPECT_TRUE(has_text(modal.svg, "in a further mode (2)"));
  EXPECT_TRUE(has_layer(modal.svg, "flights-reach-further-modes"));
  EXPECT_LT(modal.svg.find("\"flights-reach\""), modal.svg.find("\"flights-reach-further-modes\""));
  EXPECT_FALSE(has_layer(plain.svg, "flights-reach-further-modes"));
  EXPECT_FALSE(has_text(plain.svg, "in a further mode (2)"));
  // Over the first piece some pixels have the dashes' colour, over the last none has.
  const Plan plan = open_water();
  const FlightPictureOptions options{};
  const MapPage page(plan, {"", false, {}, options.frame_pt, options.pixels_per_pt}, {});
  const auto png = read_png(modal.png);
  const auto dashes = [&](const FlightSegment& piece) {
    int bright = 0;
    for (double along_m = 12.0; along_m < piece.length_m; along_m += 0.25) {
      const Vec2 at = page.frame().to_page(state_at(piece, along_m).position_m);
      const Color c = png.at(at.x * options.pixels_per_pt, at.y * options.pixels_per_pt);
      bright += c.green > 150 && c.blue < 120 ? 1 : 0;
    }
    return bright;
  };
  EXPECT_GT(dashes(flights[1].segments[0]), 10);
  EXPECT_EQ(dashes(flights[1].segments[2]), 0);
}

TEST(DrawFlights, TheProvedTubeLiesAboutThePathBelowTheFlights) {
  const std::vector<Flight> flights{flight_of({{100.0, 120.0}, Heading()}, {{100.0, 0.0}})};
  FollowProof proof;
  proof.path = {{{40.0, 120.0}, {280.0, 120.0}}, false, 1.0, 0.5};
  proof.tube.push_back({25.21F, 0.3F});
  FlightPictureOptions options{.mission = proof.path};
  EXPECT_FALSE(has_layer(draw_flights(open_water(), flights, options).svg, "tube"));
  options.follow = &proof;
  const Plan plan = open_water();
  const Picture picture = draw_flights(plan, flights, options);
  EXPECT_TRUE(has_layer(picture.svg, "tube"));
  EXPECT_TRUE(has_text(picture.svg, "proved tube (up to 25.3 m)"));
  EXPECT_LT(picture.svg.find("\"tube\""), picture.svg.find("\"flights-reach\""));
  const MapPage page(plan, {"", false, proof.path, options.frame_pt, options.pixels_per_pt}, {});
  const auto png = read_png(picture.png);
  const auto at = [&](Vec2 place) {
    const Vec2 p = page.frame().to_page(place);
    return png.at(p.x * options.pixels_per_pt, p.y * options.pixels_per_pt);
  };
  EXPECT_NE(at({230.0, 140.0}), palette::free);
  EXPECT_EQ(at({230.0, 150.0}), palette::free);
}

TEST(DrawFlights, FlightsThatCollideAfterReachingAreNotDrawnAsReaching) {
  const State start{{100.0, 100.0}, Heading()};
  std::vector<Flight> flights(4, flight_of(start, {{50.0, 0.0}}));
  flights[0].onward.after = After::follow;
  flights[1].onward.after = flights[2].onward.after = After::collide;
  flights[3].onward.after = After::leave;
  const Picture picture = draw_flights(open_water(), flights, {.title = "after"});
  EXPECT_TRUE(has_text(picture.svg, "reach (1)"));
  EXPECT_TRUE(has_text(picture.svg, "reach, then collide (2)"));
  EXPECT_TRUE(has_text(picture.svg, "reach, then leave (1)"));
  EXPECT_TRUE(has_layer(picture.svg, "flights-reach-collide"));
}

TEST(DrawFlights, OutcomesDifferByDashAsWellAsByColour) {
  const State start{{100.0, 100.0}, Heading()};
  std::set<std::string> colors;
  std::set<std::string> dashes;
  for (const Outcome outcome :
       {Outcome::reach, Outcome::collide, Outcome::leave, Outcome::trapped}) {
    const std::vector<Flight> one{flight_of(start, {{50.0, 0.0}}, outcome)};
    const Picture picture = draw_flights(open_water(), one, {});
    const auto drawn =
        testing::elements_of_layer(picture.svg, std::string("flights-") + name_of(outcome));
    ASSERT_GE(drawn.size(), 3U);
    const auto& line = drawn.front().attributes;
    colors.insert(line.at("stroke"));
    dashes.insert(line.contains("stroke-dasharray") ? line.at("stroke-dasharray") : "");
  }
  EXPECT_EQ(colors.size(), 4U);
  EXPECT_EQ(dashes.size(), 4U);
}

TEST(DrawFlights, RareOutcomesAreDrawnWhenThereAreTooManyToDrawAll) {
  const State start{{100.0, 100.0}, Heading()};
  std::vector<Flight> flights(500, flight_of(start, {{50.0, 0.0}}));
  flights.push_back(flight_of(start, {{10.0, 0.0}}, Outcome::collide));
  const Picture picture = draw_flights(open_water(), flights, {.most_drawn = 20});
  EXPECT_TRUE(has_text(picture.svg, "20 of 501 drawn"));
  EXPECT_TRUE(has_text(picture.svg, "reach (500)"));
  // 19 lines, and the ticks and dots of all
  EXPECT_EQ(testing::elements_of_layer(picture.svg, "flights-reach").size(), 21U);
  EXPECT_EQ(testing::elements_of_layer(picture.svg, "flights-collide").size(), 3U);
}

TEST(DrawFlights, NamesReplaceOutcomesAndEqualNamesShareAStyle) {
  const State start{{100.0, 100.0}, Heading()};
  const std::vector<Flight> flights(3, flight_of(start, {{50.0, 0.0}}));
  const Picture picture =
      draw_flights(open_water(), flights, {.names = {"sigma 2", "sigma 4", "sigma 2"}});
  EXPECT_TRUE(has_text(picture.svg, "sigma 2"));
  EXPECT_TRUE(has_layer(picture.svg, "flights-2"));
  EXPECT_FALSE(has_layer(picture.svg, "flights-3"));
  EXPECT_FALSE(has_text(picture.svg, "reach (3)"));
  EXPECT_THROW(static_cast<void>(draw_flights(open_water(), flights, {.names = {"one"}})),
               PreconditionViolation);
}

TEST(DrawFlights, FinalLegsHaveTheirOwnStrokesAndTheGoalsArrowOnTop) {
  std::vector<Flight> flights(4, flight_of({{100.0, 100.0}, Heading()}, {{50.0, 0.0}}));
  const std::array states{FinalLegState::shortest, FinalLegState::shortest, FinalLegState::other,
                          FinalLegState::none_clear};
  for (std::size_t i = 0; i < flights.size(); ++i) {
    FinalLeg& leg = flights[i].final_leg;
    leg.state = states[i];
    leg.entry = end_of(flights[i].segments.back());
    if (leg.state != FinalLegState::none_clear) leg.segments = {{leg.entry, 5.0, 30.0, 0.05}};
  }
  const Picture picture = draw_flights(open_water(), flights,
                                       {.mission = GoalMission{{165.0, 120.0}, 1.5}, .names = {}});
  EXPECT_TRUE(has_text(picture.svg, "last leg, shortest (2)"));
  EXPECT_TRUE(has_text(picture.svg, "last leg, other path (1)"));
  EXPECT_TRUE(has_text(picture.svg, "no clear last leg (1)"));
  EXPECT_EQ(testing::elements_of_layer(picture.svg, "final-legs-shortest").size(), 2U);
  const auto other = testing::elements_of_layer(picture.svg, "final-legs-other");
  ASSERT_EQ(other.size(), 1U);
  EXPECT_TRUE(other.front().attributes.contains("stroke-dasharray"));
  EXPECT_LT(picture.svg.find("final-legs-shortest"), picture.svg.find("id=\"mission\""));
  const Picture without = draw_flights(open_water(), std::vector{flight_of({}, {{5.0, 0.0}})}, {});
  EXPECT_EQ(without.svg.find("final-legs"), std::string::npos);
}

TEST(DrawFlights, NoFlightsUnrecordedFlightsAndAnEmptyPlanGivePictures) {
  EXPECT_TRUE(has_layer(draw_flights(open_water(), {}, {}).svg, "axes"));
  const std::vector<Flight> bare(2, Flight{{{1.0, 1.0}, Heading()}, {}, {}});
  EXPECT_TRUE(has_text(draw_flights(open_water(), bare, {}).svg, "trapped (2)"));
  EXPECT_TRUE(has_layer(draw_flights(Plan{}, bare, {}).svg, "axes"));
}

}  // namespace
}  // namespace fairway
