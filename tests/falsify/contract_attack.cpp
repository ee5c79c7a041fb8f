#include "tests/falsify/contract_attack.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/behaviour/proved_ends.hpp"
#include "tests/falsify/attack_pilot.hpp"
#include "tests/falsify/cut_flight.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_stories = 20;

/// What flies, for all threads: with steps of the usual length, and of twice that.
struct Pilots {
  Pilots(const Flow& flow, const VehicleContract& contract)
      : usual(flow, contract),
        longer(flow, contract, 2.0 * usual.step_m()),
        guide(usual),
        obstacles(flow),
        by_usual(usual, guide, obstacles),
        by_longer(longer, guide, obstacles),
        trapped_m(BehaviourPilot(usual).default_limit_m()) {}

  BehaviourChoices usual;
  BehaviourChoices longer;
  FailureGuide guide;
  NearestObstacle obstacles;
  AttackPilot by_usual;
  AttackPilot by_longer;
  double trapped_m;  ///< who flies so far counts as trapped
};

/// Attacks on one thread.
class Attacker {
 public:
  Attacker(const std::string& name, const Pilots& pilots, WitnessSearch& search,
           const ContractVerdictOf& verdict_of, const ContractAttackOptions& options,
           std::uint64_t item)
      : name_(name),
        pilots_(pilots),
        choices_(pilots.usual),
        search_(search),
        verdict_of_(verdict_of),
        options_(options),
        random_(Random::stream(options.seed, item)) {}

  /// From a state at random, and as many from both sides of a boundary between it and another one.
  void attack_some() {
    const State a = random_state();
    const ContractClaim claim_a = ask(a);
    attack(a, claim_a, options_.each);
    for (int tries = 0; tries < 8; ++tries) {
      const State b = tries % 2 == 0 ? near(a) : random_state();
      const ContractClaim claim_b = ask(b);
      if (claim_b.verdict == claim_a.verdict) continue;
      attack_between(a, claim_a, b, claim_b);
      return;
    }
  }

  const ContractAttackTotals& totals() const { return totals_; }

 private:
  double degenerate_share() {
    static constexpr std::array<double, 6> shares{0.0, 1.0, 0.5, 1e-9, 1.0 - 1e-9, 0.25};
    return random_.below(4) != 0 ? random_.unit() : shares[random_.below(shares.size())];
  }

  State random_state() {
    const Flow& flow = choices_.flow();
    std::size_t cell = random_.below(flow.grid.size());
    for (int k = 0; k < 1000 && flow.kind[cell] != CellKind::ordinary; ++k) {
      cell = random_.below(flow.grid.size());
    }
    const Vec2 low = flow.grid.corner(flow.grid.cell_at(cell));
    double heading = random_.uniform(-pi, pi);
    const auto style = random_.below(10);
    const double command = static_cast<double>(choices_.commands()[cell]);
    if (style == 0) heading = 0.5 * pi * static_cast<double>(random_.below(4));
    if (style == 1 && !std::isnan(command)) heading = command + pi;
    if (style == 2 && !std::isnan(command)) heading = command;
    return {low + flow.grid.cell_m * Vec2{degenerate_share(), degenerate_share()},
            Heading::from_rad(heading)};
  }

  State near(const State& s) {
    const double scale = std::exp(-6.0 * random_.unit());
    const double d = choices_.flow().grid.cell_m * scale;
    const Grid& g = choices_.flow().grid;
    const Vec2 p =
        s.position_m + Vec2{d * random_.uniform(-1.0, 1.0), d * random_.uniform(-1.0, 1.0)};
    return {{std::clamp(p.x, g.x0_m, g.x0_m + g.width_m()),
             std::clamp(p.y, g.y0_m, g.y0_m + g.height_m())},
            Heading::from_rad(s.heading.rad() + scale * random_.uniform(-pi, pi))};
  }

  ContractClaim ask(const State& s) {
    ++totals_.states;
    const ContractClaim answer = verdict_of_(s);
    ++totals_.by_verdict[static_cast<std::size_t>(answer.verdict)];
    return answer;
  }

