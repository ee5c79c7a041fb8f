// One behaviour within a contract, drawn at random or out to do harm, in small steps, from the
// words of vehicle/contract.hpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

class Behaviour {
 public:
  Behaviour(const Flow& flow, const std::vector<float>& commands, const VehicleContract& contract,
            Vec2 place, double heading_rad, std::uint64_t seed)
      : flow_(flow),
        commands_(commands),
        contract_(contract),
        place_(place),
        heading_rad_(heading_rad),
        random_(seed),
        bias_(static_cast<int>(random_.below(3)) - 1) {}

  Vec2 place() const { return place_; }
  double heading_rad() const { return heading_rad_; }

  void step(double length_m) {
    if (random_.unit() < 0.1) renew();
    const double command = command_at(place_ + error_) + band_;
    double turn = std::remainder(command - heading_rad_, 2.0 * pi);
    if (std::abs(turn) > contract_.hold_side_rad) {
      if (held_ == 0) {
        held_ = turn > 0.0 ? 1 : -1;
        if (std::abs(turn) > pi - contract_.side_uncertain_rad && random_.below(2) == 0) {
          held_ = -held_;
        }
      }
      if (turn * held_ < 0.0) turn += held_ * 2.0 * pi;
    } else {
      held_ = 0;
    }
    const double most = length_m / radius_m_;
    move(length_m, std::clamp(turn, -most, most));
  }

 private:
  double command_at(Vec2 p) const {
    const Grid& g = flow_.grid;
    const Cell c = g.cell_of(p);
    return static_cast<double>(
        commands_[g.index({std::clamp(c.ix, 0, g.nx - 1), std::clamp(c.iy, 0, g.ny - 1)})]);
  }
  /// Other errors, another radius. Half of the time those of some that turn it most to one side.
  void renew() {
    const int candidates = bias_ == 0 ? 1 : 6;
    double worst = -1e300;
    for (int k = 0; k < candidates; ++k) {
      const double angle = random_.uniform(-pi, pi);
      const double far = contract_.command_error_m * std::sqrt(random_.unit());
      const Vec2 error{far * std::cos(angle), far * std::sin(angle)};
      const double off =
          bias_ * std::remainder(command_at(place_ + error) - heading_rad_, 2.0 * pi);
      if (off > worst || k == 0) {
        worst = off;
        error_ = error;
      }
    }
    const double spread = contract_.heading_error_rad;
    band_ = bias_ == 0 ? random_.uniform(-spread, spread) : bias_ * spread;
    const auto [least, most] =
        std::pair{contract_.turn_radius_m.least, contract_.turn_radius_m.most};
    radius_m_ = random_.below(3) == 0 ? random_.uniform(least, most)
                                      : (random_.below(2) == 0 ? least : most);
  }
  void move(double length_m, double turn_rad) {
    const double middle = heading_rad_ + 0.5 * turn_rad;
    const double half = 0.5 * turn_rad;
    const double chord = std::abs(half) < 1e-9 ? length_m : length_m * std::sin(half) / half;
    place_ = place_ + chord * Vec2{std::cos(middle), std::sin(middle)};
    heading_rad_ += turn_rad;
  }

  const Flow& flow_;
  const std::vector<float>& commands_;
  const VehicleContract& contract_;
  Vec2 place_;
  double heading_rad_;
  Random random_;
  int bias_;
  int held_ = 0;
  Vec2 error_;
  double band_ = 0.0;
  double radius_m_ = contract_.turn_radius_m.least;
};

}  // namespace fairway
