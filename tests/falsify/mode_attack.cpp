#include "tests/falsify/mode_attack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/proved_modes.hpp"
#include "fairway/simulate/modal_flight.hpp"
#include "fairway/verify/images.hpp"
#include "tests/falsify/wide_modal_flight.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_mode_stories = 20;
constexpr FlightLimits flight_limits{0.0, 40000};

/// The plan that a proof is about: what its flights need.
Plan plan_under(const ProofView& proof) {
  const Flow& flow = proof.flow;
  const std::size_t cells = flow.grid.size();
  Plan plan;
  plan.grid = flow.grid;
  plan.vehicle = flow.vehicle;
  plan.heading_rad.assign(flow.heading_rad, flow.heading_rad + cells);
  plan.mode_heading_rad.assign(proof.further_rad,
                               proof.further_rad + static_cast<std::size_t>(proof.further) * cells);
  for (std::size_t c = 0; c < cells; ++c) {
    plan.region.push_back(flow.kind[c] == CellKind::obstacle ? Region::obstacle
                          : flow.kind[c] == CellKind::target ? Region::goal
                                                             : Region::free);
  }
  return plan;
}

/// Changes where a leaf says so.
class ByLeaves final : public ModeDecider {
 public:
  ByLeaves(const ProofView& proof, int first, Random& random)
      : proof_(proof), first_(first), random_(random) {}
  int begin(const State&) override { return first_; }
  int at_border(const BorderCrossing& crossing, int mode) override {
    if (!crossing.aligned) return mode;
    const Grid& grid = proof_.flow.grid;
    const double units = std::floor(crossing.along_m * (units_per_side / grid.cell_m));
    const auto unit = static_cast<std::uint32_t>(std::clamp(units, 0.0, 0x1p32 - 1.0));
    const std::size_t section =
        4 * grid.index(crossing.left) + static_cast<std::size_t>(crossing.side);
    const SectionView sections = proof_.sections_of(mode);
    std::uint8_t next = no_mode;
    bool any = false;
    sections.for_leaves(section, {unit, unit}, [&](std::size_t leaf) {  // two where they meet
      if (any && random_.below(2) == 0) return;
      next = sections.next_mode[leaf];
      any = true;
    });
    return next == no_mode ? mode : static_cast<int>(next);
  }
  double weaves_m(const BorderCrossing& crossing, int mode) override {
    return weave_within_leaf_m(proof_, crossing, mode);
  }

 private:
  const ProofView& proof_;
  int first_;
  Random& random_;
};

/// Decides by the proof, and keeps what it relies on.
class ByProof final : public ModeDecider {
 public:
  ByProof(const ProofView& proof, std::vector<ModeClaim>& claims)
      : proof_(proof), modes_(proof), claims_(claims) {}
  int begin(const State& start) override { return modes_.begin(start); }
  int at_border(const BorderCrossing& crossing, int mode) override {
    const int next = modes_.at_border(crossing, mode);
    if (next != mode) {
      const Vec2 p = crossing.state.position_m;
      const double h = crossing.state.heading.rad();
      claims_.push_back({p.x, p.y, h, next, ask_mode(proof_, next, p.x, p.y, h).time_s});
    }
    return next;
  }
  double weaves_m(const BorderCrossing& crossing, int mode) override {
    return modes_.weaves_m(crossing, mode);
  }

 private:
  const ProofView& proof_;
  ProvedModes modes_;
  std::vector<ModeClaim>& claims_;
};

class ModeAttacker {
 public:
  explicit ModeAttacker(const ProofView& proof) : proof_(proof), flights_(plan_under(proof)) {
    find_leaves();
  }

  /// Some states drawn, and for some of them those between them and their neighbours.
  void attack_some(Random& random, ModeAttackTotals& totals) {
    const std::uint64_t kind = random.below(8);
    const std::optional<Asked> asked =
        kind == 0 || leaves_.empty() ? any_state(random) : before_leaf(random);
    if (!asked) return;
    const bool proved = attack(*asked, kind == 1, random, totals);
    if (kind == 2) bisect(*asked, proved, random, totals);
  }