  void attack_between(State a, ContractClaim answer_a, State b, ContractClaim answer_b) {
    const auto halvings = random_.below(static_cast<std::uint64_t>(options_.halvings));
    for (std::uint64_t k = 0; k <= halvings; ++k) {
      const State middle{0.5 * (a.position_m + b.position_m),
                         Heading::from_rad(a.heading.rad() + 0.5 * a.heading.turn_to(b.heading))};
      const ContractClaim answer = ask(middle);
      const bool like_a = answer.verdict == answer_a.verdict;
      (like_a ? a : b) = middle;
      (like_a ? answer_a : answer_b) = answer;
    }
    const std::uint64_t before = totals_.flights;
    attack(a, answer_a, options_.each);
    attack(b, answer_b, options_.each);
    totals_.aimed += totals_.flights - before;
  }

  void attack(const State& s, const ContractClaim& answer, int flights) {
    if (answer.verdict == Verdict::undecided) return;
    for (int k = 0; k < flights; ++k) {
      ++totals_.flights;
      if (k == 0 && answer.verdict == Verdict::reach) {
        if (auto found = search_.find(s, {200, 20, 1, 0}, random_.bits())) {
          ++totals_.searched;
          judge(*found, answer, "search");
          continue;
        }
      }
      attack_once(s, answer);
    }
  }

  double late_after_m(const ContractClaim& answer) const {
    return choices_.contract().speed_mps.least * answer.time_bound_s * (1.0 + 1e-9);
  }

  void attack_once(const State& s, const ContractClaim& answer) {
    static constexpr std::array turns{Adversary::greedy, Adversary::random,   Adversary::guided,
                                      Adversary::greedy, Adversary::circling, Adversary::random};
    const Adversary adversary = turns[random_.below(turns.size())];
    const bool whole = random_.below(options_.whole_one_in) == 0;
    const AttackPilot& pilot = random_.below(2) == 0 ? pilots_.by_usual : pilots_.by_longer;
    const double limit_m = answer.verdict == Verdict::reach
                               ? std::min(late_after_m(answer) * (1.0 + 1e-8), pilots_.trapped_m)
                           : whole ? pilots_.trapped_m
                                   : 0.125 * pilots_.trapped_m;
    const double radius_m = choices_.contract().turn_radius_m.most;
    double asks_m = radius_m * (0.5 - 3.0 * std::log(1.0 - random_.unit()));
    const auto is_known = [&](const BehaviourState&, const BehaviourChoice& step, double flown_m) {
      if (flown_m < asks_m || step.end.held != 0) return false;
      asks_m = flown_m + 2.0 * radius_m;
      const State now{step.end.place, Heading::from_rad(step.end.heading_rad)};
      const ContractClaim there =
          options_.claimed_there ? options_.claimed_there(now) : verdict_of_(now);
      return there.verdict == answer.verdict;
    };
    flight_.start = s;
    flight_.steps.clear();
    const AttackRun run = pilot.fly(BehaviourState::of(s), adversary, random_, limit_m,
                                    flight_.steps, whole ? AttackPilot::Watch() : is_known);
    if (run.stopped) {
      ++totals_.handed_on;
      return;
    }
    const bool other = static_cast<int>(run.outcome) != static_cast<int>(answer.verdict);
    const bool late = answer.verdict == Verdict::reach && run.length_m > late_after_m(answer);
    if (other || late) judge(flight_, answer, name_of(adversary));
  }

