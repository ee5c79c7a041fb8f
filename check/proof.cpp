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
  /// `own`: the leaf that the set is, on which a hop may land.
  explicit Outcome(const Certificate& c, std::size_t own = ~std::size_t{0})
      : c_(c), own_(own), seconds_per_cell_(Real(c.geometry.cell_m) / c.geometry.speed_mps) {}

  void arrive(std::size_t section, const Real& place, double length, bool hop) override {
    const Real flown_s = length * seconds_per_cell_;
    const auto low = c_.begin.begin() + c_.first[section];
    const auto high = c_.begin.begin() + c_.first[section + 1];
    const Real units = (0.5 + turned(section, place)) * 0x1p32;
    auto at = std::lower_bound(low, high, units.lower());
    if (at != low) --at;  // reaches up to the place, or ends there
    if (low == high) tell(undecided, 0.0);
    for (; at != high && !(*at > units.upper()); ++at) {
      const auto leaf = static_cast<std::size_t>(at - c_.begin.begin());
      if (hop && leaf == own_) {
        hop_s = std::max(hop_s, flown_s.upper());
        continue;
      }
      tell(c_.verdict[leaf], (flown_s + static_cast<double>(c_.time_s[leaf])).upper());
      least_rank = std::max(least_rank, std::size_t{c_.rank[leaf]} + 1);
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

  const Certificate& c_;
  std::size_t own_;
  Real seconds_per_cell_;
};

/// The rule for one leaf: "" when it holds, else why not.
std::string defect_of_leaf(const Certificate& c, std::size_t section, std::size_t leaf) {
  // Lemma 5: a hop moves every state by 4 R sin n, n the angle of the heading to the side.
  const Vec heading = into_frame(static_cast<int>(section % 4), c.loop.direction[section / 4]);
  const Real hop = 4.0 * c.loop.radius * heading.x * 0x1p32;
  const bool one_way = positive(hop) && (positive(heading.y) || negative(heading.y));
  const Real units(c.begin_of(leaf), c.end_of(section, leaf));
  Outcome outcome(c, one_way ? leaf : ~std::size_t{0});
  follow_section(c.loop, section, Outcome::turned(section, units * 0x1p-32 - 0.5),
                 outcome);  // exact
  // Each may have hopped across the whole leaf before it does anything else.
  const Real hops =
      outcome.hop_s > 0.0 ? Real(std::floor((width(units) / hop).upper())) : Real(0.0);
  const double worst_s = (outcome.worst_s + hops * outcome.hop_s).upper();
  const Verdict verdict = static_cast<Verdict>(c.verdict[leaf]);
  if (outcome.verdict() != verdict) return told_instead(outcome.told);
  if (verdict == trapped) return {};
  if (outcome.least_rank > c.rank[leaf]) {
    return fmt::format("its rank is {}, but its states come to a leaf of rank {}", c.rank[leaf],
                       outcome.least_rank - 1);
  }
  const double claimed_s = c.time_s[leaf];
  if (worst_s <= claimed_s) return {};
  return fmt::format("takes up to {:.9g} s, but {:.9g} s is claimed", worst_s, claimed_s);
}

/// Which leaves are decided and fail, 1 or 0.
std::vector<std::uint8_t> failing_leaves(const Certificate& c) {
  std::vector<std::uint8_t> fails(c.verdict.size());
  tbb::parallel_for(std::size_t{0}, c.first.size() - 1, [&](std::size_t s) {
    if (c.first[s] == c.first[s + 1]) return;
    const Upwards upwards;
    for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
      fails[leaf] = c.verdict[leaf] != undecided && !defect_of_leaf(c, s, leaf).empty() ? 1 : 0;
    }
  });
  return fails;
}

}  // namespace

Told told_of_state(const Certificate& c, std::size_t cell, double x, double y, double heading_rad) {
  const Upwards upwards;
  Outcome outcome(c);
  follow_states(c.loop, cell, {Real(x), Real(y)}, unit_vector(heading_rad), outcome);
  return {outcome.verdict(), outcome.worst_s};
}

std::string judge(const std::string& path, const std::string& plan, std::size_t samples,
                  nlohmann::ordered_json& report) try {
  if (is_contract_certificate(path)) return judge_contract(path, plan, samples, report);
  const Certificate c = read_certificate(path, plan);
  const auto why = [&c](std::size_t section, std::size_t leaf) {
    const Upwards upwards;
    return defect_of_leaf(c, section, leaf);
  };
  std::string wrong = defect_of_leaves(c, failing_leaves(c), why, report);
  if (!wrong.empty()) return wrong;
  return defect_of_claims(
      c.record, {c.loop, c.region, c.holding}, samples, false,
      [&c](std::size_t cell, double x, double y, double heading_rad) {
        return told_of_state(c, cell, x, y, heading_rad);
      },
      report);
} catch (const Defect& defect) {
  if (defect.code != 1) throw;
  return defect.what();
}

}  // namespace fairway_check
