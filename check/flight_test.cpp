#include "check/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "check/testing/told_flights.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway_check {
namespace {

using fairway::Random;
using fairway::Wide;

TEST(CheckFlight, EveryFlightFromALeafMeetsWhatWasReported) {
  int flights = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const fairway::Plan plan = fairway::random_plan(seed);
    const fairway::PlanFlow owner(plan);
    const fairway::Flow flow = owner.flow();
    const Loop loop = loop_of(flow);
    const fairway::WideCommands<Wide> commands(flow);
    Random random = Random::stream(3, seed);
    for (int draw = 0; draw < 200; ++draw) {
      const std::size_t section = random.below(4 * flow.grid.size());
      const int side = static_cast<int>(section % 4);
      const std::size_t cell = section / 4;
      if (flow.kind[cell] != fairway::CellKind::ordinary || std::isnan(flow.heading_rad[cell]) ||
          loop.kind_at(loop.beyond(section)) != ordinary ||
          !positive(into_frame(side, loop.direction[cell]).x)) {
        continue;
      }
      // Ends of leaves are dyadic, the side's own among them.
      const double width = std::ldexp(1.0, -static_cast<int>(random.below(20)));
      const double begin = std::floor(random.unit() / width) * width;
      Told told;
      {
        const Upwards upwards;
        const Real along(begin - 0.5, begin + width - 0.5);
        follow_section(loop, section, side == 1 || side == 2 ? -along : along, told);
      }
      if (told.lost) continue;
      for (int m = 0; m < 5; ++m) {
        const double place = begin + width * (m == 0 ? 0.0 : m == 1 ? 1.0 : random.unit());
        if (place == 0.0 || place == 1.0) continue;  // a corner: reported where it came from
        const Wide along_m = Wide(place) * Wide(flow.grid.cell_m);
        const Wide line = side < 2 ? Wide(0) : Wide(flow.grid.cell_m);
        const fairway::WideVec<Wide> p = side % 2 == 0 ? fairway::WideVec<Wide>{line, along_m}
                                                       : fairway::WideVec<Wide>{along_m, line};
        fairway::WideFlight<Wide> flight(commands, loop.beyond(section).x, loop.beyond(section).y,
                                         p, commands.unit[cell],
                                         [&random](std::size_t n) { return random.below(n); });
        const auto meeting = flight.fly(3000);
        if (meeting.section == fairway::WideMeeting<Wide>::none &&
            meeting.end == fairway::Verdict::undecided)
          continue;
        ++flights;
        ASSERT_TRUE(told.knows_of(meeting, flow.grid.cell_m))
            << "plan " << seed << " section " << section << " from " << begin << " width " << width
            << " place " << place << " meets section " << meeting.section << " or ends with "
            << name_of(meeting.end);
      }
    }
  }
  EXPECT_GT(flights, 10000);
}

}  // namespace
}  // namespace fairway_check
