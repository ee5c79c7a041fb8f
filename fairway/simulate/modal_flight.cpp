#include "fairway/simulate/modal_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/simulate/exact_flight_loop.hpp"
#include "fairway/simulate/exact_flight_record.hpp"

namespace fairway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Rounding moves a heading by less, on its way back to a border over which it weaves.
constexpr double aligned_within = 1e-12;

}  // namespace

/// Asks a decider (exact_flight_loop.hpp, `Modes`).
class ModalFlights::Decided {
 public:
  static constexpr bool may_change = true;

  Decided(const ModalFlights& flights, ModeDecider& decider, const State& start)
      : flights_(flights), decider_(decider), mode_(decider.begin(start)) {
    require(mode_ >= 0 && mode_ < flights.modes(), "a flight begins in a mode of the plan");
  }

  double weaves_m(const ExactFlights* now, const Position& from, const CellExit& exit,
                  const Position& position) {
    if (mode_ == 0) return infinity;
    return decider_.weaves_m(crossing(*now, from, exit, position), mode_);
  }
  const ExactFlights* at_border(const ExactFlights* now, const Position& from, const CellExit& exit,
                                const Position& position, const FlightRun&) {
    if (mode_ == 0) return now;
    const int next = decider_.at_border(crossing(*now, from, exit, position), mode_);
    require(next >= 0 && next <= mode_, "modes only go down");
    if (next == mode_) return now;
    ++changes_;
    return go_to(next);
  }
  const ExactFlights* at_goal() {
    ++changes_;
    return go_to(0);
  }
  int mode() const { return mode_; }
  int changes() const { return changes_; }

 private:
  const ExactFlights* go_to(int mode) {
    mode_ = mode;
    return &flights_.mode(mode);
  }
  static BorderCrossing crossing(const ExactFlights& now, const Position& from,
                                 const CellExit& exit, const Position& position) {
    const Direction& heading = exit.state.heading;
    const Direction command = now.command_at(from.place);
    const bool vertical = exit.side == Side::right || exit.side == Side::left;
    return {
        {now.corner_of(position.place) + position.state.position_m, Heading::from_rad(heading.rad)},
        {static_cast<int>(from.place % now.stride_) - 1,
         static_cast<int>(from.place / now.stride_) - 1},
        exit.side,
        vertical ? exit.state.position_m.y : exit.state.position_m.x,
        std::abs(cross(heading.unit, command.unit)) <= aligned_within &&
            dot(heading.unit, command.unit) > 0.0};
  }

  const ModalFlights& flights_;
  ModeDecider& decider_;
  int mode_;
  int changes_ = 0;
};

ModalFlights::ModalFlights(const Plan& plan) {
  modes_.reserve(plan.further_modes() + 1);
  for (int k = 0; k <= static_cast<int>(plan.further_modes()); ++k) modes_.emplace_back(plan, k);
}

ModalRun ModalFlights::run(const State& start, ModeDecider& decider, FlightLimits limits) const {
  Decided modes(*this, decider, start);
  const ExactFlights& first = mode(modes.mode());
  const int begin = modes.mode();
  ExactFlights::NoRecord nothing;
  ModalRun flown;
  flown.run =
      first.fly_through<false>(start, first.with_defaults(limits), infinity, nothing, modes);
  flown.run.result.mode = begin;
  flown.changes = modes.changes();
  flown.last_mode = modes.mode();
  return flown;
}

Flight ModalFlights::recorded(const State& start, ModeDecider& decider, FlightLimits limits,
                              bool keeps_pieces) const {
  Decided modes(*this, decider, start);
  const int begin = modes.mode();
  const ExactFlights& first = mode(begin);
  ExactFlights::Recorder recorder(first, keeps_pieces);
  recorder.set_mode(begin);
  FlightRun run =
      first.fly_through<false>(start, first.with_defaults(limits), infinity, recorder, modes);
  run.result.mode = begin;
  return {start, run.result, recorder.take_pieces(), {}, recorder.turning(), {}};
}

Flight ModalFlights::record(const State& start, ModeDecider& decider, FlightLimits limits) const {
  return recorded(start, decider, limits, true);
}

Flight ModalFlights::measure(const State& start, ModeDecider& decider, FlightLimits limits) const {
  return recorded(start, decider, limits, false);
}

