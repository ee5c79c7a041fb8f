// Exact flights under a plan with modes (docs/modes.md): cell by cell, as exact_flight.hpp flies,
// and at every border that it crosses the vehicle may change to an earlier mode. Who decides that
// is passed in.
//
// Properties that always hold:
//   1. Those of exact flights; a change of modes moves nothing, to the bit.
//   2. Modes only go down. In mode 0 nobody is asked any more, and the rest of the flight is that
//      of ExactFlights.
//   3. A flight that begins in mode 0 is that of ExactFlights, to the bit.
// Conventions: a weave over one border, of hops too fine to be flown one by one, is a leap, as in
// exact flights, but goes no farther than the decider allows, and nobody is asked on the way.
// Beyond the first goal cell the vehicle flies mode 0.
// Cost: that of exact flights and of the questions; 24 bytes a cell and mode while the object
// lives.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/side.hpp"

namespace fairway {

/// The vehicle crosses a border, from an open cell into an open cell.
struct BorderCrossing {
  State state;
  Cell left;
  Side side = Side::right;  ///< of that cell
  double along_m = 0.0;     ///< place along that side, from its lower or left end
  bool aligned = false;     ///< the heading is the command of the cell left, but for rounding
};

/// Who decides which mode is flown. One for each flight at a time.
class ModeDecider {
 public:
  ModeDecider() = default;
  ModeDecider(const ModeDecider&) = default;
  ModeDecider& operator=(const ModeDecider&) = default;
  virtual ~ModeDecider() = default;
  /// The mode that a flight begins in.
  virtual int begin(const State& start) = 0;
  /// The mode to fly from here: `mode`, the present one and not 0, or an earlier one.
  virtual int at_border(const BorderCrossing& crossing, int mode) = 0;
  /// How far along this border the vehicle may weave in `mode`, not 0, without being asked again. A
  /// fine weave can cross a border a million times.
  virtual double weaves_m(const BorderCrossing& crossing, int mode) = 0;
};

/// After that many borders in the mode before, not counting those of a leap, another one.
struct ModeChange {
  std::uint64_t borders = 0;
  int mode = 0;
  friend bool operator==(const ModeChange&, const ModeChange&) = default;
};

/// The modes of one flight.
struct ModeSequence {
  int begin = 0;
  std::vector<ModeChange> changes;
  friend bool operator==(const ModeSequence&, const ModeSequence&) = default;
};

struct ModalRun {
  FlightRun run;
  int changes = 0;
  int last_mode = 0;  ///< the one that the flight ended in
};

class ModalFlights {
 public:
  /// Keeps nothing of `plan`. Throws PreconditionViolation as ExactFlights does.
  explicit ModalFlights(const Plan& plan);

  int modes() const { return static_cast<int>(modes_.size()); }
  /// Flights in one mode, without changes.
  const ExactFlights& mode(int k) const { return modes_[static_cast<std::size_t>(k)]; }

  /// Throws PreconditionViolation when `start` is not finite, or `decider` names no mode of the
  /// plan or a later one than the present.
  [[nodiscard]] ModalRun run(const State& start, ModeDecider& decider,
                             FlightLimits limits = {}) const;

  /// The same with its pieces, each in one mode.
  [[nodiscard]] Flight record(const State& start, ModeDecider& decider,
                              FlightLimits limits = {}) const;

  /// The same without its pieces: result and turning.
  [[nodiscard]] Flight measure(const State& start, ModeDecider& decider,
                               FlightLimits limits = {}) const;

  /// As ExactFlights::follow_on.
  [[nodiscard]] Flight follow_on(const State& start, ModeDecider& decider,
                                 const FollowLimit& beyond) const;

  /// Modes that bring the state to a goal cell, found by trying. Mode 0 if it does; else the first
  /// mode that does, without a change or with one, at its first border from where an earlier mode
  /// does, and to the first such mode; else with two changes, and then with three, tried at places
  /// a turning radius apart. Mode 0 when that finds none, or when the trials together have crossed
  /// `most_crossings` cells, the flight in mode 0 not counted: so the work is bounded, at the price
  /// of flights that a proof would find.
  [[nodiscard]] ModeSequence find_modes(const State& start,
                                        std::uint64_t most_crossings = 200000) const;

 private:
  using Position = ExactFlights::Position;
  class Decided;
  class Search;

  Flight recorded(const State& start, ModeDecider& decider, FlightLimits limits,
                  bool keeps_pieces) const;

  std::vector<ExactFlights> modes_;
};

/// Flies a sequence of modes: for what find_modes() found.
class GivenModes final : public ModeDecider {
 public:
  /// `sequence` must outlive this.
  explicit GivenModes(const ModeSequence& sequence) : sequence_(sequence) {}
  int begin(const State& start) override;
  int at_border(const BorderCrossing& crossing, int mode) override;
  double weaves_m(const BorderCrossing& crossing, int mode) override;

 private:
  const ModeSequence& sequence_;
  std::size_t done_ = 0;       // changes
  std::uint64_t borders_ = 0;  // since the last one
};

}  // namespace fairway
