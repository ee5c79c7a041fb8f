// What exact flights keep while they fly: a watch for states that repeat, and the record.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "fairway/simulate/exact_flight.hpp"

namespace fairway {

/// Brent's cycle detection: the flight is compared with one kept state, replaced after 2, 4, 8, ...
/// crossings. A closed curve of curvature at most 1 / r is at least 2 pi r long (Fenchel), which
/// keeps the tiny hops of a weave along a border from passing for a cycle.
class ExactFlights::CycleWatch {
 public:
  CycleWatch(double cell_m, double turn_radius_m)
      : position_tolerance_m_(1e-9 * cell_m), shortest_m_(6.28 * turn_radius_m) {}

  bool repeats(const Position& now, double flown_m) {
    const Vec2 moved = now.state.position_m - kept_.state.position_m;
    if (now.place == kept_.place && flown_m - kept_at_m_ >= shortest_m_ &&
        std::abs(moved.x) <= position_tolerance_m_ && std::abs(moved.y) <= position_tolerance_m_ &&
        norm2(now.state.heading.unit - kept_.state.heading.unit) <= 1e-18) {
      return true;
    }
    if (--left_ == 0) {
      period_ *= 2;
      left_ = period_;
      kept_ = now;
      kept_at_m_ = flown_m;
    }
    return false;
  }

 private:
  double position_tolerance_m_;
  double shortest_m_;
  Position kept_;
  double kept_at_m_ = std::numeric_limits<double>::infinity();
  std::uint64_t period_ = 1;
  std::uint64_t left_ = 1;
};

/// Nothing is kept.
struct ExactFlights::NoRecord {
  void set_mode(int) {}
  void end_at(double) {}
  void add(const Position&, const CellExit&, double) {}
  void add_leap(const Position&, double, double) {}
};

/// How much a flight turns and, when pieces are kept, the pieces: of the same curvature, end to
/// end, though cells cut them.
class ExactFlights::Recorder {
 public:
  Recorder(const ExactFlights& flights, bool keeps_pieces)
      : flights_(flights), keeps_pieces_(keeps_pieces) {}

  /// The mode of what is added from now on.
  void set_mode(int mode) { mode_ = mode; }
  /// What is flown beyond that length is not recorded.
  void end_at(double until_m) { until_m_ = until_m; }

  void add(const Position& from, const CellExit& exit, double flown_m) {
    const Vec2 corner = flights_.corner_of(from.place);
    const double curvature = exit.turn / flights_.vehicle_.turn_radius_m;
    append(corner + from.state.position_m, from.state.heading, curvature, exit.arc_m, flown_m);
    append(corner + exit.arc_end_m, exit.state.heading, 0.0, exit.straight_m, flown_m + exit.arc_m);
  }
  /// A weave too fine to draw, as a straight line along its border.
  void add_leap(const Position& from, double length_m, double flown_m) {
    const Vec2 u = from.state.heading.unit;
    const double along_rad =
        std::abs(u.x) > std::abs(u.y) ? (u.x > 0.0 ? 0.0 : pi) : (u.y > 0.0 ? pi / 2 : -pi / 2);
    const Direction along{{}, along_rad};
    append(flights_.corner_of(from.place) + from.state.position_m, along, 0.0, length_m, flown_m);
  }
  std::vector<FlightSegment> take_pieces() { return std::move(segments_); }
  const Turning& turning() const { return turning_; }

 private:
  void append(Vec2 p, const Direction& heading, double curvature, double length_m, double flown_m) {
    length_m = std::min(length_m, until_m_ - flown_m);
    if (!(length_m > 0.0)) return;
    turning_.add(curvature * length_m, length_m);
    if (!keeps_pieces_) return;
    if (!segments_.empty() && segments_.back().curvature_per_m == curvature &&
        segments_.back().mode == mode_) {
      segments_.back().length_m += length_m;
      return;
    }
    segments_.push_back({{p, Heading::from_rad(heading.rad)},
                         flown_m / flights_.vehicle_.speed_mps,
                         length_m,
                         curvature,
                         mode_});
  }

  const ExactFlights& flights_;
  bool keeps_pieces_;
  int mode_ = 0;
  double until_m_ = std::numeric_limits<double>::infinity();
  Turning turning_;
  std::vector<FlightSegment> segments_;
};

}  // namespace fairway
