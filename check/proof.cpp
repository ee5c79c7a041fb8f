#include "check/proof.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "check/contract_proof.hpp"
#include "check/leaf_findings.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

/// What is claimed about all places where the flights of a set arrive or end.
class Outcome : public Listener {
 public:
  /// `mode`: the one that is flown. `own`: the leaf of it that the set is, on which a hop may land.
  Outcome(const Geometry& geometry, const Mode& mode, std::size_t own = ~std::size_t{0})
      : mode_(mode), own_(own), seconds_per_cell_(Real(geometry.cell_m) / geometry.speed_mps) {}

  void arrive(std::size_t section, const Real& place, double length, bool hop) override {
    const Real flown_s = length * seconds_per_cell_;
    const auto low = mode_.begin.begin() + mode_.first[section];
    const auto high = mode_.begin.begin() + mode_.first[section + 1];
    const Real units = (0.5 + turned(section, place)) * 0x1p32;
    auto at = std::lower_bound(low, high, units.lower());
    if (at != low) --at;  // reaches up to the place, or ends there
    if (low == high) tell(undecided, 0.0);
    for (; at != high && !(*at > units.upper()); ++at) {
      const auto leaf = static_cast<std::size_t>(at - mode_.begin.begin());
      if (hop && leaf == own_) {
        hop_s = std::max(hop_s, flown_s.upper());
        continue;
      }
      tell(mode_.verdict[leaf], (flown_s + static_cast<double>(mode_.time_s[leaf])).upper());
      least_rank = std::max(least_rank, std::size_t{mode_.rank[leaf]} + 1);
    }
  }
  void end(Verdict verdict, double length) override {
    tell(verdict, (length * seconds_per_cell_).upper());
  }
  void give_up() override { tell(undecided, 0.0); }

  /// Places run upwards and to the right, but in the frames of top and left the other way round.
  static Real turned(std::size_t section, const Real& place) {
    return section % 4 == 1 || section % 4 == 2 ? -place : place;
  }
  /// The verdict of all; undecided when there are several, or nothing was reported.
  Verdict verdict() const {
    return std::has_single_bit(told) ? static_cast<Verdict>(std::countr_zero(told)) : undecided;
  }

  unsigned told = 0;           ///< a bit for every verdict
  std::size_t least_rank = 0;  ///< above that of every leaf
  double worst_s = 0.0;
  double hop_s = 0.0;  ///< of one hop that may land on the leaf itself

 private:
  void tell(std::uint8_t verdict, double time_s) {
    told |= 1U << verdict;
    worst_s = std::max(worst_s, time_s);
  }

  const Mode& mode_;
  std::size_t own_;
  Real seconds_per_cell_;
};

/// What follows when the claims do not hold: "" when they do.
std::string defect_of_claim(const Mode& mode, std::size_t leaf, const Outcome& outcome,
                            double worst_s) {
  const Verdict verdict = static_cast<Verdict>(mode.verdict[leaf]);
  if (outcome.verdict() != verdict) return told_instead(outcome.told);
  if (verdict == trapped) return {};
  // A mode may rest on all that is proved of earlier ones: these never hand over to it.
  if (!mode.hands_over(leaf) && outcome.least_rank > mode.rank[leaf]) {
    return fmt::format("its rank is {}, but its states come to a leaf of rank {}", mode.rank[leaf],
                       outcome.least_rank - 1);
  }
  const double claimed_s = mode.time_s[leaf];
  if (worst_s <= claimed_s) return {};
  return fmt::format("takes up to {:.9g} s, but {:.9g} s is claimed", worst_s, claimed_s);
}