  void judge(const BehaviourFlight& flown, const ContractClaim& answer, const char* adversary) {
    const auto [flight, end] = until_it_ends(choices_, flown);
    const ProvedEnds ends =
        proved_ends(choices_.flow(), choices_.commands(), choices_.contract(), flight);
    const double time_s = ends.length_m / choices_.contract().speed_mps.least;
    const bool contradicts = ends.admissible && ends.ends != 0 && !ends.may_be(answer.verdict);
    // A flight without an end, or with that of the verdict, may still take longer than is proved.
    const bool late = ends.admissible && answer.verdict == Verdict::reach && !contradicts &&
                      (ends.ends == 0 || ends.surely(Verdict::reach)) &&
                      is_still_flying_at(pilots_.longer, flight, late_after_m(answer));
    if (contradicts) {
      ++totals_.contradictions;
    } else if (late) {
      ++totals_.late;
    } else {
      const bool as_claimed = end != CellKind::ordinary && ends.admissible &&
                              static_cast<int>(outcome_of(end)) == static_cast<int>(answer.verdict);
      ++(as_claimed ? totals_.refuted : totals_.unproved);
      return;
    }
    if (totals_.stories.size() >= most_stories) return;
    totals_.stories.push_back(
        fmt::format("{} {}: state {:.17g},{:.17g},{:.17g}: proved {} (within {:.9g} s); {} flight "
                    "ends with {:#x} after {:.9g} s",
                    contradicts ? "CONTRADICTION" : "LATE", name_, flight.start.position_m.x,
                    flight.start.position_m.y, flight.start.heading.rad(), name_of(answer.verdict),
                    answer.time_bound_s, adversary, ends.ends, time_s));
  }

  const std::string& name_;
  const Pilots& pilots_;
  const BehaviourChoices& choices_;
  WitnessSearch& search_;
  const ContractVerdictOf& verdict_of_;
  const ContractAttackOptions& options_;
  Random random_;
  BehaviourFlight flight_;
  ContractAttackTotals totals_;
};

}  // namespace

void ContractAttackTotals::add(const ContractAttackTotals& other) {
  states += other.states;
  aimed += other.aimed;
  flights += other.flights;
  handed_on += other.handed_on;
  searched += other.searched;
  contradictions += other.contradictions;
  late += other.late;
  refuted += other.refuted;
  unproved += other.unproved;
  for (std::size_t v = 0; v < by_verdict.size(); ++v) by_verdict[v] += other.by_verdict[v];
  for (const std::string& story : other.stories) {
    if (stories.size() < most_stories) stories.push_back(story);
  }
}

std::string ContractAttackTotals::line() const {
  std::string text = fmt::format(
      "{} flights ({} from beside boundaries, {} found by search; {} ended where the same was "
      "claimed), "
      "{} "
      "states asked (",
      flights, aimed, searched, handed_on, states);
  for (const Verdict verdict : verdicts_in_order) {
    text += fmt::format("{}{} {}", verdict == verdicts_in_order[0] ? "" : ", ",
                        by_verdict[static_cast<std::size_t>(verdict)], name_of(verdict));
  }
  return text + fmt::format(
                    "); {} contradictions, {} late, {} ended as claimed between steps, {} "
                    "not proved",
                    contradictions, late, refuted, unproved);
}

ContractAttackTotals attack(const std::string& name, const Flow& flow,
                            const VehicleContract& contract, const ContractVerdictOf& verdict_of,
                            const ContractAttackOptions& options) {
  const Pilots pilots(flow, contract);
  ContractAttackTotals totals;
  std::mutex adding;
  bool go_on = true;
  constexpr std::uint64_t states_each = 8;
  const std::uint64_t flights_each = 3 * states_each * static_cast<std::uint64_t>(options.each);
  // A plan with nothing proved is given up after as many states as flights were asked for.
  for (std::uint64_t item = 0;
       go_on && totals.flights < options.flights && totals.states < 4 * options.flights;) {
    // Many at a time, so that no thread waits for long for another one's last.
    const std::uint64_t batch =
        std::clamp<std::uint64_t>((options.flights - totals.flights) / flights_each, 4, 512);
    for_ranges(batch, 1, [&](std::size_t begin, std::size_t end) {
      WitnessSearch search(pilots.usual, pilots.guide);
      for (std::size_t i = begin; i < end; ++i) {
        Attacker attacker(name, pilots, search, verdict_of, options, item + i);
        for (std::uint64_t k = 0; k < states_each; ++k) attacker.attack_some();
        const std::lock_guard lock(adding);
        totals.add(attacker.totals());
        go_on = go_on && options.progress(totals.flights, totals.wrong());
        if (!go_on) return;
      }
    });
    item += batch;
  }
  return totals;
}

}  // namespace fairway
