#include "tests/falsify/contract_mode_attack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/behaviour/proved_ends.hpp"
#include "fairway/inclusion/set_flight.hpp"
#include "tests/falsify/attacked_modes.hpp"
#include "tests/falsify/contract_mode_flight.hpp"
#include "tests/falsify/cut_flight.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_contract_mode_stories = 20;

/// Where flights begin, and what is claimed there.
struct ModeStart {
  State state;
  int mode = 0;
  double bound_s = 0.0;
};

/// On one thread.
class ContractModeAttacker {
 public:
  ContractModeAttacker(const AttackedModes& modes, const ContractModeAttackOptions& options,
                       std::uint64_t item)
      : modes_(modes), options_(options), random_(Random::stream(options.seed, item)) {
    for (int mode = 1; mode < modes.count(); ++mode) {
      if (!modes.mode(mode).leaves.empty()) handing_over_.push_back(mode);
    }
  }

  void attack_some() {
    if (random_.below(2) == 0 && !handing_over_.empty()) {
      const bool at_once = random_.below(3) == 0;
      const std::optional<ModeStart> start = at_once ? handed_over() : before_leaf();
      if (!start) return;
      for (int k = 0; k < flights_each; ++k) attack(*start, true, at_once);
      return;
    }
    const State state = any_state();
    if (random_.below(16) == 0) attack_by_loop(state);
    if (const std::optional<ModeStart> start = claimed_at(state)) {
      for (int k = 0; k < flights_each; ++k) attack(*start, false, false);
    }
  }

  const ContractModeAttackTotals& totals() const { return totals_; }

 private:
  static constexpr int flights_each = 4;

  const Flow& flow() const { return modes_.mode(0).flow; }

  State any_state() {
    const Grid& g = flow().grid;
    std::size_t cell = random_.below(g.size());
    for (int k = 0; k < 1000 && flow().kind[cell] != CellKind::ordinary; ++k) {
      cell = random_.below(g.size());
    }
    const Vec2 low = g.corner(g.cell_at(cell));
    return {low + g.cell_m * Vec2{random_.unit(), random_.unit()},
            Heading::from_rad(random_.uniform(-pi, pi))};
  }

  std::optional<ModeStart> claimed_in(int mode, const State& state) {
    ++totals_.states;
    const ContractAnswer answer = modes_.mode(mode).claim(state);
    if (answer.verdict != Verdict::reach) return {};
    return ModeStart{state, mode, answer.worst_time_s};
  }

  /// Of the first mode that is proved, as a query says; or of any.
  std::optional<ModeStart> claimed_at(const State& state) {
    const auto modes = static_cast<std::uint64_t>(modes_.count());
    if (random_.below(2) == 0) return claimed_in(static_cast<int>(random_.below(modes)), state);
    for (int mode = 0; mode < modes_.count(); ++mode) {
      if (const auto start = claimed_in(mode, state)) return start;
    }
    return {};
  }

  struct AtLeaf {
    int mode;
    const HandedLeaf* leaf;
    Vec2 place_m;
    double heading_rad;  ///< one of the arc that leads out
  };

  std::optional<AtLeaf> at_leaf() {
    const int mode = handing_over_[random_.below(handing_over_.size())];
    const AttackedMode& m = modes_.mode(mode);
    const bool beside = m.beside_others > 0 && random_.below(4) != 0;
    const HandedLeaf& leaf = m.leaves[random_.below(beside ? m.beside_others : m.leaves.size())];
    static constexpr std::array<double, 6> shares{0.0, 1.0, 1e-4, 1.0 - 1e-4, 0.02, 0.98};
    const double share = beside ? shares[random_.below(shares.size())] : random_.unit();
    const auto side = static_cast<std::size_t>(leaf.side);
    const double along = leaf.lo + share * (leaf.hi - leaf.lo);
    const auto ends = segment_of_side(leaf.part, leaf.side, along, along).box();
    const Grid& g = m.flow.grid;
    AtLeaf at{mode, &leaf, Vec2{g.x0_m, g.y0_m} + m.parts.part_m() * ends.lowest, 0.0};
    const HeadingArc& arc = m.parts.arc(leaf.part);
    for (int k = 0; k < 8; ++k) {
      const double of_arc =
          random_.below(3) == 0 ? static_cast<double>(random_.below(2)) : random_.unit();
      at.heading_rad = arc.lo_rad + of_arc * arc.width_rad;
      const Vec2 out = side_axes[side].outward;
      if (out.x * std::cos(at.heading_rad) + out.y * std::sin(at.heading_rad) > 1e-9) return at;
    }
    return {};
  }

  /// As handed over: within twice the error of the leaf.
  std::optional<ModeStart> handed_over() {
    const std::optional<AtLeaf> found = at_leaf();
    if (!found) return {};
    const AtLeaf& at = *found;
    const double towards = random_.uniform(-pi, pi);
    const double far = random_.below(2) == 0 ? 1.0 : random_.unit();
    const double off =
        random_.below(2) == 0 ? (random_.below(2) == 0 ? 1.0 : -1.0) : random_.uniform(-1.0, 1.0);
    const Vec2 place = at.place_m + 2.0 * nearly * far * modes_.error.place_m *
                                        Vec2{std::cos(towards), std::sin(towards)};
    // Where nothing is claimed, a flight has ended.
    if (modes_.mode(0).choices.surely_in(place) != CellKind::ordinary) return {};
    if (flow().kind_at(flow().grid.cell_of(place)) != CellKind::ordinary) return {};
    const double heading = at.heading_rad + 2.0 * nearly * off * modes_.error.heading_rad;
    ++totals_.states;
    return ModeStart{{place, Heading::from_rad(heading)}, at.leaf->next_mode, at.leaf->time_s};
  }

