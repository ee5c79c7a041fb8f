#include "fairway/simulate/sampled_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/simulate/chord_event.hpp"

namespace fairway {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr double least_turn = 1e-6;  // of the tightest: a control law's rounding is not a turn

bool not_negative(double value) { return value >= 0.0 && std::isfinite(value); }

Heading turned(Heading heading, double by_rad) { return Heading::from_rad(heading.rad() + by_rad); }

/// Displacement through the air in `dt_s` at a constant turn rate.
Vec2 arc_displacement(Heading heading, double turn_rate_radps, double speed_mps, double dt_s) {
  const double half = 0.5 * turn_rate_radps * dt_s;
  const double chord_m = speed_mps * dt_s * (half == 0.0 ? 1.0 : std::sin(half) / half);
  return chord_m * turned(heading, half).unit();
}

}  // namespace

SampledFlights::SampledFlights(const Plan& plan, SampledOptions options)
    : plan_(plan), options_(std::move(options)) {
  require(plan.grid.nx > 0 && plan.grid.ny > 0 && plan.region.size() == plan.grid.size() &&
              plan.heading_rad.size() == plan.grid.size() && plan.cost_m.size() == plan.grid.size(),
          "a plan's arrays have one entry per cell");
  require(options_.control_period_s > 0.0 && std::isfinite(options_.control_period_s),
          "control period > 0");
  require(not_negative(options_.position_noise_m) && not_negative(options_.heading_noise_rad) &&
              not_negative(options_.gust_mps) && not_negative(options_.time_limit_s),
          "noise, gusts and time limit >= 0");
  require(options_.gust_time_s > 0.0, "gust correlation time > 0");
  require(std::isfinite(norm(options_.wind_mps)), "wind is finite");
  if (const auto* law = std::get_if<SaturatedProportional>(&options_.law)) {
    require(law->gain_per_s > 0.0 && std::isfinite(law->gain_per_s), "gain > 0");
  }
  if (const auto* law = std::get_if<CustomLaw>(&options_.law)) {
    require(static_cast<bool>(*law), "a custom law is callable");
  }
}

/// One flight under way.
class SampledFlights::Run {
 public:
  Run(const Plan& plan, const SampledOptions& options, const State& start, std::size_t index,
      SampledFlight* record, const FollowLimit* beyond = nullptr)
      : plan_(plan),
        options_(options),
        random_(Random::stream(options.seed, index)),
        state_(start),
        record_(record),
        beyond_(beyond),
        limit_radps_(plan.vehicle.speed_mps / plan.vehicle.turn_radius_m) {
    const double period_s = options_.control_period_s;
    keep_ = std::exp(-period_s / options_.gust_time_s);
    gust_ = {options_.gust_mps * random_.normal(), options_.gust_mps * random_.normal()};
    calm_ = options_.gust_mps == 0.0 && options_.wind_mps == Vec2{};
    flight_.start = start;
    const auto& mission = plan.record.mission;
    if (mission && std::holds_alternative<PathMission>(*mission)) path_cells_ = Region::goal;
  }

  /// Without its pieces: they are in the record.
  Flight fly() {
    require(std::isfinite(state_.position_m.x) && std::isfinite(state_.position_m.y),
            "a start's position is finite");
    end_ = outcome_at_start();
    if (end_ == Outcome::reach) enter_goal(0.0, 0.0);
    const double limit_s = end_ ? 0.0 : time_limit_s();
    while (!end_ && (time_s_ < limit_s || reached_)) {
      const Vec2 wind = options_.wind_mps + gust_;
      const double rate = demanded_rate_radps();
      if (record_ != nullptr) record_->samples.push_back({time_s_, state_, rate, wind});
      if (fly_period(rate, wind)) break;
      blow();
    }
    set_result();
    return std::move(flight_);
  }

 private:
  void set_result() {
    if (!reached_) {
      flight_.result = end_ ? FlightResult{*end_, time_s_, length_m_}
                            : FlightResult{Outcome::trapped, infinity, infinity};
      return;
    }
    flight_.result = *reached_;
    const After after = end_ == Outcome::collide ? After::collide
                        : end_ == Outcome::leave ? After::leave
                                                 : After::follow;
    flight_.onward = {after, time_s_, length_m_};
  }