/// The rule for one leaf: "" when it holds, else why not.
std::string defect_of_leaf(const Certificate& c, const Mode& mode, std::size_t section,
                           std::size_t leaf) {
  const Real units(mode.begin_of(leaf), mode.end_of(section, leaf));
  const Real place = Outcome::turned(section, units * 0x1p-32 - 0.5);  // exact
  if (mode.hands_over(leaf)) {
    const Mode& next = c.modes[mode.next[leaf]];
    Outcome outcome(c.geometry, next);
    follow_handed_over(mode.loop, next.loop, section, place, outcome);
    return defect_of_claim(mode, leaf, outcome, outcome.worst_s);
  }
  // Lemma 5: a hop moves every state by 4 R sin n, n the angle of the heading to the side.
  const Vec heading = into_frame(static_cast<int>(section % 4), mode.loop.direction[section / 4]);
  const Real hop = 4.0 * mode.loop.radius * heading.x * 0x1p32;
  const bool one_way = positive(hop) && (positive(heading.y) || negative(heading.y));
  Outcome outcome(c.geometry, mode, one_way ? leaf : ~std::size_t{0});
  follow_section(mode.loop, section, place, outcome);
  // Each may have hopped across the whole leaf before it does anything else.
  const Real hops =
      outcome.hop_s > 0.0 ? Real(std::floor((width(units) / hop).upper())) : Real(0.0);
  return defect_of_claim(mode, leaf, outcome, (outcome.worst_s + hops * outcome.hop_s).upper());
}

/// Which leaves are decided and fail, 1 or 0.
std::vector<std::uint8_t> failing_leaves(const Certificate& c, const Mode& mode) {
  std::vector<std::uint8_t> fails(mode.verdict.size());
  tbb::parallel_for(std::size_t{0}, mode.first.size() - 1, [&](std::size_t s) {
    if (mode.first[s] == mode.first[s + 1]) return;
    const Upwards upwards;
    for (std::size_t leaf = mode.first[s]; leaf < mode.first[s + 1]; ++leaf) {
      const bool is_claimed = mode.verdict[leaf] != undecided;
      fails[leaf] = is_claimed && !defect_of_leaf(c, mode, s, leaf).empty() ? 1 : 0;
    }
  });
  return fails;
}

/// "" when the rule holds for all leaves of all modes.
std::string defect_of_modes(const Certificate& c, nlohmann::ordered_json& report) {
  for (const Mode& mode : c.modes) {
    const auto why = [&](std::size_t section, std::size_t leaf) {
      const Upwards upwards;
      return defect_of_leaf(c, mode, section, leaf);
    };
    const std::vector<std::uint8_t> fails = failing_leaves(c, mode);
    if (std::string wrong = defect_of_leaves(mode, fails, why, report); !wrong.empty())
      return wrong;
  }
  return "";
}

}  // namespace

Told told_of_state(const Certificate& c, std::size_t cell, double x, double y, double heading_rad) {
  const Upwards upwards;
  const Vec heading = unit_vector(heading_rad);
  Told told{undecided, 0.0};
  for (const Mode& mode : c.modes) {
    Outcome outcome(c.geometry, mode);
    follow_states(mode.loop, cell, {Real(x), Real(y)}, heading, outcome);
    if (outcome.verdict() == reach) return {reach, outcome.worst_s, mode.number};
    if (mode.number == 0) told = {outcome.verdict(), outcome.worst_s};
  }
  return told;
}

std::string judge(const std::string& path, const std::string& plan, std::size_t samples,
                  nlohmann::ordered_json& report) try {
  if (is_contract_certificate(path)) return judge_contract(path, plan, samples, report);
  const Certificate c = read_certificate(path, plan);
  if (std::string wrong = defect_of_modes(c, report); !wrong.empty()) return wrong;
  return defect_of_claims(
      c.record, {c.loop(), c.region, c.holding, c.modes.size()}, samples, false,
      [&c](std::size_t cell, double x, double y, double heading_rad) {
        return told_of_state(c, cell, x, y, heading_rad);
      },
      report);
} catch (const Defect& defect) {
  if (defect.code != 1) throw;
  return defect.what();
}

}  // namespace fairway_check
