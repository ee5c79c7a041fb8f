// Exact flights under a plan: cell by cell, event by event, no time stepping, for the bang-bang law
// (docs/model.md; vehicle/cell_motion.hpp flies one cell).
//
// Conventions where the model leaves a choice (on such ties a claim must hold for both):
//   - exactly opposite heading: left;
//   - heading along a border: stay in the cell flown so far (at a start: the cell on the left); if
//     its command turns out of it, the other cell; if that one turns back, straight along the
//     border.
//   - contact with an obstacle at the very point where a goal cell is entered or the grid is left:
//     collide. A flight along a goal cell's border reaches.
// Properties that always hold:
//   1. A result depends on the plan and the start alone, never on threads or on other flights.
//   2. time_s = length_m / speed; both +inf when trapped.
// Cost (measured, bench/flight_bench.cpp, one core): 25 to 35 ns a cell on plans of up to 1024^2
// cells, 47 ns on 4096^2, where memory bounds it; 24 bytes a cell while the object lives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/cell_motion.hpp"

namespace fairway {

/// 0 stands for the default.
struct FlightLimits {
  double length_m = 0.0;        ///< default: 4 nx ny cell_m + 1000 turning circles
  std::uint64_t crossings = 0;  ///< default: 64 (length limit / cell_m)
};

/// What ended a flight. A repeating state proves trapped but for rounding; a limit only suggests
/// it.
enum class EndedBy : std::uint8_t {
  goal,
  obstacle,
  grid_edge,
  repeating_state,
  length_limit,
  crossing_limit
};

struct FlightRun {
  FlightResult result;
  EndedBy ended_by = EndedBy::goal;
  std::uint64_t crossings = 0;  ///< cells flown through one by one (not those of a leap, see .cpp)
  double flown_m = 0.0;         ///< finite, also when trapped
  /// Where the first of the goal cells was entered that did not end the flight; +inf: none.
  double reached_m = std::numeric_limits<double>::infinity();
};

class ExactFlights {
 public:
  /// Keeps nothing of `plan`. Throws PreconditionViolation when the cell is not smaller than the
  /// turning radius, a number is not finite, or the arrays do not fit the grid.
  explicit ExactFlights(const Plan& plan) : ExactFlights(plan, 0) {}

  /// By the commands of one of its modes (docs/modes.md), without changes to others.
  ExactFlights(const Plan& plan, int mode);

  /// Throws PreconditionViolation when `start` is not finite.
  [[nodiscard]] FlightResult fly(const State& start, FlightLimits limits = {}) const;

  /// The same, with what it took.
  [[nodiscard]] FlightRun run(const State& start, FlightLimits limits = {}) const;

  /// The same with its pieces, arcs and straight lines joined over cells. A weave of many hops
  /// along one border, never farther from it than r / 8000, is one straight piece. A trapped
  /// flight's pieces end where the trap was recognised.
  [[nodiscard]] Flight record(const State& start, FlightLimits limits = {}) const;

  /// The same without its pieces: result and turning.
  [[nodiscard]] Flight measure(const State& start, FlightLimits limits = {}) const;

  /// For path missions: goal cells do not end the flight. It continues until `length_m` are flown,
  /// or to an obstacle, the grid's edge or a trap before the first goal cell. The result is the
  /// usual outcome (reach: at the first goal cell); the pieces continue.
  [[nodiscard]] Flight follow(const State& start, double length_m) const;

  /// The same until `beyond` the first goal cell. The result is that of `fly`, to the bit, and so
  /// are the pieces up to there those of `record`. Throws PreconditionViolation unless a limit is
  /// finite and both are > 0.
  [[nodiscard]] Flight follow_on(const State& start, const FollowLimit& beyond) const;

  /// In parallel; result [i] belongs to start [i].
  [[nodiscard]] std::vector<FlightResult> fly_all(std::span<const State> starts,
                                                  FlightLimits limits = {}) const;
  [[nodiscard]] std::vector<FlightRun> run_all(std::span<const State> starts,
                                               FlightLimits limits = {}) const;
  [[nodiscard]] std::vector<Flight> record_all(std::span<const State> starts,
                                               FlightLimits limits = {}) const;

  const Grid& grid() const { return grid_; }
  const Vehicle& vehicle() const { return vehicle_; }

 private:
  friend class ModalFlights;
  enum class Kind : std::uint8_t { open, goal, obstacle, outside };
  struct CellRecord {
    Vec2 unit;  // of the command; (0, 0): none
    float rad;  // NaN: none
    Kind kind;
  };
  struct Position {
    std::size_t place = 0;  // of a cell in the padded table
    CellState state;        // in the cell's own coordinates
    bool slides = false;    // straight along a border whose two cells turn towards it
  };
  struct Leap {
    double along_m = 0.0;  // over a border
    double flown_m = 0.0;
  };
  class CycleWatch;
  class Recorder;
  struct NoRecord;
  struct OneMode;

  const CellRecord& at(std::size_t place) const { return cells_[place]; }
  Direction command_at(std::size_t place) const {
    return {cells_[place].unit, static_cast<double>(cells_[place].rad)};
  }
  Vec2 corner_of(std::size_t place) const;
  Position locate(const State& start) const;
  Kind settle(Position& position, bool at_start) const;
  void choose_side(Position& position, std::ptrdiff_t beside, bool at_start) const;
  void prefetch_ahead(const Position& position) const;
  Kind enter_next(Position& position, const CellExit& exit) const;
  bool is_hop(const Position& from, const CellExit& exit) const;
  Leap leap(Position& position, Side border, double most_m) const;
  FlightLimits with_defaults(FlightLimits limits) const;
  FlightLimits beyond_goal(FlightLimits limits, const FlightRun& run, double beyond_m) const;
  FlightResult result_of(const FlightRun& run) const;
  Onward onward_of(const FlightRun& run) const;
  Flight recorded(const State& start, FlightLimits limits, bool keeps_pieces) const;
  Flight followed(const State& start, FlightLimits limits, double beyond_m) const;
  template <bool passes_goals, typename Record, typename Modes>
  FlightRun fly_through(const State& start, FlightLimits limits, double beyond_m, Record& record,
                        Modes& modes) const;
  template <bool passes_goals, typename Record, typename Modes>
  FlightRun fly_on(Position position, Kind kind, FlightLimits limits, double beyond_m,
                   Record& record, Modes& modes) const;

  Grid grid_;
  Vehicle vehicle_;
  std::size_t stride_;             // of the padded table
  std::vector<CellRecord> cells_;  // [ny + 2][nx + 2], a ring of `outside` around the grid
};

}  // namespace fairway