  /// The first goal cell, so far from here: the flight's result, which ends it unless it is
  /// followed.
  void enter_goal(double time_s, double length_m) {
    if (beyond_ == nullptr || reached_) return;
    end_.reset();
    reached_ = FlightResult{Outcome::reach, time_s_ + time_s, length_m_ + length_m};
  }

  std::optional<Outcome> outcome_at_start() const {
    const Grid& grid = plan_.grid;
    const Vec2 p = state_.position_m;
    if (!(p.x >= grid.x0_m && p.y >= grid.y0_m && p.x <= grid.x0_m + grid.width_m() &&
          p.y <= grid.y0_m + grid.height_m())) {
      return Outcome::leave;
    }
    return outcome_in(plan_, grid.cell_of(p));
  }

  double time_limit_s() const {
    if (options_.time_limit_s > 0.0) return options_.time_limit_s;
    const Grid& grid = plan_.grid;
    double length_m = 20.0 * (grid.nx + grid.ny) * grid.cell_m;
    const auto cost_m =
        static_cast<double>(plan_.cost_m[grid.index(grid.cell_of(state_.position_m))]);
    if (std::isfinite(cost_m)) length_m = std::max(length_m, 4.0 * cost_m);
    return length_m / plan_.vehicle.speed_mps;
  }

  /// Eq. 8 on what is measured.
  double demanded_rate_radps() {
    Measurement seen{state_, 0.0, time_s_};
    seen.state.position_m =
        state_.position_m + options_.position_noise_m * Vec2{random_.normal(), random_.normal()};
    seen.state.heading = turned(state_.heading, options_.heading_noise_rad * random_.normal());
    const Cell cell = plan_.grid.cell_of(seen.state.position_m);
    if (!plan_.grid.contains(cell)) return 0.0;
    const std::size_t at = plan_.grid.index(cell);
    const float command = plan_.heading_rad[at];
    if (std::isnan(command)) return 0.0;
    seen.heading_error_rad =
        seen.state.heading.turn_to(Heading::from_rad(static_cast<double>(command)));
    const Region region = plan_.region[at];
    const bool any_law = region == Region::free || region == path_cells_;
    const double rate =
        any_law ? std::visit([&](const auto& law) { return rate_of(law, seen); }, options_.law)
                : rate_of(BangBang{}, seen);
    return std::clamp(rate, -limit_radps_, limit_radps_);
  }
  double rate_of(const BangBang&, const Measurement& seen) const {
    return seen.heading_error_rad / options_.control_period_s;  // the limit makes it bang-bang
  }
  double rate_of(const SaturatedProportional& law, const Measurement& seen) const {
    return law.gain_per_s * seen.heading_error_rad;
  }
  double rate_of(const CustomLaw& law, const Measurement& seen) const {
    const double rate = law(seen);
    require(std::isfinite(rate), "a control law demands a finite turn rate");
    return rate;
  }

  /// Returns whether the flight is over: with `end_`, or without where it was followed to.
  bool fly_period(double rate, Vec2 wind) {
    const double speed_mps = plan_.vehicle.speed_mps;
    const double fastest_mps = speed_mps + norm(wind);
    const double longest_m = plan_.grid.cell_m / 8.0;
    const double steps = std::ceil(options_.control_period_s * fastest_mps / longest_m);
    const double dt_s = options_.control_period_s / steps;
    for (double i = 0.0; i < steps; i += 1.0) {
      const Vec2 from = state_.position_m;
      const Vec2 move = arc_displacement(state_.heading, rate, speed_mps, dt_s) + dt_s * wind;
      const double move_m = calm_ ? speed_mps * dt_s : norm(move);
      const double share = share_flown(from, move, dt_s, move_m);
      if (record_ != nullptr) record_piece(rate, move, share * move_m);
      const bool turns = std::abs(rate) > least_turn * limit_radps_;
      flight_.turning.add(turns ? rate * share * dt_s : 0.0, share * move_m);
      length_m_ += share * move_m;
      time_s_ += share * dt_s;
      state_ = {from + share * move, turned(state_.heading, share * rate * dt_s)};
      if (end_ || over_) return true;
    }
    return false;
  }