Flight ModalFlights::follow_on(const State& start, ModeDecider& decider,
                               const FollowLimit& beyond) const {
  const double beyond_m = std::min(beyond.length_m, beyond.time_s * mode(0).vehicle().speed_mps);
  require(beyond_m > 0.0 && std::isfinite(beyond_m), "a flight is followed for a length > 0");
  Decided modes(*this, decider, start);
  const int begin = modes.mode();
  const ExactFlights& first = mode(begin);
  ExactFlights::Recorder recorder(first, true);
  recorder.set_mode(begin);
  FlightRun run =
      first.fly_through<true>(start, first.with_defaults({}), beyond_m, recorder, modes);
  run.result.mode = begin;
  return {start, run.result, recorder.take_pieces(), {}, recorder.turning(), first.onward_of(run)};
}

/// Trials of one start. A trial flies as the flight will, from the same numbers, so what arrives
/// here arrives there.
class ModalFlights::Search {
 public:
  Search(const ModalFlights& flights, std::uint64_t most_crossings)
      : flights_(flights), left_(most_crossings) {}

  ModeSequence find(const State& start) {
    const FlightRun alone = flights_.mode(0).run(start);
    if (alone.ended_by == EndedBy::goal) return {};
    constexpr int most_changes = 3;
    for (int changes = 1; changes <= std::min(most_changes, flights_.modes() - 1); ++changes) {
      apart_m_ = changes == 1 ? 0.0 : flights_.mode(0).vehicle().turn_radius_m;
      for (int k = changes; k < flights_.modes() && left_ > 0; ++k) {
        Position position = flights_.mode(k).locate(start);
        const auto kind = flights_.mode(k).settle(position, true);
        ModeSequence found{k, {}};
        if (arrives(k, position, kind, changes, found.changes)) {
          std::reverse(found.changes.begin(), found.changes.end());
          return found;
        }
      }
    }
    return {};
  }

 private:
  /// What a flight in a further mode tries at its borders (exact_flight_loop.hpp, `Modes`).
  struct Trial {
    static constexpr bool may_change = true;
    Search& search;
    int number;
    int changes;                     // still allowed
    std::vector<ModeChange>& found;  // the last first
    bool arrived = false;
    bool given_up = false;
    double tried_at_m = -infinity;

    double weaves_m(const ExactFlights*, const Position&, const CellExit&, const Position&) const {
      return infinity;
    }
    int mode() const { return number; }
    const ExactFlights* at_border(const ExactFlights* now, const Position&, const CellExit&,
                                  const Position& position, const FlightRun& run) {
      if (changes == 0) return now;
      if (run.flown_m - tried_at_m < search.apart_m_) return now;
      tried_at_m = run.flown_m;
      // Fewer changes have been tried before.
      for (int earlier = changes - 1; earlier < number; ++earlier) {
        Position here = position;
        const auto kind = search.flights_.mode(earlier).settle(here, false);
        if (!search.arrives(earlier, here, kind, changes - 1, found)) continue;
        found.push_back({run.crossings, earlier});
        arrived = true;
        return nullptr;
      }
      given_up = search.left_ == 0;
      return given_up ? nullptr : now;
    }
  };

  bool arrives(int number, const Position& from, ExactFlights::Kind kind, int changes,
               std::vector<ModeChange>& found) {
    if (left_ == 0) return false;
    const ExactFlights& flights = flights_.mode(number);
    FlightLimits limits = flights.with_defaults({});
    limits.crossings = std::min(limits.crossings, left_);
    ExactFlights::NoRecord nothing;
    const auto flown = [&](auto& modes) {
      const FlightRun run = flights.fly_on<false>(from, kind, limits, infinity, nothing, modes);
      left_ -= std::min(left_, run.crossings + 1);
      return run.ended_by == EndedBy::goal;
    };
    if (number == 0) {
      ExactFlights::OneMode one;
      return flown(one);
    }
    Trial trial{*this, number, changes, found};
    const bool ended = flown(trial);
    return trial.arrived || (ended && !trial.given_up);
  }

  const ModalFlights& flights_;
  std::uint64_t left_;  // of the cells to be crossed
  double apart_m_ = 0.0;
};

ModeSequence ModalFlights::find_modes(const State& start, std::uint64_t most_crossings) const {
  return Search(*this, most_crossings).find(start);
}

int GivenModes::begin(const State&) {
  done_ = 0;
  borders_ = 0;
  return sequence_.begin;
}

int GivenModes::at_border(const BorderCrossing&, int mode) {
  ++borders_;
  if (done_ == sequence_.changes.size() || borders_ < sequence_.changes[done_].borders) return mode;
  borders_ = 0;
  return sequence_.changes[done_++].mode;
}

double GivenModes::weaves_m(const BorderCrossing&, int) { return infinity; }

}  // namespace fairway
