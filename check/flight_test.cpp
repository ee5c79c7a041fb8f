#include "check/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "check/testing/plans_with_modes.hpp"
#include "check/testing/told_flights.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway_check {
namespace {

using fairway::Random;
using fairway::Wide;

/// Follows sets that leave cells with the commands of `from`, by those of `flown`: a mode of its
/// own, or the same. Flights from places in them, in 237 bits, must meet what was reported; returns
/// how many did.
int fly_from_sections(const fairway::Flow& from, const fairway::Flow& flown, Random& random) {
  const bool hands_over = from.heading_rad != flown.heading_rad;
  const Loop loop = loop_of(flown);
  const Loop before = loop_of(from);
  const fairway::WideCommands<Wide> commands(flown);
  const fairway::WideCommands<Wide> last(from);
  int flights = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const std::size_t section = random.below(4 * from.grid.size());
    const int side = static_cast<int>(section % 4);
    const std::size_t cell = section / 4;
    if (from.kind[cell] != fairway::CellKind::ordinary || std::isnan(from.heading_rad[cell]) ||
        loop.kind_at(loop.beyond(section)) != ordinary ||
        !positive(into_frame(side, before.direction[cell]).x)) {
      continue;
    }
    // Ends of leaves are dyadic, the side's own among them.
    const double width = std::ldexp(1.0, -static_cast<int>(random.below(20)));
    const double begin = std::floor(random.unit() / width) * width;
    Told told;
    {
      const Upwards upwards;
      const Real along(begin - 0.5, begin + width - 0.5);
      const Real place = side == 1 || side == 2 ? -along : along;
      if (hands_over) {
        follow_handed_over(before, loop, section, place, told);
      } else {
        follow_section(loop, section, place, told);
      }
    }
    if (told.lost) continue;
    for (int m = 0; m < 5; ++m) {
      const double place = begin + width * (m == 0 ? 0.0 : m == 1 ? 1.0 : random.unit());
      if (place == 0.0 || place == 1.0) continue;  // a corner: reported where it came from
      const Wide along_m = Wide(place) * Wide(from.grid.cell_m);
      const Wide line = side < 2 ? Wide(0) : Wide(from.grid.cell_m);
      const fairway::WideVec<Wide> p = side % 2 == 0 ? fairway::WideVec<Wide>{line, along_m}
                                                     : fairway::WideVec<Wide>{along_m, line};
      fairway::WideFlight<Wide> flight(commands, loop.beyond(section).x, loop.beyond(section).y, p,
                                       last.unit[cell],
                                       [&random](std::size_t n) { return random.below(n); });
      const auto meeting = flight.fly(3000);
      if (meeting.section == fairway::WideMeeting<Wide>::none &&
          meeting.end == fairway::Verdict::undecided) {
        continue;
      }
      ++flights;
      EXPECT_TRUE(told.knows_of(meeting, from.grid.cell_m))
          << "section " << section << " from " << begin << " width " << width << " place " << place
          << " meets section " << meeting.section << " or ends with " << name_of(meeting.end);
    }
  }
  return flights;
}

TEST(CheckFlight, EveryFlightFromALeafMeetsWhatWasReported) {
  int flights = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const fairway::Plan plan = fairway::random_plan(seed);
    const fairway::PlanFlow owner(plan);
    Random random = Random::stream(3, seed);
    flights += fly_from_sections(owner.flow(), owner.flow(), random);
  }
  EXPECT_GT(flights, 10000);
}

TEST(CheckFlight, EveryFlightHandedOverFromALeafMeetsWhatWasReported) {
  int flights = 0;
  for (std::uint64_t seed = 0; seed < 24 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    fairway::Plan plan = fairway::random_plan(seed);
    add_odd_modes(plan, seed);
    const fairway::PlanFlow owner(plan);
    Random random = Random::stream(4, seed);
    for (const float* further_rad : plan.further_rad()) {
      fairway::Flow mode = owner.flow();
      mode.heading_rad = further_rad;
      flights += fly_from_sections(mode, owner.flow(), random);
      flights += fly_from_sections(owner.flow(), mode, random);
    }
  }
  EXPECT_GT(flights, 10000);
}

}  // namespace
}  // namespace fairway_check