  /// In the mode that is handed over, on the way to the leaf.
  std::optional<ModeStart> before_leaf() {
    const std::optional<AtLeaf> found = at_leaf();
    if (!found) return {};
    const AtLeaf& at = *found;
    const double back_m = modes_.contract.turn_radius_m.most * std::exp(-5.0 * random_.unit());
    double heading = at.heading_rad;
    const Vec2 place = at.place_m - back_m * Vec2{std::cos(heading), std::sin(heading)};
    if (random_.below(2) == 0) heading += random_.uniform(-1.0, 1.0) * random_.unit();
    if (flow().kind_at(flow().grid.cell_of(place)) != CellKind::ordinary) return {};
    return claimed_in(at.mode, {place, Heading::from_rad(heading)});
  }

  void attack(const ModeStart& start, bool aimed, bool at_once) {
    const ModeFlightManner manner{random_.below(2) == 0, random_.below(options_.whole_one_in) == 0,
                                  aimed && !at_once};
    totals_.aimed += aimed ? 1 : 0;
    totals_.at_once += at_once ? 1 : 0;
    count(fly_by_leaves(modes_, start.state, start.mode, start.bound_s, manner, random_),
          manner.eager ? "eager" : "late");
  }

  void attack_by_loop(const State& state) {
    const ContractModeRun run = fly_by_loop(modes_, state, random_);
    if (run.stretches.empty()) return;
    ++totals_.by_loop;
    count(run, "pilot's");
  }

  void count(const ContractModeRun& run, const char* manner) {
    ++totals_.flights;
    totals_.through += run.changes() > 0 ? 1 : 0;
    totals_.changes += static_cast<std::uint64_t>(run.changes());
    totals_.handed_on += run.handed_on ? 1 : 0;
    if (run.handed_on || (run.outcome == Outcome::reach && !run.late)) return;
    judge(run, manner);
  }

  void judge(const ContractModeRun& run, const char* manner) {
    ModeStretch last = run.stretches.back();
    const AttackedMode& mode = modes_.mode(last.mode);
    last.flight = until_it_ends(mode.choices, last.flight).flight;
    const ProvedEnds ends =
        proved_ends(mode.flow, mode.choices.commands(), modes_.contract, last.flight);
    const bool allowed = ends.admissible && !passes_hand_over(modes_, last);
    const bool contradicts = allowed && ends.ends != 0 && !ends.may_be(Verdict::reach);
    const bool late = allowed && !contradicts && (ends.ends == 0 || ends.surely(Verdict::reach)) &&
                      is_still_flying_at(mode.choices, last.flight,
                                         last.bound_s * modes_.least_mps * (1.0 + 1e-9));
    if (contradicts) {
      ++totals_.contradictions;
    } else if (late) {
      ++totals_.late;
    } else {
      ++totals_.unproved;
      return;
    }
    if (totals_.stories.size() < most_contract_mode_stories) {
      totals_.stories.push_back(story(run, manner, contradicts, ends));
    }
  }

  static std::string story(const ContractModeRun& run, const char* manner, bool contradicts,
                           const ProvedEnds& ends) {
    std::string text = fmt::format("{}: {} flight", contradicts ? "CONTRADICTION" : "LATE", manner);
    for (const ModeStretch& s : run.stretches) {
      text += fmt::format(" from {:.17g},{:.17g},{:.17g} in mode {} within {:.9g} s,",
                          s.flight.start.position_m.x, s.flight.start.position_m.y,
                          s.flight.start.heading.rad(), s.mode, s.bound_s);
    }
    return text + fmt::format(" ends with {:#x} after {:.9g} m", ends.ends, ends.length_m);
  }

  const AttackedModes& modes_;
  const ContractModeAttackOptions& options_;
  Random random_;
  std::vector<int> handing_over_;  ///< modes that are handed over somewhere
  ContractModeAttackTotals totals_;
};

}  // namespace

void ContractModeAttackTotals::add(const ContractModeAttackTotals& other) {
  states += other.states;
  flights += other.flights;
  aimed += other.aimed;
  at_once += other.at_once;
  through += other.through;
  changes += other.changes;
  by_loop += other.by_loop;
  handed_on += other.handed_on;
  contradictions += other.contradictions;
  late += other.late;
  unproved += other.unproved;
  for (const std::string& story : other.stories) {
    if (stories.size() < most_contract_mode_stories) stories.push_back(story);
  }
}

std::string ContractModeAttackTotals::line() const {
  return fmt::format(
      "{} flights ({} aimed at hand-overs, {} of them begun as handed over; {} changed modes on "
      "the "
      "way, {} times; {} by a ContractPilot; {} ended where the same was claimed), {} states "
      "asked; "
      "{} contradictions, {} late, {} not proved",
      flights, aimed, at_once, through, changes, by_loop, handed_on, states, contradictions, late,
      unproved);
}

ContractModeAttackTotals attack_contract_modes(const ContractCertificate& certificate,
                                               const ContractModeAttackOptions& options) {
  require(certificate.further_modes() > 0, "a proof of several modes is attacked");
  const AttackedModes modes(certificate);
  ContractModeAttackTotals totals;
  std::mutex adding;
  bool go_on = true;
  constexpr std::uint64_t draws = 64;  // in an item
  for (std::uint64_t item = 0;
       go_on && totals.flights < options.flights && totals.states < 16 * options.flights;) {
    const std::uint64_t batch =
        std::clamp<std::uint64_t>((options.flights - totals.flights) / (4 * draws), 4, 512);
    for_ranges(batch, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        ContractModeAttacker attacker(modes, options, item + i);
        for (std::uint64_t k = 0; k < draws; ++k) attacker.attack_some();
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
