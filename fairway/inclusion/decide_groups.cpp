#include "fairway/inclusion/decide_groups.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/leaf_components.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {
namespace {

using Id = CrossingGraph::Id;

// In place of the leaf that another one waits for.
constexpr Id nobody = ~Id{0};
constexpr Id one_of_group = nobody - 1;  // of that which is being decided

constexpr unsigned bit(Verdict v) { return 1U << static_cast<unsigned>(v); }

/// What is known of one group before it is decided.
struct Prospect {
  unsigned verdicts = 0;  ///< bits of what comes after it
  bool gave_up = false;
  bool comes_back = false;
  HeadingArc headings;  ///< of what comes back
  double flown = 0.0;   ///< by what does not
  Id waits_for = nobody;
  bool meets_decided = false;
};

class Decider {
 public:
  Decider(const Parts& parts, CrossingGraph& graph, GroupRecord& groups)
      : parts_(parts), graph_(graph), groups_(groups) {
    result_.hope.assign(graph.slots(), CutHope::none);
    result_.cause.assign(graph.slots(), nobody);
    result_.trouble.assign(graph.slots(), Trouble::none);
    groups.begin();
  }

  Deciding run() {
    for_components(
        graph_, [this](Id id) { return graph_.leaf(id).state == LeafState::open; },
        [this](std::span<const Id> members) { decide(members); });
    return std::move(result_);
  }

 private:
  Id& cause_of(Id id) { return result_.cause[graph_.slot(id)]; }

  void look(Id id, Prospect& p) {
    const Leaf& leaf = graph_.leaf(id);
    p.gave_up |= leaf.gave_up;
    p.verdicts |= leaf.ends;
    p.meets_decided |= leaf.ends != 0;
    for (const CrossingLink& link : graph_.links(id)) {
      const CrossingGraph::Range range = graph_.leaves_of(link);
      for (Id to = range.first; to < range.last; ++to) {
        const Leaf& target = graph_.leaf(to);
        const double flown = static_cast<double>(link.flown);
        if (graph_.has_slot(to) && cause_of(to) == one_of_group) {
          p.headings = p.comes_back ? p.headings.with(link.headings()) : link.headings();
          p.comes_back = true;
        } else if (target.state == LeafState::closed) {
          p.verdicts |= bit(target.verdict);
          p.meets_decided = true;
          p.flown = std::max(p.flown, flown + static_cast<double>(groups_.flown[target.group]));
        } else if (p.waits_for == nobody) {
          p.waits_for = to;
        }
      }
    }
    if (leaf.ends != 0) p.flown = std::max(p.flown, static_cast<double>(leaf.end_flown));
  }

  void decide(std::span<const Id> members) {
    for (const Id id : members) cause_of(id) = one_of_group;
    Prospect all;
    for (const Id id : members) look(id, all);
    const bool progress =
        !all.comes_back || all.headings.width_rad < 2.0 * most_off_progress_rad - 1e-3;
    const bool known = !all.gave_up && all.waits_for == nobody;
    // Behaviours that move on come to an end or an exit: where there is none, something is wrong,
    // and nothing is claimed.
    const bool one = known && std::has_single_bit(all.verdicts);
    const bool trapped =
        known && (all.verdicts == bit(Verdict::trapped) || (all.verdicts == 0 && !progress));
    if (trapped) return close(members, Verdict::trapped, 0);
    if (one && progress) {
      const auto verdict = static_cast<Verdict>(std::countr_zero(all.verdicts));
      return close(members, verdict, groups_.add(heading_of(all), flown_of(members, all)));
    }
    tell_trouble(members, all, one);
  }

  void close(std::span<const Id> members, Verdict verdict, std::uint32_t group) {
    for (const Id id : members) {
      Leaf& leaf = graph_.leaf(id);
      leaf.state = LeafState::closed;
      leaf.verdict = verdict;
      leaf.group = group;
      cause_of(id) = nobody;
    }
    result_.decided += members.size();
  }

