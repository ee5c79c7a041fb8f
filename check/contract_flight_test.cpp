#include "check/contract_flight.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>

#include "check/testing/contract_adversary.hpp"

namespace fairway_check {
namespace {

using std::numbers::pi;

struct Recorder : Sightings {
  struct Crossing {
    std::size_t part;
    int side;
    double low;
    double high;
    Past past;
  };
  std::vector<Crossing> crossings;
  std::vector<std::pair<Verdict, Past>> ends;
  bool lost = false;
  void cross(std::size_t part, int side, double low, double high, const Past& past) override {
    crossings.push_back({part, side, low, high, past});
  }
  void end(Verdict verdict, const Past& past) override { ends.emplace_back(verdict, past); }
  void give_up() override { lost = true; }
};

Contract contract_of_world(const SmallWorld& w) {
  return {.command_error = w.rho,
          .heading_error = w.eps,
          .estimate_error = 0.0,
          .least_radius = w.r1,
          .most_radius = w.r2,
          .least_speed = 1.0,
          .most_speed = 1.0,
          .hold_side = w.hold,
          .side_uncertain = w.uncertain};
}

Loop loop_of_world(const SmallWorld& w) {
  Loop loop;
  loop.nx = w.nx;
  loop.ny = w.ny;
  loop.command_rad = w.command;
  loop.kind = w.kind;
  return loop;
}

/// Random, with commands that mostly agree with their neighbours; parts of side 1.
SmallWorld random_world(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  SmallWorld w;
  w.nx = 6 + static_cast<int>(random() % 3);
  w.ny = 6 + static_cast<int>(random() % 3);
  w.k = 1 + static_cast<int>(random() % 3);
  const double base = 2.0 * pi * unit();
  const double along_x = 1.2 * (unit() - 0.5);
  const double along_y = 1.2 * (unit() - 0.5);
  const double rough = std::pow(unit(), 3.0) * 2.0;
  const double gone = unit() < 0.5 ? 0.0 : 0.15;
  for (int y = 0; y < w.ny; ++y) {
    for (int x = 0; x < w.nx; ++x) {
      const double c = base + along_x * x + along_y * y + rough * (2.0 * unit() - 1.0);
      const double right_angle = unit() < 0.1 ? pi / 2.0 * std::round(c / (pi / 2.0)) : c;
      const double pick = unit();
      w.kind.push_back(pick < 0.08 ? 1 : pick < 0.14 ? 2 : 0);
      const bool none = (w.kind.back() == 1 && unit() < 0.8) || unit() < gone;
      w.command.push_back(none ? NAN : static_cast<float>(wrapped(right_angle)));
    }
  }
  w.command[0] = 1.0F;
  w.fill();
  w.rho = w.k * (unit() < 0.4 ? 0.02 : 0.8 * unit());
  w.eps = unit() < 0.3 ? 0.002 : 0.15 * unit();
  const double r = w.k * (1.2 + 3.0 * unit());
  const double spread = unit() < 0.3 ? 0.0 : 0.2 * unit();
  w.r1 = r * (1.0 - spread);
  w.r2 = r * (1.0 + spread);
  w.uncertain = unit() < 0.5 ? 0.0 : 0.3 * unit();
  if (unit() < 0.25) w.hold = pi * (0.3 + 0.7 * unit());
  return w;
}

/// First the command is far to the left, so that a vehicle begins to turn left and holds that side;
/// columns further on it comes near from the right, so that it turns back. In between it is never
/// so that a vehicle might do both.
SmallWorld turning_back_world(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  SmallWorld w;
  w.nx = 8;
  w.ny = 8;
  w.k = 2;
  const int strip = 2 + static_cast<int>(random() % 2);
  for (int y = 0; y < w.ny; ++y) {
    for (int x = 0; x < w.nx; ++x) {
      const double degrees = x < strip ? 150.0 : x == strip ? 215.0 : 280.0;
      w.kind.push_back(y == 0 || y == w.ny - 1 ? 1 : 0);
      w.command.push_back(static_cast<float>(wrapped((degrees + 4.0 * unit()) * pi / 180.0)));
    }
  }
  w.fill();
  w.rho = 0.02 + 0.1 * unit();
  w.eps = 0.01;
  w.r1 = 4.0 + 4.0 * unit();
  w.r2 = w.r1 * (1.0 + 0.1 * unit());
  return w;
}

std::string told(const SmallWorld& w, const Flown& f, const char* what) {
  std::ostringstream out;
  out.precision(12);
  out << what << " at (" << f.x << ", " << f.y << ") heading " << f.heading << " side " << f.side
      << " after " << f.length << "; k " << w.k << " rho " << w.rho << " eps " << w.eps << " r "
      << w.r1 << " " << w.r2 << " hold " << w.hold << " uncertain " << w.uncertain;
  return out.str();
}

/// What a flight met first: an end, or the first crossing out of a part with a heading of its arc.
enum class Answer { told, untold, open };

struct Flight {
  const SmallWorld& w;
  const Parts& parts;
  const Contract& contract;
  const Recorder& image;
  double least = 0.0;
  double most = 0.0;
  double shift = 0.0;  // between the headings here and those of the image