 private:
  /// A state, and the mode that is asked; 0: the one that the proof names.
  struct Asked {
    Place at;
    int mode = 0;
  };
  struct Leaf {
    std::uint32_t leaf;
    std::uint32_t section;  // of the further modes, one after another
  };

  /// Those that reach; first the ones beside a leaf that does something else.
  void find_leaves() {
    const SectionView& view = proof_.further_sections;
    const std::size_t sections =
        4 * proof_.flow.grid.size() * static_cast<std::size_t>(proof_.further);
    const auto does = [&](std::size_t i) { return std::pair(view.verdict[i], view.next_mode[i]); };
    std::vector<Leaf> inner;
    for (std::size_t s = 0; s < sections; ++s) {
      for (std::uint32_t i = view.first[s]; i < view.first[s + 1]; ++i) {
        if (view.verdict[i] != static_cast<std::uint8_t>(Verdict::reach)) continue;
        const bool at_end = (i > view.first[s] && does(i - 1) != does(i)) ||
                            (i + 1 < view.first[s + 1] && does(i + 1) != does(i));
        (at_end ? leaves_ : inner).push_back({i, static_cast<std::uint32_t>(s)});
      }
    }
    beside_others_ = leaves_.size();
    leaves_.insert(leaves_.end(), inner.begin(), inner.end());
  }

  /// On the section in a leaf of a further mode, or on the way there.
  std::optional<Asked> before_leaf(Random& random) const {
    const bool beside = beside_others_ > 0 && random.below(4) != 0;
    const Leaf& chosen = leaves_[random.below(beside ? beside_others_ : leaves_.size())];
    const Grid& grid = proof_.flow.grid;
    const double d = grid.cell_m;
    const std::size_t of_mode = chosen.section % (4 * grid.size());
    const int mode = 1 + static_cast<int>(chosen.section / (4 * grid.size()));
    const std::size_t cell = of_mode / 4;
    const auto side = static_cast<Side>(of_mode % 4);
    const SectionView& view = proof_.further_sections;
    const double lo = view.begin[chosen.leaf];
    const double hi = chosen.leaf + 1 < view.first[chosen.section + 1] ? view.begin[chosen.leaf + 1]
                                                                       : units_per_side;
    static constexpr std::array<double, 9> off_units{0.0, 1.0,   -1.0, 2.0, -3.0,
                                                     0.5, 100.0, -1e4, 1e6};
    double units = random.uniform(lo, hi);
    if (random.below(3) != 0) {
      units = (random.below(2) == 0 ? lo : hi) + off_units[random.below(off_units.size())];
    }
    const double along = std::clamp(units * (d / units_per_side), 0.0, d);
    const bool vertical = side == Side::right || side == Side::left;
    const double across = side == Side::right || side == Side::top ? d : 0.0;
    Vec2 p{vertical ? across : along, vertical ? along : across};
    const auto command = static_cast<double>(proof_.flow_of(mode).heading_rad[cell]);
    // Back along the command, within the cell; then turned off it by a little.
    if (random.below(3) != 0) {
      const double back = d * std::exp(-20.0 * random.unit());
      const Vec2 u = Heading::from_rad(command).unit();
      p = {std::clamp(p.x - back * u.x, 0.0, d), std::clamp(p.y - back * u.y, 0.0, d)};
    }
    double heading = command;
    if (random.below(3) == 0)
      heading += random.uniform(-1.5, 1.5) * std::exp(-25.0 * random.unit());
    const Vec2 corner = grid.corner(grid.cell_at(cell));
    return Asked{{corner.x + p.x, corner.y + p.y, Heading::from_rad(heading).rad()}, mode};
  }

