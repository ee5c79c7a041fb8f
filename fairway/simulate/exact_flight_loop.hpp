// The flight itself, from border to border: for exact_flight.cpp, and for modal_flight.cpp, which
// changes modes on the way. Included by these two alone.
//
// What flies has one mode, or several. `Modes` tells:
//     static constexpr bool may_change
// and if so
//     double weaves_m(const ExactFlights* now, const Position& from, const CellExit&,
//                     const Position& position)
//                                       how far along the border it may weave in one leap
//     const ExactFlights* at_border(const ExactFlights* now, const Position& from, const CellExit&,
//                                   const Position& position, const FlightRun& run)
//                                       whose commands to fly from here; null: end the flight here
//     const ExactFlights* at_goal()     whose commands to fly beyond the first goal cell
//     int mode() const                  the number of what was last returned
#pragma once

#include <cstdint>
#include <limits>

#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/exact_flight_record.hpp"

namespace fairway {

struct ExactFlights::OneMode {
  static constexpr bool may_change = false;
  static int mode() { return 0; }
};

template <bool passes_goals, typename Record, typename Modes>
FlightRun ExactFlights::fly_through(const State& start, FlightLimits limits, double beyond_m,
                                    Record& record, Modes& modes) const {
  Position position = locate(start);
  const Kind kind = settle(position, true);
  return fly_on<passes_goals>(position, kind, limits, beyond_m, record, modes);
}

template <bool passes_goals, typename Record, typename Modes>
FlightRun ExactFlights::fly_on(Position position, Kind kind, FlightLimits limits, double beyond_m,
                               Record& record, Modes& modes) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  const CellShape shape{grid_.cell_m, vehicle_.turn_radius_m};
  CycleWatch watch(shape.cell_m, shape.turn_radius_m);
  FlightRun run;
  int hops = 0;
  const ExactFlights* commands = this;
  [[maybe_unused]] const auto change_to = [&](const ExactFlights* next) {
    commands = next;
    record.set_mode(modes.mode());
    watch = CycleWatch(shape.cell_m, shape.turn_radius_m);
    hops = 0;
    kind = commands->settle(position, false);  // along a border, the side depends on commands
  };
  for (;;) {
    if (passes_goals && kind == Kind::goal) {
      if (run.reached_m == never) {
        run.reached_m = run.flown_m;
        limits = beyond_goal(limits, run, beyond_m);
        record.end_at(limits.length_m);
        if constexpr (passes_goals && Modes::may_change) {
          if (modes.mode() != 0) change_to(modes.at_goal());
        }
      }
    } else if (kind != Kind::open) {
      run.ended_by = kind == Kind::goal       ? EndedBy::goal
                     : kind == Kind::obstacle ? EndedBy::obstacle
                                              : EndedBy::grid_edge;
      break;
    }
    if (run.flown_m >= limits.length_m) {
      run.ended_by = EndedBy::length_limit;
      break;
    }
    if (run.crossings >= limits.crossings) {
      run.ended_by = EndedBy::crossing_limit;
      break;
    }
    if ((!passes_goals || run.reached_m == never) && watch.repeats(position, run.flown_m)) {
      run.ended_by = EndedBy::repeating_state;
      break;
    }
    const Direction command =
        position.slides ? Direction::none() : commands->command_at(position.place);
    const CellExit exit = cross_cell(position.state, command, shape);
    record.add(position, exit, run.flown_m);
    run.flown_m += exit.length_m();
    ++run.crossings;
    hops = is_hop(position, exit) ? hops + 1 : 0;
    [[maybe_unused]] Position from;
    if constexpr (Modes::may_change) from = position;
    kind = commands->enter_next(position, exit);
    if constexpr (Modes::may_change) {
      if (kind == Kind::open) {
        const ExactFlights* next = modes.at_border(commands, from, exit, position, run);
        if (next == nullptr) break;
        if (next != commands) change_to(next);
      }
    }
    if (hops >= 2) [[unlikely]] {
      double most_m = never;
      if constexpr (Modes::may_change) most_m = modes.weaves_m(commands, from, exit, position);
      const Position before = position;
      const Leap leapt = leap(position, exit.side, most_m);
      if (leapt.flown_m > 0.0) {
        record.add_leap(before, leapt.along_m, run.flown_m);
        run.flown_m += leapt.flown_m;
        hops = 0;
        kind = commands->settle(position, false);
      }
    }
  }
  if (passes_goals && run.flown_m > limits.length_m) {  // what it met lies beyond what was asked
    run.ended_by = EndedBy::length_limit;
    run.flown_m = limits.length_m;
  }
  run.result = result_of(run);
  return run;
}

}  // namespace fairway
