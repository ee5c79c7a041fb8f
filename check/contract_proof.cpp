#include "check/contract_proof.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "check/contract_groups.hpp"
#include "check/contract_hand_over.hpp"
#include "check/follow_proof.hpp"
#include "check/leaf_findings.hpp"

namespace fairway_check {
namespace {

/// Progress is claimed only by headings that are this much less than 90 degrees from its direction.
constexpr double least_margin = 1e-3;

/// What is claimed about all places where the behaviours of a set cross or end.
class Outcome : public Sightings {
 public:
  /// `group`: that of the leaf that the set is; `verdict`: what is claimed of it.
  explicit Outcome(const ContractCertificate& c, std::uint32_t group = 0,
                   std::uint8_t verdict = verdict_count)
      : c_(c),
        group_(group),
        verdict_(verdict),
        seconds_(c.parts.side_m / c.contract.least_speed * time_margin) {}

  void cross(std::size_t part, int side, double low, double high, const Past& past) override {
    const std::size_t section = 4 * part + static_cast<std::size_t>(side);
    if (c_.first[section] == c_.first[section + 1]) tell(undecided);
    c_.for_leaves(section, low, high, [&](std::size_t leaf) {
      const std::uint32_t group = c_.group[leaf];
      tell(c_.verdict[leaf]);
      if (c_.follow && c_.follow->stage[leaf] != 0) {  // has come to the core
        onwards_s = std::max(onwards_s, past.length * seconds_);
        return;
      }
      most_group = std::max(most_group, group);
      if (group_ != 0 && group == group_) {
        stray(past);
      } else {
        onwards_s = std::max(onwards_s,
                             past.length * seconds_ + static_cast<double>(c_.group_time_s[group]));
      }
    });
  }
  void end(Verdict verdict, const Past& past) override {
    // Nothing is known of who comes to the end of a path without having joined it.
    if (c_.follow && verdict == reach) return give_up();
    tell(verdict);
    onwards_s = std::max(onwards_s, past.length * seconds_);
  }
  void give_up() override { gave_up = true; }
  /// Once it is clear that they have several outcomes, or another one than is claimed.
  bool has_enough() const override {
    const unsigned good = verdict_ < verdict_count ? told & 1U << verdict_ : told;
    return gave_up || told != good || std::popcount(told) > 1;
  }

  /// The verdict of all; undecided when there are several, or nothing was reported.
  Verdict verdict() const {
    return !gave_up && std::has_single_bit(told) ? static_cast<Verdict>(std::countr_zero(told))
                                                 : undecided;
  }

  unsigned told = 0;  ///< a bit for every verdict
  bool gave_up = false;
  std::uint32_t most_group = 0;
  double onwards_s = 0.0;    ///< until an end, or to the end of what a lower group claims
  double astray_rad = -1.0;  ///< farthest from the group's direction, on a link inside it

 private:
  void tell(std::uint8_t verdict) { told |= 1U << verdict; }
  /// A link inside the group: all headings on the way count.
  void stray(const Past& past) {
    const double u = c_.group_heading_rad[group_];
    const double middle = 0.5 * (past.least_rad + past.most_rad);
    const double off = std::abs(std::remainder(middle - u, 2.0 * std::numbers::pi)) +
                       0.5 * (past.most_rad - past.least_rad);
    astray_rad = std::isnan(off) ? HUGE_VAL : std::max(astray_rad, off);
  }

  const ContractCertificate& c_;
  std::uint32_t group_;
  std::uint8_t verdict_;
  double seconds_;
};

/// The rule for one leaf: "" when it holds, else why not.
std::string defect_of_leaf(const ContractCertificate& c, Behaviours& behaviours,
                           std::size_t section, std::size_t leaf, Share& share) {
  const std::uint8_t verdict = c.verdict[leaf];
  const std::uint32_t group = c.group[leaf];
  Outcome outcome(c, group, verdict);
  behaviours.follow_leaf(section / 4, static_cast<int>(section % 4), c.begin_of(leaf),
                         c.end_of(section, leaf), outcome);
  share = {outcome.onwards_s, outcome.astray_rad};
  if (outcome.gave_up) return "its behaviours cannot be followed";
  if (outcome.verdict() != verdict) return told_instead(outcome.told);
  if (verdict == trapped) return {};
  if (outcome.most_group > group) {
    return fmt::format("its group is {}, but its behaviours come to a leaf of group {}", group,
                       outcome.most_group);
  }
  if (outcome.astray_rad >= 0.0 && std::isnan(c.group_heading_rad[group])) {
    return fmt::format("its group {} has no direction, but its behaviours come back to it", group);
  }
  if (outcome.astray_rad > 0.5 * std::numbers::pi - least_margin + angle_slack) {
    return fmt::format(
        "behaviours come back to its group {} with headings {:.6f} rad from the "
        "direction of progress",
        group, outcome.astray_rad);
  }
  return {};
}

/// Of states handed over to a mode: the longest that any of their behaviours takes to reach, or
/// infinity. Behaviours of few states spread less than those of many, so what does not reach as a
/// whole is asked in halves.
class HandOverTime {
 public:
  explicit HandOverTime(const ContractCertificate& to)
      : to_(to), behaviours_(to.parts, to.contract) {}