  std::optional<Asked> any_state(Random& random) const {
    static constexpr std::array<double, 6> shares{0.0, 1.0, 0.5, 1e-9, 1.0 - 1e-12, 0x1p-33};
    const Grid& grid = proof_.flow.grid;
    const std::size_t cell = random.below(grid.size());
    if (proof_.flow.kind[cell] != CellKind::ordinary) return {};
    const auto share = [&] {
      return random.below(4) == 0 ? shares[random.below(shares.size())] : random.unit();
    };
    const Vec2 corner = grid.corner(grid.cell_at(cell));
    double heading = random.uniform(-pi, pi);
    if (random.below(4) == 0) heading = static_cast<double>(random.below(4)) * (pi / 2);
    const double x = corner.x + share() * grid.cell_m;
    return Asked{{x, corner.y + share() * grid.cell_m, Heading::from_rad(heading).rad()}, 0};
  }

  Place near(const Place& s, Random& random) const {
    const double scale = std::exp(-12.0 * random.unit());
    const Grid& grid = proof_.flow.grid;
    const double d = scale * grid.cell_m;
    return {
        std::clamp(s.x_m + d * random.uniform(-1.0, 1.0), grid.x0_m, grid.x0_m + grid.width_m()),
        std::clamp(s.y_m + d * random.uniform(-1.0, 1.0), grid.y0_m, grid.y0_m + grid.height_m()),
        Heading::from_rad(s.heading_rad + scale * pi * random.uniform(-1.0, 1.0)).rad()};
  }

  /// Between a state that is proved and one that is not.
  void bisect(const Asked& from, bool proved, Random& random, ModeAttackTotals& totals) {
    Asked a = from;
    Asked b{near(from.at, random), from.mode};
    if (attack(b, false, random, totals) == proved) return;
    for (int halving = 0; halving < 40 && totals.wrong() == 0; ++halving) {
      const double turn =
          Heading::from_rad(a.at.heading_rad).turn_to(Heading::from_rad(b.at.heading_rad));
      const Asked middle{{0.5 * (a.at.x_m + b.at.x_m), 0.5 * (a.at.y_m + b.at.y_m),
                          Heading::from_rad(a.at.heading_rad + 0.5 * turn).rad()},
                         from.mode};
      (attack(middle, false, random, totals) == proved ? a : b) = middle;
    }
  }

  /// Whether the state is proved to reach in the mode asked, or in any. Then it is flown.
  bool attack(const Asked& asked, bool by_proof, Random& random, ModeAttackTotals& totals) {
    const Place& at = asked.at;
    ++totals.states;
    ModeClaim claim{at.x_m, at.y_m, at.heading_rad, asked.mode, 0.0};
    if (by_proof || asked.mode == 0) {
      const ProvedState known = ask_all_modes(proof_, at.x_m, at.y_m, at.heading_rad);
      if (known.verdict != Verdict::reach) return false;
      claim.mode = known.mode;
      claim.bound_s = known.time_s;
    } else {
      const VerdictSet found = ask_mode(proof_, asked.mode, at.x_m, at.y_m, at.heading_rad);
      if (found.only() != Verdict::reach) return false;
      claim.bound_s = found.time_s;
    }
    const State start{{at.x_m, at.y_m}, Heading::from_rad(at.heading_rad)};
    std::vector<ModeClaim> claims{claim};
    ModalRun flown;
    if (by_proof) {
      ByProof decider(proof_, claims);
      flown = flights_.run(start, decider, flight_limits);
    } else {
      ByLeaves decider(proof_, claim.mode, random);
      flown = flights_.run(start, decider, flight_limits);
    }
    ++totals.flights;
    totals.by_proof += by_proof ? 1 : 0;
    totals.hand_overs += flown.changes > 0 ? 1 : 0;
    totals.changes += static_cast<std::uint64_t>(flown.changes);
    const bool reached = flown.run.ended_by == EndedBy::goal;
    if (!reached || flown.run.result.time_s * (1.0 - 1e-9) > claim.bound_s) {
      judge(claims, flown, totals);
    }
    return true;
  }

