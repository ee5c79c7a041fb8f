// For tests: behaviours within a contract, flown in small steps from the words of
// fairway/vehicle/contract.hpp alone. Nothing of the checker is used. Lengths are in parts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace fairway_check {

inline double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

struct SmallWorld {
  int nx = 0;  // cells
  int ny = 0;
  int k = 1;                   // parts in a cell
  std::vector<float> command;  // [iy][ix] of cells
  std::vector<double> filled;
  std::vector<std::uint8_t> kind;  // 0 ordinary, 1 obstacle, 2 goal
  double rho = 0.0;
  double eps = 0.0;
  double r1 = 0.0;
  double r2 = 0.0;
  double hold = 0.5 * std::numbers::pi;
  double uncertain = 0.0;

  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * nx + x); }
  /// Of a cell, or of the nearest with one; once for all.
  void fill() {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) filled.push_back(command_of(x, y));
    }
  }
  double command_of(int x, int y) const {
    if (!std::isnan(command[at(x, y)])) return static_cast<double>(command[at(x, y)]);
    double best = HUGE_VAL;
    double found = NAN;
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const double away = std::hypot(i - x, j - y);
        if (std::isnan(command[at(i, j)]) || away >= best) continue;
        best = away;
        found = static_cast<double>(command[at(i, j)]);
      }
    }
    return found;
  }
  /// Distance from a rectangle to a cell.
  double away(int x, int y, double x0, double y0, double x1, double y1) const {
    const double dx = std::max({0.0, double(x) * k - x1, x0 - double(x + 1) * k});
    const double dy = std::max({0.0, double(y) * k - y1, y0 - double(y + 1) * k});
    return std::hypot(dx, dy);
  }
  std::vector<double> commands_near(double x0, double y0, double x1, double y1,
                                    double reach) const {
    std::vector<double> all;
    const auto from = [this, reach](double low) {
      return std::max(0, static_cast<int>((low - reach) / k) - 1);
    };
    const auto to = [this, reach](double high, int n) {
      return std::min(n - 1, static_cast<int>((high + reach) / k) + 1);
    };
    for (int y = from(y0); y <= to(y1, ny); ++y) {
      for (int x = from(x0); x <= to(x1, nx); ++x) {
        if (away(x, y, x0, y0, x1, y1) <= reach) all.push_back(filled[at(x, y)]);
      }
    }
    return all;
  }
  /// The smallest arc that holds the commands of a part, by its widest gap; width of 2 pi if none.
  void arc_of(int px, int py, double& right, double& width) const {
    std::vector<double> all = commands_near(px, py, px + 1, py + 1, rho);
    for (double& c : all) c = wrapped(c);
    std::sort(all.begin(), all.end());
    double gap = -1.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool last = i + 1 == all.size();
      const double next = last ? all[0] + 2.0 * std::numbers::pi : all[i + 1];
      if (next - all[i] <= gap) continue;
      gap = next - all[i];
      right = next - eps;
    }
    width = 2.0 * std::numbers::pi - gap + 2.0 * eps;
  }
  /// 0 ordinary, 1 obstacle, 2 goal, 3 outside: of a part.
  int kind_of(int px, int py) const {
    if (px < 0 || py < 0 || px >= nx * k || py >= ny * k) return 3;
    return kind[at(px / k, py / k)];
  }
};

struct Flown {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;  // not reduced to a full turn
  int side = 0;          // in memory: 1 left, -1 right, 0 none
  double length = 0.0;
};

/// How it chooses among what the contract allows.
struct Whim {
  int wants = 0;        // to turn: 1 left, -1 right, 0 at random
  int radius = 0;       // 1 least, 2 most, 0 at random
  double fickle = 0.1;  // how often it thinks again
};

/// One arc, by the contract's words.
class Adversary {
 public:
  Adversary(const SmallWorld& world, std::uint64_t seed) : world_(world), random_(seed) {}

  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  /// The curvature for the next `step`, and by how much of it the command is reached. Changes the
  /// memory of the side.
  double curvature(Flown& now, double step, const Whim& whim, double& until) {
    until = step;
    if (unit() < whim.fickle || !thought_) think(whim);
    const auto near = world_.commands_near(now.x, now.y, now.x, now.y, world_.rho - step);
    const double cell_command = choose(near, now, whim);
    const double radius = bold_   ? world_.r1
                          : calm_ ? world_.r2
                                  : world_.r1 + (world_.r2 - world_.r1) * mood_;
    const double off = wrapped(now.heading - cell_command);
    if (std::abs(off) <= world_.eps && world_.eps > 0.0) {  // anything that stays within
      now.side = 0;
      double curve = (2.0 * unit() - 1.0) / world_.r1;
      if (whim.wants != 0) curve = whim.wants / world_.r1;
      const double room = curve > 0.0 ? world_.eps - off : world_.eps + off;
      if (std::abs(curve) * step > room) curve = std::copysign(room / step, curve);
      return curve;
    }
    const double command = cell_command + world_.eps * (2.0 * shift_ - 1.0);
    const double turn = wrapped(command - now.heading);
    int way = turn > 0.0 ? 1 : -1;
    if (std::abs(turn) <= world_.hold) {
      now.side = 0;
    } else if (now.side != 0) {
      way = now.side;
    } else {
      if (std::abs(turn) >= std::numbers::pi - world_.uncertain) {
        way = whim.wants != 0 ? whim.wants : unit() < 0.5 ? 1 : -1;
      }
      now.side = way;
    }
    double angle = way > 0 ? turn : -turn;
    if (angle < 0.0) angle += 2.0 * std::numbers::pi;
    until = std::min(step, angle * radius);
    return way / radius;
  }

  static void move(Flown& now, double curve, double length) {
    const double turn = curve * length;
    const double chord = std::abs(turn) < 1e-9 ? length : 2.0 / curve * std::sin(0.5 * turn);
    now.x += chord * std::cos(now.heading + 0.5 * turn);
    now.y += chord * std::sin(now.heading + 0.5 * turn);
    now.heading += turn;
    now.length += length;
  }

 private:
  void think(const Whim& whim) {
    thought_ = true;
    bold_ = whim.radius == 1 || (whim.radius == 0 && unit() < 0.3);
    calm_ = whim.radius == 2 || (whim.radius == 0 && unit() < 0.4);
    mood_ = unit();
    shift_ = unit() < 0.5 ? (unit() < 0.5 ? 0.0 : 1.0) : unit();
    pick_ = random_();
  }
  /// The command that turns it the way it wants: the one farthest that way, if any.
  double choose(const std::vector<double>& near, const Flown& now, const Whim& whim) {
    if (whim.wants == 0) return near[static_cast<std::size_t>(pick_ % near.size())];
    double best = near[0];
    double most = -HUGE_VAL;
    for (const double c : near) {
      const double turn = whim.wants * wrapped(c - now.heading);
      // A far command counts as on the held side.
      const double gain = std::abs(turn) > world_.hold && now.side == whim.wants ? 4.0 : turn;
      if (gain <= most) continue;
      most = gain;
      best = c;
    }
    shift_ = whim.wants > 0 ? 1.0 : 0.0;
    return best;
  }

  const SmallWorld& world_;
  std::mt19937_64 random_;
  bool thought_ = false;
  bool bold_ = false;
  bool calm_ = false;
  double mood_ = 0.0;
  double shift_ = 0.5;
  std::uint64_t pick_ = 0;
};

}  // namespace fairway_check
