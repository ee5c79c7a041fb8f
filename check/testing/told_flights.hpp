// For tests: records what is reported for a followed set, and compares exact flights with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "check/flight.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway_check {

using fairway::Wide;

/// A visitor that records what is reported.
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

  /// `meeting` in metres, with cells of `cell_m`.
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

inline Loop loop_of(const fairway::Flow& flow) {
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

}  // namespace fairway_check