  void judge(const std::vector<ModeClaim>& claims, const ModalRun& flown,
             ModeAttackTotals& totals) {
    WideJudgement all;
    {
      const std::lock_guard lock(mutex_);
      if (!wide_) wide_ = std::make_unique<WideModalFlights>(proof_);
    }
    for (const ModeClaim& claim : claims) {
      const WideJudgement one = wide_->judge(claim);
      all.contradicted = all.contradicted || one.contradicted;
      all.late = all.late || one.late;
      all.unknown = all.unknown || one.unknown;
      all.ends +=
          fmt::format(" from {:.17g},{:.17g},{:.17g} in mode {} within {:.9g} s:{}", claim.x_m,
                      claim.y_m, claim.heading_rad, claim.mode, claim.bound_s, one.ends);
    }
    (all.contradicted ? totals.contradictions
     : all.late       ? totals.late
     : all.unknown    ? totals.unknown
                      : totals.refuted) += 1;
    if (totals.stories.size() == most_mode_stories) return;
    totals.stories.push_back(fmt::format(
        "{}: flown {} in {:.9g} s through {} changes ({} cells, ended by {}); in 237 bits{}",
        all.contradicted ? "CONTRADICTION"
        : all.late       ? "LATE"
        : all.unknown    ? "unknown"
                         : "refuted",
        name_of(flown.run.result.outcome), flown.run.result.time_s, flown.changes,
        flown.run.crossings, static_cast<int>(flown.run.ended_by), all.ends));
  }

  const ProofView proof_;
  const ModalFlights flights_;
  std::vector<Leaf> leaves_;
  std::size_t beside_others_ = 0;  // the first so many of them
  std::mutex mutex_;
  std::unique_ptr<WideModalFlights> wide_;  // made when first needed
};

}  // namespace

void ModeAttackTotals::add(const ModeAttackTotals& other) {
  states += other.states;
  flights += other.flights;
  hand_overs += other.hand_overs;
  by_proof += other.by_proof;
  changes += other.changes;
  contradictions += other.contradictions;
  late += other.late;
  refuted += other.refuted;
  unknown += other.unknown;
  for (const std::string& story : other.stories) {
    if (stories.size() < most_mode_stories) stories.push_back(story);
  }
}

std::string ModeAttackTotals::line() const {
  return fmt::format(
      "{} states, {} flights ({} by the proof), {} through hand-overs with {} changes; {} "
      "contradictions, {} late, {} refuted in 237 bits, {} unknown",
      states, flights, by_proof, hand_overs, changes, contradictions, late, refuted, unknown);
}

ModeAttackTotals attack_modes(const ProofView& proof, const ModeAttackOptions& options) {
  require(proof.further > 0, "a proof of several modes is attacked");
  constexpr std::uint64_t blocks = 32;  // at a time, each with draws of its own
  constexpr std::uint64_t draws = 64;
  // Of a block: the judge takes its time.
  const std::uint64_t judged_enough = std::min<std::uint64_t>(4, options.wrong_enough);
  ModeAttacker attacker(proof);
  ModeAttackTotals totals;
  std::uint64_t first = 0;
  const auto goes_on = [&] {
    return totals.hand_overs < options.hand_overs && totals.wrong() < options.wrong_enough &&
           (options.states == 0 || totals.states < options.states) &&
           options.progress(totals.flights, totals.wrong());
  };
  // A proof that says nothing of further modes hands nothing over.
  for (int idle = 0; goes_on() && idle < 20; first += blocks) {
    std::vector<ModeAttackTotals> each(blocks);
    for_ranges(blocks, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = begin; block < end; ++block) {
        Random random = Random::stream(options.seed, first + block);
        ModeAttackTotals& one = each[block];
        for (std::uint64_t k = 0; k < draws && one.wrong() + one.unknown < judged_enough; ++k) {
          attacker.attack_some(random, one);
        }
      }
    });
    const std::uint64_t before = totals.hand_overs;
    for (const ModeAttackTotals& one : each) totals.add(one);
    idle = totals.hand_overs > before ? 0 : idle + 1;
  }
  return totals;
}

}  // namespace fairway