  static float heading_of(const Prospect& p) {
    if (!p.comes_back) return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>(
        std::remainder(p.headings.lo_rad + 0.5 * p.headings.width_rad, whole_turn_rad));
  }

  /// While it comes back, a behaviour moves along the group's heading by the cosine of the angle to
  /// it, at most through all its leaves.
  float flown_of(std::span<const Id> members, const Prospect& p) const {
    if (!p.comes_back) return static_cast<float>(p.flown * (1.0 + 1e-6));
    const double heading = static_cast<double>(heading_of(p));
    const Vec2 along{std::cos(heading), std::sin(heading)};
    double lo = std::numeric_limits<double>::infinity();
    double hi = -lo;
    for (const Id id : members) {
      const std::size_t s = graph_.section_of(id);
      const PartPlace part = parts_.place(s / sections_per_part);
      for (const Vec2 corner : {Vec2{0.0, 0.0}, Vec2{1.0, 0.0}, Vec2{0.0, 1.0}, Vec2{1.0, 1.0}}) {
        const double on = dot(along, Vec2{part.ix + corner.x, part.iy + corner.y});
        lo = std::min(lo, on);
        hi = std::max(hi, on);
      }
    }
    const double off = 0.5 * p.headings.width_rad + 1e-3;  // who checks may find more
    return static_cast<float>((p.flown + generous * (hi - lo + 0.1) / std::cos(off)) *
                              (1.0 + 1e-6));
  }

  void tell_trouble(std::span<const Id> members, const Prospect& all, bool one) {
    // A group that waits is cut only where a leaf meets something decided, or itself.
    const Trouble of_group = one ? Trouble::no_progress : Trouble::waits;
    Id cause = nobody;
    Trouble reason = Trouble::none;
    for (const Id id : members) {
      Prospect own;
      look(id, own);
      const bool several = !std::has_single_bit(own.verdicts) && own.verdicts != 0;
      const Trouble trouble = own.gave_up ? Trouble::gave_up
                              : several   ? Trouble::mixed
                                          : Trouble::none;
      result_.hope[graph_.slot(id)] = own.gave_up         ? CutHope::faint
                                      : own.meets_decided ? CutHope::fair
                                      : own.comes_back    ? CutHope::faint
                                                          : CutHope::none;
      if (trouble != Trouble::none && reason == Trouble::none) {
        cause = id;
        reason = trouble;
      }
    }
    if (reason == Trouble::none && of_group == Trouble::no_progress) {
      cause = members.front();
      reason = of_group;
    }
    if (reason == Trouble::none && all.waits_for != nobody) {
      cause = graph_.has_slot(all.waits_for) ? cause_of(all.waits_for) : nobody;
      // Of a leaf that nothing should cross nothing is known: the trouble is here.
      if (cause != nobody) reason = Trouble::waits;
    }
    if (reason == Trouble::none) {  // its leaves have one verdict each, but not the same
      cause = members.front();
      reason = Trouble::mixed;
    }
    for (const Id id : members) {
      cause_of(id) = cause;
      result_.trouble[graph_.slot(id)] = id == cause ? reason : Trouble::waits;
    }
  }

  const Parts& parts_;
  CrossingGraph& graph_;
  GroupRecord& groups_;
  Deciding result_;
};

}  // namespace

void GroupRecord::begin() {
  if (!heading_rad.empty()) return;
  add(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
}

std::uint32_t GroupRecord::add(float group_heading_rad, float group_flown) {
  heading_rad.push_back(group_heading_rad);
  flown.push_back(group_flown);
  return static_cast<std::uint32_t>(flown.size() - 1);
}

Deciding decide_groups(const Parts& parts, CrossingGraph& graph, GroupRecord& groups) {
  return Decider(parts, graph, groups).run();
}

}  // namespace fairway
