#include "tests/falsify/follow_attack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

constexpr int laps_flown = 3;
constexpr int each = 6;  // flights from a state
constexpr std::size_t most_follow_stories = 20;
constexpr double rounding = 1e-6;  // of flights in doubles, in metres and rad

class FollowAttacker {
 public:
  explicit FollowAttacker(const ContractCertificate& certificate)
      : c_(certificate),
        ground_(over_ground(certificate.contract)),
        parts_(certificate.parts()),
        path_(certificate.follow->path),
        flow_(certificate.flow()),
        choices_(flow_, certificate.contract),
        guide_(choices_),
        pilot_(choices_, &guide_) {}

  void attack_some(Random& random, FollowAttackTotals& totals) const {
    const State start = random_state(random);
    ++totals.states;
    const ContractAnswer answer =
        contract_answer(c_.grid, parts_, c_.verdicts, ground_.speed_mps.least, start.position_m,
                        start.heading.rad());
    if (answer.verdict != Verdict::reach) return;
    static constexpr std::array adversaries{Adversary::random, Adversary::greedy,
                                            Adversary::circling, Adversary::guided};
    for (int k = 0; k < each; ++k) {
      const std::uint64_t seed = random.bits();
      const Adversary adversary = adversaries[random.below(adversaries.size())];
      fly(start, answer.worst_time_s, adversary, seed, totals);
    }
  }

 private:
  State random_state(Random& random) const {
    std::size_t cell = random.below(c_.grid.size());
    for (int k = 0; k < 1000 && c_.kind[cell] != CellKind::ordinary; ++k) {
      cell = random.below(c_.grid.size());
    }
    const Vec2 low = c_.grid.corner(c_.grid.cell_at(cell));
    return {low + c_.grid.cell_m * Vec2{random.unit(), random.unit()},
            Heading::from_rad(random.uniform(-pi, pi))};
  }

  /// "" or what of the tube is wrong at a place.
  std::string out_of_tube(Vec2 place, double heading_rad) const {
    const double side = parts_.part_m();
    const Vec2 off = (1.0 / side) * (place - Vec2{c_.grid.x0_m, c_.grid.y0_m});
    const Vec2 middle = Vec2{c_.grid.x0_m, c_.grid.y0_m} +
                        side * Vec2{std::floor(off.x) + 0.5, std::floor(off.y) + 0.5};
    const std::vector<TubeStretch>& tube = c_.follow->tube;
    const double along = path_.frame(middle).station_m / path_.length_m();
    const auto k = std::min(tube.size() - 1,
                            static_cast<std::size_t>(along * static_cast<double>(tube.size())));
    const PathFrame frame = path_.frame(place);
    const double turned =
        std::remainder(heading_rad - std::atan2(frame.tangent.y, frame.tangent.x), 2.0 * pi);
    if (std::abs(frame.offset_m) > static_cast<double>(tube[k].distance_m) + rounding) {
      return fmt::format("{:.6g} m from the path, {:.6g} m proved", std::abs(frame.offset_m),
                         tube[k].distance_m);
    }
    if (std::abs(turned) > static_cast<double>(tube[k].off_rad) + rounding) {
      return fmt::format("{:.6g} rad off the path, {:.6g} proved", std::abs(turned),
                         tube[k].off_rad);
    }
    return "";
  }

  void tell(const State& s, Adversary adversary, std::uint64_t seed, const std::string& what,
            FollowAttackTotals& totals) const {
    if (totals.stories.size() >= most_follow_stories) return;
    totals.stories.push_back(fmt::format("state {:.17g},{:.17g},{:.17g}, {} flight of seed {}: {}",
                                         s.position_m.x, s.position_m.y, s.heading.rad(),
                                         name_of(adversary), seed, what));
  }

  void fly(const State& start, double join_s, Adversary adversary, std::uint64_t seed,
           FollowAttackTotals& totals) const {
    ++totals.flights;
    const bool closed = path_.path().closed;
    const double slow = ground_.speed_mps.least;
    const double join_m = join_s * slow;
    const double lap_m = c_.follow->stages.lap_most_s * slow;
    const double limit_m = join_m + (closed ? laps_flown : 1) * lap_m;
    // Most go round in hardly more than the path's length: no longer flights are needed to see it.
    const double enough_m = join_m + (laps_flown + 1) * path_.length_m();
    BehaviourFlight flight{start, {}};
    BehaviourRun run;
    for (const double most_m : {std::min(enough_m, limit_m), limit_m}) {
      flight.steps.clear();
      run = pilot_.fly(start, adversary, seed, most_m, &flight.steps);
      if (closed && goes_round(flight, join_m)) break;
    }
    if (run.outcome == Outcome::collide || run.outcome == Outcome::leave) {
      ++totals.ended;
      return tell(start, adversary, seed, "touches something", totals);
    }
    if (!closed && run.outcome != Outcome::reach) {
      ++totals.late;
      return tell(start, adversary, seed, "does not come to the end in time", totals);
    }
    look_at_laps(flight, join_m, adversary, seed, totals);
  }