  /// In `enough` seconds, if halves can show it.
  double seconds(const StatesOfPart& states, double enough, int halvings = most_halvings) {
    Outcome outcome(to_, 0, reach);
    behaviours_.follow_states(states.part, states.at, states.least, states.most, outcome);
    const bool reaches = outcome.verdict() == reach;
    if (reaches && (halvings == 0 || outcome.onwards_s <= enough)) return outcome.onwards_s;
    if (halvings == 0) {
      why_ = outcome.gave_up ? "cannot be followed" : told_instead(outcome.told);
      return HUGE_VAL;
    }
    double worst = 0.0;
    for (const StatesOfPart& half : halves_of(states)) {
      if (!half.at.empty()) worst = std::max(worst, seconds(half, enough, halvings - 1));
      if (worst == HUGE_VAL) break;
    }
    return worst;
  }
  /// Of the last that did not reach.
  const std::string& why() const { return why_; }

 private:
  static constexpr int most_halvings = 9;
  static constexpr double narrow = 0.1;  ///< headings that are halved no more before places are

  static std::array<StatesOfPart, 2> halves_of(const StatesOfPart& states) {
    std::array<StatesOfPart, 2> halves{states, states};
    if (states.most - states.least > narrow) {
      halves[0].most = halves[1].least = 0.5 * (states.least + states.most);
      return halves;
    }
    const Box all = states.at.bounds();
    Box first = all.grown(touch);
    Box second = first;
    const double middle_x = 0.5 * (all.x0 + all.x1);
    const double middle_y = 0.5 * (all.y0 + all.y1);
    const bool is_wide = all.x1 - all.x0 > all.y1 - all.y0;
    (is_wide ? first.x1 : first.y1) = (is_wide ? middle_x : middle_y) + touch;
    (is_wide ? second.x0 : second.y0) = (is_wide ? middle_x : middle_y) - touch;
    halves[0].at = clipped(states.at, first);
    halves[1].at = clipped(states.at, second);
    return halves;
  }

  const ContractCertificate& to_;
  Behaviours behaviours_;
  std::string why_ = "which states that are is not known";
};

/// The rule for a leaf of mode `m` that is handed over.
std::string defect_of_hand_over(const ContractCertificate& c, const ContractCertificate& m,
                                const std::vector<KnownBoxes>& known, std::size_t section,
                                std::size_t leaf, Share& share) {
  const ContractCertificate& next = c.of_mode(m.group_next[m.group[leaf]]);
  HandOverTime time(next);
  const bool all = for_states_around(m, section, leaf, [&](const StatesOfPart& states) {
    // Boxes are asked once for many leaves; what they cannot prove is asked of the leaf alone.
    double found = known[next.mode].seconds(
        states, [&](const StatesOfPart& box) { return time.seconds(box, HUGE_VAL, 0); });
    const double enough = static_cast<double>(m.group_time_s[m.group[leaf]]) / time_margin;
    if (found > enough) found = time.seconds(states, enough);
    share.onwards_s = std::max(share.onwards_s, found);
    return found < HUGE_VAL;
  });
  if (all) return "";
  return fmt::format("is handed over to mode {}, but from there: {}", next.mode, time.why());
}

/// The rules for single leaves of mode `m` of the certificate `whole`.
class LeafRules {
 public:
  LeafRules(const ContractCertificate& whole, const ContractCertificate& c,
            const std::vector<KnownBoxes>& known)
      : whole_(whole), c_(c), known_(known) {
    if (c.follow) core_.emplace(c);
  }
  std::string defect() const { return core_ ? core_->defect() : ""; }
  LapSums no_laps() const { return core_ ? LapSums(c_) : LapSums(); }
  std::string defect(Behaviours& behaviours, std::size_t section, std::size_t leaf, Share& share,
                     LapSums& laps) const {
    share = {0.0, -1.0};
    if (c_.hands_over(leaf)) return defect_of_hand_over(whole_, c_, known_, section, leaf, share);
    return core_ && c_.follow->stage[leaf] != 0
               ? core_->defect_of_leaf(behaviours, section, leaf, share, laps)
               : defect_of_leaf(c_, behaviours, section, leaf, share);
  }

