#include "fairway/identify/testing/made_log.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

struct Order {
  double time_s;
  double command_rad;
};

std::vector<Order> orders_of(const MadeVehicle& v, double length_s, Random& draw) {
  std::vector<Order> orders{{0.0, 0.3}};
  while (orders.back().time_s < length_s) {
    const Order last = orders.back();
    orders.push_back({last.time_s + draw.uniform(0.25, 1.0) * v.longest_s,
                      last.command_rad + draw.uniform(-v.most_turn_rad, v.most_turn_rad)});
  }
  return orders;
}

double command_at(const std::vector<Order>& orders, double time_s) {
  double command_rad = orders.front().command_rad;
  for (const Order& order : orders) {
    if (order.time_s <= time_s) command_rad = order.command_rad;
  }
  return command_rad;
}

/// The side first taken is kept while the command lies behind.
double turn_left_rad(double off_rad, double& side) {
  if (std::abs(off_rad) <= 0.5 * pi) {
    side = 0.0;
    return off_rad;
  }
  if (side == 0.0) side = off_rad > 0.0 ? 1.0 : -1.0;
  return side * off_rad > 0.0 ? off_rad : off_rad + side * two_pi;
}

}  // namespace

FlightLog made_log(const MadeVehicle& v, double length_s, std::uint64_t seed) {
  constexpr int substeps = 20;
  Random draw(seed);
  const std::vector<Order> orders = orders_of(v, length_s, draw);
  FlightLog log{"made.csv", {}};
  Vec2 place_m;
  double course_rad = orders.front().command_rad;
  double radius_m = draw.uniform(v.radius_least_m, v.radius_most_m);
  double last_obeyed_rad = course_rad;
  double side = 0.0;
  for (long i = 0; static_cast<double>(i) * v.period_s < length_s; ++i) {
    const double time_s = static_cast<double>(i) * v.period_s;
    log.samples.push_back({time_s, place_m, Heading::from_rad(course_rad),
                           Heading::from_rad(command_at(orders, time_s)),
                           static_cast<std::size_t>(i) + 2});
    for (int k = 0; k < substeps; ++k) {
      const double step_s = v.period_s / substeps;
      double asked_s = time_s + k * step_s - v.delay_s;
      if (asked_s >= v.ignores_from_s && asked_s < v.ignores_to_s)
        asked_s = v.ignores_from_s - 1e-9;
      const double obeyed_rad = command_at(orders, std::max(0.0, asked_s));
      if (obeyed_rad != last_obeyed_rad) radius_m = draw.uniform(v.radius_least_m, v.radius_most_m);
      if (obeyed_rad != last_obeyed_rad && v.forgets_sides) side = 0.0;
      last_obeyed_rad = obeyed_rad;
      const double error_rad = 0.9 * v.heading_error_rad * std::sin(0.7 * (time_s + k * step_s));
      const double left_rad =
          turn_left_rad(std::remainder(obeyed_rad + error_rad - course_rad, two_pi), side);
      const double most_rad = v.speed_mps * step_s / radius_m;
      course_rad += std::clamp(left_rad, -most_rad, most_rad);
      place_m = place_m + v.speed_mps * step_s * Vec2{std::cos(course_rad), std::sin(course_rad)};
    }
  }
  return log;
}

}  // namespace fairway