  /// As often as is looked at.
  bool goes_round(const BehaviourFlight& flight, double join_m) const {
    Vec2 place = flight.start.position_m;
    double heading = flight.start.heading.rad();
    double flown_m = 0.0;
    double round_m = 0.0;
    double station_m = -1.0;
    for (const BehaviourStep& step : flight.steps) {
      place = place + move_of(step, heading);
      flown_m += length_of(step, heading);
      heading = step.heading_rad;
      if (flown_m < join_m) continue;
      const double now_m = path_.frame(place).station_m;
      if (station_m >= 0.0) round_m += std::remainder(now_m - station_m, path_.length_m());
      station_m = now_m;
    }
    return round_m >= laps_flown * path_.length_m();
  }

  void look_at_laps(const BehaviourFlight& flight, double join_m, Adversary adversary,
                    std::uint64_t seed, FollowAttackTotals& totals) const {
    const LapStages& stages = c_.follow->stages;
    const double length_m = path_.length_m();
    // Laps are measured at a station, and proved at places where stages begin.
    const double beside_m = 8.0 * parts_.part_m();
    Vec2 place = flight.start.position_m;
    double heading = flight.start.heading.rad();
    double flown_m = 0.0;
    double lap_began_m = -1.0;
    double round_m = 0.0;
    double station_m = 0.0;
    int laps = 0;
    for (const BehaviourStep& step : flight.steps) {
      place = place + move_of(step, heading);
      flown_m += length_of(step, heading);
      heading = step.heading_rad;
      if (flown_m < join_m) continue;
      if (const std::string why = out_of_tube(place, heading); !why.empty()) {
        ++totals.strayed;
        return tell(flight.start, adversary, seed, why, totals);
      }
      if (!path_.path().closed) continue;
      const double now_m = path_.frame(place).station_m;
      if (lap_began_m < 0.0) {
        lap_began_m = flown_m;
      } else {
        round_m += std::remainder(now_m - station_m, length_m);
      }
      station_m = now_m;
      const double lap_m = flown_m - lap_began_m;
      const bool late = lap_m > stages.lap_most_s * ground_.speed_mps.least + beside_m;
      const bool done = round_m >= length_m;
      const bool early = done && lap_m < stages.lap_least_s * ground_.speed_mps.most - beside_m;
      if (late || early) {
        ++totals.late;
        return tell(flight.start, adversary, seed, fmt::format("a lap of {:.6g} m", lap_m), totals);
      }
      if (!done) continue;
      ++totals.laps;
      totals.longest_lap_s = std::max(totals.longest_lap_s, lap_m / ground_.speed_mps.least);
      const double short_s = lap_m / ground_.speed_mps.most;
      totals.shortest_lap_s =
          totals.shortest_lap_s == 0.0 ? short_s : std::min(totals.shortest_lap_s, short_s);
      if (++laps == laps_flown) return;
      round_m -= length_m;
      lap_began_m = flown_m;
    }
  }

  const ContractCertificate& c_;
  VehicleContract ground_;
  Parts parts_;
  PathLocator path_;
  Flow flow_;
  BehaviourChoices choices_;
  FailureGuide guide_;
  BehaviourPilot pilot_;
};

void add(FollowAttackTotals& to, const FollowAttackTotals& from) {
  to.states += from.states;
  to.flights += from.flights;
  to.laps += from.laps;
  to.ended += from.ended;
  to.strayed += from.strayed;
  to.late += from.late;
  to.longest_lap_s = std::max(to.longest_lap_s, from.longest_lap_s);
  if (from.shortest_lap_s > 0.0) {
    to.shortest_lap_s = to.shortest_lap_s == 0.0 ? from.shortest_lap_s
                                                 : std::min(to.shortest_lap_s, from.shortest_lap_s);
  }
  for (const std::string& story : from.stories) {
    if (to.stories.size() < most_follow_stories) to.stories.push_back(story);
  }
}

}  // namespace

std::string FollowAttackTotals::line() const {
  return fmt::format(
      "{} touched something, {} left the tube, {} were late or early: of {} flights from {} states "
      "asked; {} laps of {:.4g} to {:.4g} s",
      ended, strayed, late, flights, states, laps, shortest_lap_s, longest_lap_s);
}

FollowAttackTotals attack_following(const ContractCertificate& certificate, std::uint64_t flights,
                                    std::uint64_t seed, const AttackProgress& progress) {
  require(certificate.follow.has_value(), "the certificate says that a path is followed");
  const FollowAttacker attacker(certificate);
  FollowAttackTotals totals;
  std::mutex adding;
  constexpr std::size_t batch = 64;
  // Where nobody follows it gives up after as many states as flights were asked for.
  for (std::uint64_t item = 0;
       totals.flights < flights && totals.states < std::max<std::uint64_t>(flights, 1000) &&
       progress(totals.flights, totals.wrong());
       item += batch) {
    for_ranges(batch, 4, [&](std::size_t begin, std::size_t end) {
      FollowAttackTotals here;
      for (std::size_t i = begin; i < end; ++i) {
        Random random = Random::stream(seed, item + i);
        attacker.attack_some(random, here);
      }
      const std::lock_guard lock(adding);
      add(totals, here);
    });
  }
  return totals;
}

}  // namespace fairway