  bool covers(const Past& past, double length) const {
    for (int turns = -4; turns <= 4; ++turns) {
      const double by = 2.0 * pi * turns;
      if (past.least_rad <= least + by + 1e-6 && past.most_rad >= most + by - 1e-6 &&
          past.length >= length - 1e-6) {
        return true;
      }
    }
    return false;
  }
  bool knows_end(int kind, double length) const {
    for (const auto& [verdict, past] : image.ends) {
      const int of = verdict == collide ? 1 : verdict == reach ? 2 : 3;
      if (of == kind && past.length >= length - 1e-6) return true;
    }
    return false;
  }
  bool knows_crossing(std::size_t part, int side, double place, double length) const {
    for (const auto& c : image.crossings) {
      if (c.part == part && c.side == side && c.low <= place + 1e-9 && place - 1e-9 <= c.high &&
          covers(c.past, length)) {
        return true;
      }
    }
    return false;
  }

  /// Flies until something is met; `why` says what was not told.
  Answer fly(Flown now, Cell first, const Whim& whim, std::uint64_t seed, std::string& why) {
    Adversary adversary(w, seed);
    int px = first.x;
    int py = first.y;
    least = most = now.heading;
    const double step = std::min({0.02 * w.r1, 0.05, 0.9 * w.rho});
    for (int i = 0; i < 4000; ++i) {
      double until = 0.0;
      const double curve = adversary.curvature(now, step, whim, until);
      // Stops where it leaves the part.
      Flown next = now;
      Adversary::move(next, curve, until);
      const auto inside = [&](const Flown& f) {
        return f.x >= px && f.x <= px + 1 && f.y >= py && f.y <= py + 1;
      };
      const bool leaves = !inside(next);
      if (leaves) {
        double in = 0.0;
        double out = until;
        for (int b = 0; b < 60; ++b) {
          const double middle = 0.5 * (in + out);
          next = now;
          Adversary::move(next, curve, middle);
          (inside(next) ? in : out) = middle;
        }
        next = now;
        Adversary::move(next, curve, out);
      }
      now = next;
      least = std::min(least, now.heading);
      most = std::max(most, now.heading);
      if (!leaves) continue;
      const int side = now.x > px + 1 ? 0 : now.y > py + 1 ? 1 : now.x < px ? 2 : 3;
      const double place = side == 0   ? now.y - py
                           : side == 1 ? px + 1 - now.x
                           : side == 2 ? py + 1 - now.y
                                       : now.x - px;
      double right = 0.0;
      double width = 0.0;
      w.arc_of(px, py, right, width);
      const double turn = now.heading - right;
      const double in_arc = turn - 2.0 * pi * std::floor((turn + 1e-6) / (2.0 * pi));
      if (width < pi && in_arc <= width + 1e-6) {
        const std::size_t part = parts.index({px, py});
        if (knows_crossing(part, side, place, now.length)) return Answer::told;
        const bool doubtful = in_arc < 1e-6 || in_arc > width - 1e-6 || width > 0.9 * w.hold ||
                              width > pi - w.hold - 0.1 || width > pi - w.uncertain - 0.1;
        if (!doubtful && strict) {
          why = told(w, now, "crossing");
          return Answer::untold;
        }
      }
      constexpr int dx[4]{1, 0, -1, 0};
      constexpr int dy[4]{0, 1, 0, -1};
      px += dx[side];
      py += dy[side];
      if (const int kind = w.kind_of(px, py); kind != 0) {
        if (knows_end(kind, now.length)) return Answer::told;
        why = told(w, now, kind == 1 ? "collision" : kind == 2 ? "goal" : "edge");
        return Answer::untold;
      }
    }
    why = told(w, now, "nothing");
    return Answer::open;
  }
  bool strict = true;
};

struct Count {
  int told = 0;
  int images = 0;
  int lost = 0;
};

/// Whether it has met its end already.
bool touches_end(const SmallWorld& w, double x, double y) {
  for (const double dx : {-1e-6, 1e-6}) {
    for (const double dy : {-1e-6, 1e-6}) {
      const int px = static_cast<int>(std::floor(x + dx));
      if (w.kind_of(px, static_cast<int>(std::floor(y + dy))) != 0) return true;
    }
  }
  return false;
}

/// Leaves, or states, of random worlds, each with the image and many flights.
void attack(SmallWorld (*world)(std::uint64_t), std::uint64_t from, std::uint64_t to, bool leaves,
            Count& count) {
  for (std::uint64_t seed = from; seed < to; ++seed) {
    const SmallWorld w = world(seed);
    const Contract contract = contract_of_world(w);
    const Parts parts = parts_of(loop_of_world(w), w.k, w.k, contract);
    Behaviours behaviours(parts, contract);
    Adversary dice(w, seed + 7);
    for (int n = 0; n < 40; ++n) {
      const std::size_t part = dice.below(parts.kind.size());
      const Cell p = parts.part_at(part);
      const Arc arc = parts.arc[part];
      if (parts.kind[part] != ordinary || (leaves && is_loose(arc, contract))) continue;
      Recorder image;
      const int side = static_cast<int>(dice.below(4));
      const double low = dice.unit() < 0.3 ? 0.0 : dice.unit();
      const double high = dice.unit() < 0.3 ? 1.0 : low + (1.0 - low) * 0.4 * dice.unit();
      const double heading = 2.0 * pi * dice.unit();
      const double in_x = dice.unit();
      const double in_y = dice.unit();
      if (leaves) {
        behaviours.follow_leaf(part, side, low, high, image);
      } else {
        behaviours.follow_state(part, in_x, in_y, heading, image);
      }
      ++count.images;
      if (image.lost) ++count.lost;
      if (image.lost) continue;
      for (int f = 0; f < 25; ++f) {
        const Cell in = leaves ? p.beyond(side) : p;
        Flown start{.x = p.x + in_x, .y = p.y + in_y, .heading = heading};
        if (leaves) {
          const double where = f % 3 == 0 ? 0.0 : f % 3 == 1 ? 1.0 : dice.unit();
          const Shape place = places_on(side, low + where * (high - low), 2.0);
          start.x = p.x + place.corners()[0].x + (side == 0 ? 1e-9 : side == 2 ? -1e-9 : 0.0);
          start.y = p.y + place.corners()[0].y + (side == 1 ? 1e-9 : side == 3 ? -1e-9 : 0.0);
          double right = 0.0;
          double width = 0.0;
          w.arc_of(p.x, p.y, right, width);
          double least = right;
          double most = right + width;
          if (!point_outwards(side, least, most)) break;
          const double within = f % 4 == 0 ? 0.0 : f % 4 == 1 ? 1.0 : dice.unit();
          start.heading = least + within * (most - least);
          if (touches_end(w, start.x, start.y)) continue;
          const bool leads_in = dice.unit() < 0.7;  // the side held for a far command of the arc
          if (leads_in && start.heading < right + width - w.hold) start.side = 1;
          if (leads_in && start.heading > right + w.hold) start.side = -1;
        }
        const Whim whim{.wants = static_cast<int>(dice.below(3)) - 1,
                        .radius = static_cast<int>(dice.below(3)),
                        .fickle = dice.unit() < 0.5 ? 0.02 : 0.3};
        std::string why;
        Flight flight{.w = w, .parts = parts, .contract = contract, .image = image};
        const Answer answer = flight.fly(start, in, whim, dice.below(1U << 30), why);
        ASSERT_NE(answer, Answer::untold)
            << why << "; world " << seed << " set " << n << " flight " << f << " part " << p.x
            << "," << p.y << " side " << side << " [" << low << ", " << high << "] from ("
            << start.x << ", " << start.y << ") heading " << start.heading << " wants "
            << whim.wants << " radius " << whim.radius;
        count.told += answer == Answer::told ? 1 : 0;
      }
    }
  }
}

TEST(ContractFlight, TellsOfAllThatFlightsFromALeafMeet) {
  Count count;
  attack(random_world, 1, 101, true, count);
  RecordProperty("told", count.told);
  EXPECT_GT(count.told, 8000);
  EXPECT_LT(count.lost, count.images / 4);
}

TEST(ContractFlight, TellsOfThoseThatTurnBackToACommandThatComesNear) {
  Count count;
  attack(turning_back_world, 1, 16, false, count);
  RecordProperty("told", count.told);
  EXPECT_GT(count.told, 3000);
  EXPECT_LT(count.lost, count.images / 4);
}

TEST(ContractFlight, TellsOfAllThatFlightsFromAStateMeet) {
  Count count;
  attack(random_world, 1000, 1100, false, count);
  RecordProperty("told", count.told);
  EXPECT_GT(count.told, 8000);
  EXPECT_LT(count.lost, count.images / 4);
}

}  // namespace
}  // namespace fairway_check