  /// How much of a step is flown: to what ends the flight, which is then noted, or all of it.
  double share_flown(Vec2 from, Vec2 move, double dt_s, double move_m) {
    std::optional<ChordEvent> event = first_event(plan_, from, from + move, false);
    if (event && event->outcome == Outcome::reach && beyond_ != nullptr) {
      enter_goal(event->fraction * dt_s, event->fraction * move_m);
      event = first_event(plan_, from, from + move, true);
    }
    const double share = event ? event->fraction : 1.0;
    if (reached_) {
      const double most = std::min((reached_->length_m + beyond_->length_m - length_m_) / move_m,
                                   (reached_->time_s + beyond_->time_s - time_s_) / dt_s);
      over_ = most < share;
      if (over_) return std::max(most, 0.0);
    }
    if (event) end_ = event->outcome;
    return share;
  }

  void record_piece(double rate, Vec2 move, double length_m) {
    if (!(length_m > 0.0)) return;
    std::vector<FlightSegment>& pieces = record_->flight.segments;
    const double curvature = calm_ ? rate / plan_.vehicle.speed_mps : 0.0;
    if (calm_ && !pieces.empty() && pieces.back().curvature_per_m == curvature) {
      pieces.back().length_m += length_m;
      return;
    }
    const Heading course = calm_ ? state_.heading : Heading::of(move);
    pieces.push_back({{state_.position_m, course}, time_s_, length_m, curvature});
  }

  /// The exact step of the Gauss-Markov process over one period.
  void blow() {
    const double fresh_mps = options_.gust_mps * std::sqrt(1.0 - keep_ * keep_);
    gust_ = keep_ * gust_ + fresh_mps * Vec2{random_.normal(), random_.normal()};
  }

  const Plan& plan_;
  const SampledOptions& options_;
  Random random_;
  State state_;
  SampledFlight* record_;
  const FollowLimit* beyond_;  // null: the first goal cell ends the flight
  std::optional<FlightResult> reached_;
  std::optional<Outcome> end_;  // what ended the flight
  bool over_ = false;           // followed for as long as was asked
  Flight flight_;
  double limit_radps_;
  double keep_ = 0.0;  // of a gust after one period
  Vec2 gust_;
  bool calm_ = true;
  /// The cells of a path are flown through, by the law: Eq. 8 only distinguishes the buffer from
  /// the rest.
  Region path_cells_ = Region::free;
  double time_s_ = 0.0;
  double length_m_ = 0.0;
};

FlightResult SampledFlights::fly(const State& start, std::size_t index) const {
  return measure(start, index).result;
}

Flight SampledFlights::measure(const State& start, std::size_t index) const {
  return Run(plan_, options_, start, index, nullptr).fly();
}

SampledFlight SampledFlights::recorded(const State& start, std::size_t index,
                                       const FollowLimit* beyond) const {
  SampledFlight record;
  Flight flown = Run(plan_, options_, start, index, &record, beyond).fly();
  flown.segments = std::move(record.flight.segments);
  record.flight = std::move(flown);
  return record;
}

SampledFlight SampledFlights::record(const State& start, std::size_t index) const {
  return recorded(start, index, nullptr);
}

SampledFlight SampledFlights::follow_on(const State& start, std::size_t index,
                                        const FollowLimit& beyond) const {
  require(beyond.length_m > 0.0 && beyond.time_s > 0.0 &&
              (std::isfinite(beyond.length_m) || std::isfinite(beyond.time_s)),
          "a flight is followed for a length or a time > 0");
  return recorded(start, index, &beyond);
}

std::vector<FlightResult> SampledFlights::fly_all(std::span<const State> starts) const {
  std::vector<FlightResult> results(starts.size());
  for_ranges(starts.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = fly(starts[i], i);
  });
  return results;
}

}  // namespace fairway