 private:
  const ContractCertificate& whole_;
  const ContractCertificate& c_;
  const std::vector<KnownBoxes>& known_;  ///< of each mode
  std::optional<CoreProof> core_;
};

/// Which leaves are decided and fail, 1 or 0.
std::vector<std::uint8_t> failing_leaves(const ContractCertificate& c, const LeafRules& rules,
                                         std::vector<Share>& shares, LapSums& laps) {
  std::vector<std::uint8_t> fails(c.verdict.size());
  shares.resize(c.verdict.size());
  std::mutex adding;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, c.parts.kind.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Behaviours behaviours(c.parts, c.contract);
                      LapSums here = rules.no_laps();
                      for (std::size_t s = 4 * range.begin(); s < 4 * range.end(); ++s) {
                        for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
                          if (c.verdict[leaf] == undecided) continue;
                          const std::string why =
                              rules.defect(behaviours, s, leaf, shares[leaf], here);
                          fails[leaf] = why.empty() ? 0 : 1;
                        }
                      }
                      const std::lock_guard lock(adding);
                      laps.add(here);
                    });
  return fails;
}

/// Of one mode: "" when it is as claimed.
std::string defect_of_mode(const ContractCertificate& whole, const ContractCertificate& c,
                           const std::vector<KnownBoxes>& known, nlohmann::ordered_json& report) {
  std::vector<Share> shares;
  const LeafRules rules(whole, c, known);
  if (std::string wrong = rules.defect(); !wrong.empty()) return wrong;
  LapSums laps = rules.no_laps();
  const std::vector<std::uint8_t> fails = failing_leaves(c, rules, shares, laps);
  const auto why = [&](std::size_t section, std::size_t leaf) {
    Behaviours behaviours(c.parts, c.contract);
    LapSums none = rules.no_laps();
    return rules.defect(behaviours, section, leaf, shares[leaf], none);
  };
  std::string wrong = defect_of_leaves(c, fails, why, report);
  if (wrong.empty()) wrong = defect_of_groups(c, shares);
  if (wrong.empty() && c.follow) wrong = laps.defect(c);
  return wrong;
}

}  // namespace

StatesTold::StatesTold(const ContractCertificate& c) : c_(c) {
  for (std::size_t mode = 0; mode <= c.further.size(); ++mode) {
    const ContractCertificate& m = c.of_mode(mode);
    behaviours_.emplace_back(m.parts, m.contract);
  }
}

Told StatesTold::operator()(std::size_t cell, double x, double y, double heading_rad) {
  const int k = c_.parts.per_cell;
  const Cell in = c_.loop.cell_at(cell);
  const auto split = [k](double at, int& part) {
    const double from_corner = (at + 0.5) * k;
    part = std::clamp(static_cast<int>(from_corner), 0, k - 1);
    return from_corner - part;
  };
  Cell part;
  const double place_x = split(x, part.x);
  const double place_y = split(y, part.y);
  const std::size_t at = c_.parts.index({in.x * k + part.x, in.y * k + part.y});
  Told told{undecided, 0.0};
  for (std::size_t mode = 0; mode < behaviours_.size(); ++mode) {
    Outcome outcome(c_.of_mode(mode));
    behaviours_[mode].follow_state(at, place_x, place_y, heading_rad, outcome);
    if (outcome.verdict() == reach) return {reach, outcome.onwards_s, mode};
    if (mode == 0) told = {outcome.verdict(), outcome.onwards_s};
  }
  return told;
}

std::string judge_contract(const std::string& path, const std::string& plan, std::size_t samples,
                           nlohmann::ordered_json& report) {
  const ContractCertificate c = read_contract_certificate(path, plan);
  std::string wrong;
  std::vector<KnownBoxes> known;
  for (std::size_t k = 0; k < c.further.size(); ++k) known.emplace_back(c.parts.kind.size());
  for (std::size_t mode = 0; mode <= c.further.size() && wrong.empty(); ++mode) {
    wrong = defect_of_mode(c, c.of_mode(mode), known, report);
  }
  if (!wrong.empty() || !c.record.contains("volume_fraction")) return wrong;
  tbb::enumerable_thread_specific<StatesTold> told([&c] { return StatesTold(c); });
  return defect_of_claims(
      c.record, {c.loop, c.region, c.holding, c.further.size() + 1}, samples, true,
      [&told](std::size_t cell, double x, double y, double heading_rad) {
        return told.local()(cell, x, y, heading_rad);
      },
      report);
}

}  // namespace fairway_check
