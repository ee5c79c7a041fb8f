#include "check/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway_check {
namespace {

using fairway::Random;
using fairway::Wide;

/// Keeps what it is told.
struct Told : Listener {
  struct Arrival {
    std::size_t section;
    Real place;
    double length;
  };
  std::vector<Arrival> arrivals;
  std::vector<std::pair<Verdict, double>> ends;
  bool lost = false;

  void arrive(std::size_t section, const Real& place, double length, bool) override {
    arrivals.push_back({section, place, length});
  }
  void end(Verdict verdict, double length) override { ends.emplace_back(verdict, length); }
  void give_up() override { lost = true; }

  /// `meeting` in metres, of cells of `cell_m`.
  bool knows_of(const fairway::WideMeeting<Wide>& meeting, double cell_m) const {
    const long double length = meeting.length_m / cell_m * (1.0L - 1e-12L);
    for (const auto& [verdict, bound] : ends) {
      if (static_cast<int>(verdict) == static_cast<int>(meeting.end) &&
          (verdict == trapped || bound >= length))
        return true;
    }
    const std::size_t side = meeting.section % 4;
    const Wide off(1e-28);
    const Wide along = meeting.along_m / Wide(cell_m) - Wide(0.5);
    const Wide place = side == 1 || side == 2 ? Wide(-along) : along;
    for (const Arrival& a : arrivals) {
      if (a.section == meeting.section && Wide(a.place.lower()) - off <= place &&
          place <= Wide(a.place.upper()) + off && a.length >= length) {
        return true;
      }
    }
    return false;
  }
};

Loop loop_of(const fairway::Flow& flow) {
  Loop loop;
  loop.nx = flow.grid.nx;
  loop.ny = flow.grid.ny;
  loop.command_rad.assign(flow.heading_rad, flow.heading_rad + flow.grid.size());
  for (std::size_t i = 0; i < flow.grid.size(); ++i) {
    loop.kind.push_back(static_cast<std::uint8_t>(flow.kind[i]));
  }
  loop.take_directions(flow.vehicle.turn_radius_m, flow.grid.cell_m);
  return loop;
}

TEST(CheckFlight, EveryFlightFromALeafMeetsWhatWasTold) {
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
        if (place == 0.0 || place == 1.0) continue;  // a corner: whoever brings it is told of it
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
