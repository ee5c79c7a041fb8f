#include "fairway/simulate/sampled_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool not_negative(double value) { return value >= 0.0 && std::isfinite(value); }

Heading turned(Heading heading, double by_rad) { return Heading::from_rad(heading.rad() + by_rad); }

/// Displacement through the air in `dt_s` at a constant turn rate.
Vec2 arc_displacement(Heading heading, double turn_rate_radps, double speed_mps, double dt_s) {
  const double half = 0.5 * turn_rate_radps * dt_s;
  const double chord_m = speed_mps * dt_s * (half == 0.0 ? 1.0 : std::sin(half) / half);
  return chord_m * turned(heading, half).unit();
}

/// What the chord from a to b meets first, as a fraction of it.
struct Event {
  double fraction;
  Outcome outcome;
};

std::optional<Outcome> outcome_in(const Plan& plan, Cell cell) {
  if (!plan.grid.contains(cell)) return Outcome::leave;
  const Region region = plan.region[plan.grid.index(cell)];
  if (region == Region::obstacle) return Outcome::collide;
  if (region == Region::goal) return Outcome::reach;
  return std::nullopt;
}

/// The chord is shorter than a cell, so it crosses at most one grid line of either direction.
std::optional<Event> first_event(const Plan& plan, Vec2 a, Vec2 b) {
  const Grid& grid = plan.grid;
  const Cell from = grid.cell_of(a);
  const Cell to = grid.cell_of(b);
  if (from == to) return std::nullopt;
  double cut_x = 1.0;
  double cut_y = 1.0;
  if (from.ix != to.ix) {
    const double x = grid.x0_m + std::max(from.ix, to.ix) * grid.cell_m;
    cut_x = std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0);
  }
  if (from.iy != to.iy) {
    const double y = grid.y0_m + std::max(from.iy, to.iy) * grid.cell_m;
    cut_y = std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
  }
  const double first = std::min(cut_x, cut_y);
  const double second = std::max(cut_x, cut_y);
  if (from.ix != to.ix && from.iy != to.iy) {
    const Cell between = cut_x < cut_y ? Cell{to.ix, from.iy} : Cell{from.ix, to.iy};
    if (const auto outcome = outcome_in(plan, between)) return Event{first, *outcome};
    if (const auto outcome = outcome_in(plan, to)) return Event{second, *outcome};
  } else if (const auto outcome = outcome_in(plan, to)) {
    return Event{first, *outcome};
  }
  return std::nullopt;
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
      SampledFlight* record)
      : plan_(plan),
        options_(options),
        random_(Random::stream(options.seed, index)),
        state_(start),
        record_(record),
        limit_radps_(plan.vehicle.speed_mps / plan.vehicle.turn_radius_m) {
    const double period_s = options_.control_period_s;
    keep_ = std::exp(-period_s / options_.gust_time_s);
    gust_ = {options_.gust_mps * random_.normal(), options_.gust_mps * random_.normal()};
    calm_ = options_.gust_mps == 0.0 && options_.wind_mps == Vec2{};
  }

  FlightResult fly() {
    require(std::isfinite(state_.position_m.x) && std::isfinite(state_.position_m.y),
            "a start's position is finite");
    if (const auto outcome = outcome_at_start()) return {*outcome, 0.0, 0.0};
    const double limit_s = time_limit_s();
    while (time_s_ < limit_s) {
      const Vec2 wind = options_.wind_mps + gust_;
      const double rate = demanded_rate_radps();
      if (record_ != nullptr) record_->samples.push_back({time_s_, state_, rate, wind});
      if (const auto outcome = fly_period(rate, wind)) return {*outcome, time_s_, length_m_};
      blow();
    }
    return {Outcome::trapped, infinity, infinity};
  }

 private:
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
    const bool any_law = plan_.region[at] == Region::free;
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

  std::optional<Outcome> fly_period(double rate, Vec2 wind) {
    const double fastest_mps = plan_.vehicle.speed_mps + norm(wind);
    const double longest_m = plan_.grid.cell_m / 8.0;
    const double steps = std::ceil(options_.control_period_s * fastest_mps / longest_m);
    const double dt_s = options_.control_period_s / steps;
    for (double i = 0.0; i < steps; i += 1.0) {
      const Vec2 from = state_.position_m;
      const Vec2 move =
          arc_displacement(state_.heading, rate, plan_.vehicle.speed_mps, dt_s) + dt_s * wind;
      const double move_m = calm_ ? plan_.vehicle.speed_mps * dt_s : norm(move);
      const auto event = first_event(plan_, from, from + move);
      const double share = event ? event->fraction : 1.0;
      if (record_ != nullptr) record_piece(rate, move, share * move_m);
      length_m_ += share * move_m;
      time_s_ += share * dt_s;
      state_ = {from + share * move, turned(state_.heading, share * rate * dt_s)};
      if (event) return event->outcome;
    }
    return std::nullopt;
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
  double limit_radps_;
  double keep_ = 0.0;  // of a gust after one period
  Vec2 gust_;
  bool calm_ = true;
  double time_s_ = 0.0;
  double length_m_ = 0.0;
};

FlightResult SampledFlights::fly(const State& start, std::size_t index) const {
  return Run(plan_, options_, start, index, nullptr).fly();
}

SampledFlight SampledFlights::record(const State& start, std::size_t index) const {
  SampledFlight record;
  record.flight.start = start;
  record.flight.result = Run(plan_, options_, start, index, &record).fly();
  return record;
}

std::vector<FlightResult> SampledFlights::fly_all(std::span<const State> starts) const {
  std::vector<FlightResult> results(starts.size());
  for_ranges(starts.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = fly(starts[i], i);
  });
  return results;
}

}  // namespace fairway
