#include "fairway/run/steering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/report/draw_steering.hpp"
#include "fairway/run/path_segments.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/waypoint_law.hpp"

namespace fairway {
namespace {

constexpr double step_radii = 0.01;  // of a track along a shortest path
constexpr double tie_radii = 0.02;
constexpr double most_points = 10'000.0;  // of a leg along a shortest path, besides its joins

void add_shortest_track(SteeredLeg& leg, const DubinsPath& path) {
  const double length_m = path.length_m();
  const double step_m = std::max(step_radii * path.turn_radius_m, length_m / most_points);
  const auto add = [&](const State& s, double per_m, double driven_m) {
    leg.track.push_back({driven_m, s, per_m, (length_m - driven_m) / path.turn_radius_m, 0.0, 0.0});
  };
  leg.segments = segments_of(path);
  double driven_m = 0.0;
  for (const FlightSegment& piece : leg.segments) {
    const double steps = std::ceil(piece.length_m / step_m);
    for (double k = 0.0; k < steps; k += 1.0) {
      const double along_m = piece.length_m * k / steps;
      add(driven(piece.start, along_m, piece.curvature_per_m), piece.curvature_per_m,
          driven_m + along_m);
    }
    driven_m += piece.length_m;
  }
  add(end_of(path), leg.segments.empty() ? 0.0 : leg.segments.back().curvature_per_m, length_m);
}

SteeredLeg shortest_leg(const State& from, const State& goal, double turn_radius_m,
                        LegTrack track) {
  const DubinsPath path = shortest_path(from, goal, turn_radius_m);
  SteeredLeg leg{from, goal, path.length_m(), name_of(path.word), true, end_of(path), {}, {}};
  if (track == LegTrack::all) add_shortest_track(leg, path);
  return leg;
}

using GoalAt = std::function<State(double driven_m)>;

/// What a law computes for a state: V, and paper 3's parts of it.
TrackPoint seen_by(const ClfLaw& law, const State& s, const State& goal, double turn_radius_m) {
  const ClfValue value = law.value(s, goal, turn_radius_m);
  const bool repels = value.repels_left || value.repels_right;
  return {0.0,
          s,
          0.0,
          value.v,
          value.v_attract,
          repels ? value.v_repel : std::numeric_limits<double>::quiet_NaN()};
}
TrackPoint seen_by(const ShortestLaw& /*law*/, const State& s, const State& goal,
                   double turn_radius_m) {
  return {0.0, s, 0.0, shortest_length_m(s, goal, turn_radius_m) / turn_radius_m, 0.0, 0.0};
}

/// The states of a flight, with what the law saw at each: it is evaluated again, with the same
/// result.
template <typename Law>
void add_flown_track(SteeredLeg& leg, Law law, std::span<const State> states, const GoalAt& goal_at,
                     double turn_radius_m, double step_m) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const State& s = states[i];
    const double driven_m = static_cast<double>(i) * step_m;
    const State goal = goal_at(driven_m);
    TrackPoint point = seen_by(law, s, goal, turn_radius_m);
    point.driven_m = driven_m;
    const bool last = i + 1 == states.size();
    point.curvature_per_m = !last ? law.curvature_per_m(s, goal, turn_radius_m, step_m)
                            : leg.track.empty() ? 0.0
                                                : leg.track.back().curvature_per_m;
    leg.track.push_back(point);
    if (!last) leg.segments.push_back({s, driven_m, step_m, point.curvature_per_m});
  }
}

template <typename Law>
SteeredLeg flown_leg(const Law& fresh, const State& from, const State& goal, double turn_radius_m,
                     const SteeringRequest& request, std::size_t number, LegTrack track) {
  const SteeringOptions options = request.options(from, goal, turn_radius_m);
  const SteeringWorld world =
      world_of({request.goal_speed, request.noise_m, Random::stream(request.seed, number)}, goal,
               turn_radius_m);
  const GoalAt goal_at = [&](double driven_m) { return world.goal ? world.goal(driven_m) : goal; };
  Law law = fresh;
  SteeringFlight flight = fly(law, from, goal, turn_radius_m, options,
                              track == LegTrack::all ? Track::all : Track::none, world);
  SteeredLeg leg{from,
                 goal_at(flight.length_m),
                 flight.length_m,
                 std::move(flight.word),
                 flight.converged,
                 flight.end,
                 {},
                 {}};
  add_flown_track(leg, fresh, flight.track, goal_at, turn_radius_m, options.step_m);
  return leg;
}

SteeredLeg leg_of(const PosePairs& pairs, std::size_t i, double turn_radius_m,
                  const SteeringRequest& request, LegTrack track) {
  const State& from = pairs.from[i];
  const State& goal = pairs.to[i];
  if (!request.is_flown()) return shortest_leg(from, goal, turn_radius_m, track);
  if (request.law == SteeringLaw::clf) {
    return flown_leg(ClfLaw(request.clf), from, goal, turn_radius_m, request, i, track);
  }
  const SteeringOptions options = request.options(from, goal, turn_radius_m);
  return flown_leg(ShortestLaw({options.tolerance, tie_radii * turn_radius_m}), from, goal,
                   turn_radius_m, request, i, track);
}

SteeredPath joined(std::span<const SteeredLeg> legs, std::string name) {
  SteeredPath path{std::move(name), {}};
  for (const SteeredLeg& leg : legs) {
    path.segments.insert(path.segments.end(), leg.segments.begin(), leg.segments.end());
  }
  return path;
}

double total_m(std::span<const SteeredLeg> legs) {
  double sum_m = 0.0;
  for (const SteeredLeg& leg : legs) sum_m += leg.length_m;
  return sum_m;
}

