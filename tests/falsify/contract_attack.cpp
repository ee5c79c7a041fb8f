#include "tests/falsify/contract_attack.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "fairway/base/parallel.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/behaviour/proved_ends.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_stories = 20;

/// Attacks on one thread.
class Attacker {
 public:
  Attacker(const std::string& name, const BehaviourChoices& choices, const FailureGuide& guide,
           const BehaviourPilot& pilot, const ContractVerdictOf& verdict_of,
           const ContractAttackOptions& options, std::uint64_t item)
      : name_(name),
        choices_(choices),
        pilot_(pilot),
        search_(choices, guide),
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
    for (int k = 0; k < options_.halvings; ++k) {
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
    static constexpr std::array turns{Adversary::greedy, Adversary::random,   Adversary::guided,
                                      Adversary::greedy, Adversary::circling, Adversary::random};
    for (int k = 0; k < flights; ++k) {
      const std::uint64_t seed = random_.bits();
      BehaviourFlight flight{s, {}};
      ++totals_.flights;
      if (k == 0 && answer.verdict == Verdict::reach) {
        if (auto found = search_.find(s, {200, 20, 1, 0}, seed)) {
          judge(*found, answer, seed, "search");
          continue;
        }
      }
      const Adversary adversary = turns[random_.below(turns.size())];
      const BehaviourRun run = pilot_.fly(s, adversary, seed, 0.0, &flight.steps);
      const double least_mps = choices_.contract().speed_mps.least;
      const bool other = static_cast<int>(run.outcome) != static_cast<int>(answer.verdict);
      const bool late = answer.verdict == Verdict::reach &&
                        run.length_m / least_mps > answer.time_bound_s * (1.0 + 1e-9);
      if (other || late) judge(flight, answer, seed, name_of(adversary));
    }
  }

  void judge(BehaviourFlight flight, const ContractClaim& answer, std::uint64_t seed,
             const char* adversary) {
    const ProvedEnds ends =
        proved_ends(choices_.flow(), choices_.commands(), choices_.contract(), flight);
    const double time_s = ends.length_m / choices_.contract().speed_mps.least;
    const bool contradicts = ends.admissible && ends.ends != 0 && !ends.may_be(answer.verdict);
    // A flight without an end, or with that of the verdict, may still take longer than is proved.
    const bool late = ends.admissible && answer.verdict == Verdict::reach && !contradicts &&
                      (ends.ends == 0 || ends.surely(Verdict::reach)) &&
                      still_flying_at(flight, answer.time_bound_s);
    if (contradicts) {
      ++totals_.contradictions;
    } else if (late) {
      ++totals_.late;
    } else {
      ++totals_.unproved;
      return;
    }
    if (totals_.stories.size() >= most_stories) return;
    totals_.stories.push_back(fmt::format(
        "{} {}: state {:.17g},{:.17g},{:.17g}: proved {} (within {:.9g} s); {} flight of seed {} "
        "ends with {:#x} after {:.9g} s",
        contradicts ? "CONTRADICTION" : "LATE", name_, flight.start.position_m.x,
        flight.start.position_m.y, flight.start.heading.rad(), name_of(answer.verdict),
        answer.time_bound_s, adversary, seed, ends.ends, time_s));
  }

  /// Whether at the slowest speed no goal cell was touched by then.
  bool still_flying_at(BehaviourFlight flight, double time_s) const {
    const double most_m = time_s * (1.0 + 1e-9) * choices_.contract().speed_mps.least;
    double flown_m = 0.0;
    Vec2 place = flight.start.position_m;
    double heading = flight.start.heading.rad();
    for (const BehaviourStep& step : flight.steps) {
      const Vec2 end = place + move_of(step, heading);
      if (choices_.met(place, end) != CellKind::ordinary) return false;
      flown_m += length_of(step, heading);
      if (flown_m > most_m) return true;
      place = end;
      heading = step.heading_rad;
    }
    return false;
  }

  const std::string& name_;
  const BehaviourChoices& choices_;
  const BehaviourPilot& pilot_;
  WitnessSearch search_;
  const ContractVerdictOf& verdict_of_;
  const ContractAttackOptions& options_;
  Random random_;
  ContractAttackTotals totals_;
};

}  // namespace

void ContractAttackTotals::add(const ContractAttackTotals& other) {
  states += other.states;
  aimed += other.aimed;
  flights += other.flights;
  contradictions += other.contradictions;
  late += other.late;
  unproved += other.unproved;
  for (std::size_t v = 0; v < by_verdict.size(); ++v) by_verdict[v] += other.by_verdict[v];
  for (const std::string& story : other.stories) {
    if (stories.size() < most_stories) stories.push_back(story);
  }
}

std::string ContractAttackTotals::line() const {
  std::string text = fmt::format("{} flights ({} from beside boundaries), {} states asked (",
                                 flights, aimed, states);
  for (const Verdict verdict : verdicts_in_order) {
    text += fmt::format("{}{} {}", verdict == verdicts_in_order[0] ? "" : ", ",
                        by_verdict[static_cast<std::size_t>(verdict)], name_of(verdict));
  }
  return text + fmt::format("); {} contradictions, {} late, {} not proved", contradictions, late,
                            unproved);
}

ContractAttackTotals attack(const std::string& name, const Flow& flow,
                            const VehicleContract& contract, const ContractVerdictOf& verdict_of,
                            const ContractAttackOptions& options) {
  const BehaviourChoices choices(flow, contract);
  const FailureGuide guide(choices);
  const BehaviourPilot pilot(choices, &guide);
  ContractAttackTotals totals;
  std::mutex adding;
  constexpr std::size_t batch = 16;
  // A plan with nothing proved is given up after as many states as flights were asked for.
  for (std::uint64_t item = 0;
       totals.flights < options.flights && totals.states < 4 * options.flights; item += batch) {
    for_ranges(batch, 2, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Attacker attacker(name, choices, guide, pilot, verdict_of, options, item + i);
        for (int k = 0; k < 8; ++k) attacker.attack_some();
        const std::lock_guard lock(adding);
        totals.add(attacker.totals());
      }
    });
  }
  return totals;
}

}  // namespace fairway