std::string words_of(std::span<const SteeredLeg> legs) {
  const std::string what =
      legs.size() == 1 ? legs.front().word : fmt::format("{} legs", legs.size());
  return fmt::format("{}, {} m", what, length_text(total_m(legs)));
}

/// V over all legs; a gap between legs, where it jumps.
std::vector<ChartSeries> value_series(std::span<const SteeredLeg> legs, SteeringLaw law) {
  const bool shortest = law == SteeringLaw::shortest;
  ChartSeries v{shortest ? "V: what is left of the path" : "V (Eq. 20)", {}, {}, LineStyle::solid};
  ChartSeries attract{"V_A, attraction (Eq. 9)", {}, {}, LineStyle::dashed};
  ChartSeries repel{"V_R, repulsion (Eq. 17)", {}, {}, LineStyle::dotted};
  bool repels = false;
  double before_m = 0.0;
  for (const SteeredLeg& leg : legs) {
    const auto add = [&](double driven_m, double value, double attraction, double repulsion) {
      for (const auto& [series, y] :
           {std::pair{&v, value}, std::pair{&attract, attraction}, std::pair{&repel, repulsion}}) {
        series->x.push_back(before_m + driven_m);
        series->y.push_back(y);
      }
    };
    for (const TrackPoint& point : leg.track) {
      add(point.driven_m, point.value, point.attract, point.repel);
      repels = repels || !std::isnan(point.repel);
    }
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    add(leg.length_m, gap, gap, gap);
    before_m += leg.length_m;
  }
  if (shortest) return {std::move(v)};
  std::vector<ChartSeries> all{std::move(v), std::move(attract)};
  if (repels) all.push_back(std::move(repel));
  return all;
}

}  // namespace

SteeringOptions SteeringRequest::options(const State& from, const State& goal,
                                         double turn_radius_m) const {
  SteeringOptions options = steering_options(from, goal, turn_radius_m);
  options.step_m = step_m.value_or(options.step_m);
  if (tolerance_m) options.tolerance = {*tolerance_m, *tolerance_m / turn_radius_m};
  require(options.tolerance.covers(options.step_m, turn_radius_m), "the tolerance covers the step");
  require(goal_speed >= 0.0 && goal_speed < 1.0, "the goal is slower than the vehicle");
  options.length_limit_m /= 1.0 - goal_speed;
  return options;
}

std::vector<SteeredLeg> steer_pairs(const PosePairs& pairs, double turn_radius_m,
                                    const SteeringRequest& request, LegTrack track) {
  std::vector<SteeredLeg> legs(pairs.from.size());
  for_ranges(legs.size(), request.is_flown() ? 4 : 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      legs[i] = leg_of(pairs, i, turn_radius_m, request, track);
    }
  });
  return legs;
}

std::vector<SteeredLeg> steer_waypoints(const PosePairs& asked, double turn_radius_m,
                                        const SteeringRequest& request, LegTrack track) {
  if (request.law == SteeringLaw::shortest) {
    return steer_pairs(asked, turn_radius_m, SteeringRequest{}, track);
  }
  const State& start = asked.from.front();
  const SteeringOptions options = request.options(start, asked.to.front(), turn_radius_m);
  WaypointFlight flight = follow_waypoints(
      WaypointLaw<ClfLaw>(ClfLaw(request.clf), {options.tolerance}), start, asked.to, turn_radius_m,
      options.step_m, track == LegTrack::all ? Track::all : Track::none);
  std::vector<SteeredLeg> legs;
  for (std::size_t i = 0; i < flight.legs.size(); ++i) {
    WaypointLeg& leg = flight.legs[i];
    legs.push_back({leg.begin,
                    asked.to[i],
                    leg.length_m,
                    std::move(leg.word),
                    leg.converged,
                    leg.end,
                    {},
                    {}});
    const GoalAt goal_at = [&](double /*driven_m*/) { return asked.to[i]; };
    add_flown_track(legs.back(), ClfLaw(request.clf), leg.track, goal_at, turn_radius_m,
                    options.step_m);
  }
  return legs;
}

std::string track_csv(std::span<const SteeredLeg> legs) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value\n");
  double before_m = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    for (const TrackPoint& p : legs[i].track) {
      fmt::format_to(out, "{},{},{},{},{},{},{}\n", i, before_m + p.driven_m, p.state.position_m.x,
                     p.state.position_m.y, p.state.heading.rad(), p.curvature_per_m, p.value);
    }
    before_m += legs[i].length_m;
  }
  return fmt::to_string(text);
}

Picture steering_picture(std::span<const SteeredLeg> legs, double turn_radius_m,
                         const SteeringRequest& request) {
  SteeringPicture picture;
  picture.turn_radius_m = turn_radius_m;
  picture.start = legs.front().from;
  for (const SteeredLeg& leg : legs) picture.goals.push_back(leg.goal);
  if (!request.is_flown()) {
    picture.path = joined(legs, "shortest: " + words_of(legs));
  } else {
    const char* law = request.law == SteeringLaw::clf ? "clf" : "shortest";
    picture.path = joined(legs, fmt::format("law {}: {}", law, words_of(legs)));
    std::vector<SteeredLeg> shortest;
    State from = picture.start;
    for (const SteeredLeg& leg : legs) {
      shortest.push_back(shortest_leg(from, leg.goal, turn_radius_m, LegTrack::all));
      from = leg.goal;
    }
    picture.compared = joined(shortest, "shortest: " + words_of(shortest));
  }
  picture.values = value_series(legs, request.law);
  picture.value_label = "V (turning radii)";
  return draw_steering(picture);
}

}  // namespace fairway
