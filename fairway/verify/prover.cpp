#include "fairway/verify/prover.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

constexpr unsigned bit_of(Verdict verdict) { return 1U << static_cast<unsigned>(verdict); }

/// Leaves that are flown at once: their images are held twice for a moment.
constexpr std::size_t batch = 32768;

}  // namespace

Prover::Prover(const Flow& flow, const SectionVerdicts& start, int most_crossings,
               std::function<bool()> go_on, LeafGraph::Keep keep, std::span<const ModeView> earlier)
    : flow_(flow),
      most_crossings_(most_crossings),
      go_on_(std::move(go_on)),
      earlier_(earlier),
      graph_(start, keep),
      rank_(graph_.highest_rank()),
      may_give_up_hope_(earlier.empty() && keep == LeafGraph::Keep::links_of_open_leaves) {
  std::vector<Id> unknown;  // decided ones too, if their links are to be kept
  for (Id id = 0; id < graph_.ids(); ++id) {
    if (graph_.is_open(id) || keep == LeafGraph::Keep::all_links) unknown.push_back(id);
  }
  fly(unknown);
}

void Prover::look_up(std::size_t section, UnitRange range, double flown_s,
                     VerdictSet& found) const {
  if (!graph_.has_leaves(section)) found.add(Verdict::undecided, 0.0);
  graph_.for_leaves(section, range, [&](const LeafGraph::Leaf& leaf) {
    found.add(leaf.verdict, above(flown_s + static_cast<double>(leaf.time_s)));
  });
}

/// Computes images for leaves that have none yet; these then wait to be examined.
void Prover::fly(std::span<const Id> ids) {
  for (std::size_t i = 0; i < ids.size(); i += batch) {
    fly_some(ids.subspan(i, std::min(batch, ids.size() - i)));
  }
}

void Prover::fly_some(std::span<const Id> ids) {
  std::vector<Id> others;
  if (!earlier_.empty()) {
    others = not_handed_over(ids);
    ids = others;
  }
  std::vector<LeafPlace> places(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) places[i] = graph_.place(ids[i]);
  const ImageStore images = leaf_images(flow_, places, most_crossings_, go_on_);
  is_new_since_trapped_ = is_new_since_trapped_ || !ids.empty();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    // Most are decided or cut when they are examined, before they have waited for others.
    graph_.keep_image(ids[i], images[i]);
    ways_out_.forget(ids[i]);
    if (graph_.keeps_all_links()) graph_.await_links(ids[i]);
    if (graph_.is_open(ids[i])) waiting_.add(ids[i]);
  }
}

/// Hands leaves over to earlier modes where all their states are proved there: most are, so that is
/// asked before their own flights. Returns the others.
std::vector<Prover::Id> Prover::not_handed_over(std::span<const Id> ids) {
  worth_asking_.resize(graph_.ids(), every_mode);
  std::vector<HandOver> found(ids.size());
  for_ranges(ids.size(), 64, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b && go_on_(); ++i) {
      found[i] =
          hand_over(flow_, graph_.place(ids[i]), earlier_, most_crossings_, worth_asking_[ids[i]]);
    }
  });
  std::vector<Id> others;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Id id = ids[i];
    const float time_s = std::nextafter(static_cast<float>(found[i].time_s), infinite);
    if (found[i].mode != no_mode && graph_.is_open(id) && time_s < infinite) {
      graph_.decide_by_hand_over(id, found[i].mode, time_s);
      wake_dependents(id);
      graph_.release(id);
      continue;
    }
    worth_asking_[id] = found[i].worth_asking;
    if (found[i].in_part) graph_.set_hands_over_in_part(id);
    others.push_back(id);
  }
  return others;
}

bool Prover::is_worth_cutting(Id id) const {
  if (graph_.hands_over_in_part(id) || graph_.gave_up(id) || graph_.ends(id).bits != 0) return true;
  bool worth = false;
  for (const LeafGraph::Link& link : graph_.links(id)) {
    graph_.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
      worth = worth || (other.id == id && !(graph_.own_move(id, link) > 0.0)) ||
              other.verdict != Verdict::undecided;
    });
    if (worth) return true;
  }
  return false;
}

bool Prover::Finding::decides() const {
  const Verdict verdict = only();  // in a time that a float can hold
  return verdict != Verdict::undecided && verdict != Verdict::trapped && time_s < infinite;
}

Prover::Finding Prover::examine(Id id, double least_units) const {
  VerdictSet found =
      image_verdicts(graph_, id, [](const LeafGraph::Leaf& other) { return other.verdict; });
  // An unknown leaf keeps everything that leads to it waiting: cut it finer, ahead of the rest.
  // Not so in a further mode, which is there for what it does in a few turns.
  const double ahead = earlier_.empty() ? 1.0 / 64.0 : 1.0;
  const double least = graph_.gave_up(id) ? std::max(ahead * least_units, 64.0) : least_units;
  // Before it fails as a whole, a part that can be handed over is cut off, down to a small one.
  constexpr double least_part = 0x1p24;
  const bool in_part = graph_.hands_over_in_part(id) && found.only() != Verdict::reach &&
                       width_of(graph_.place(id).range) >= least_part;
  if (in_part) found.add(Verdict::undecided, 0.0);
  const bool cut = found.only() == Verdict::undecided &&
                   width_of(graph_.place(id).range) >= 2.0 * least && is_worth_cutting(id);
  return {std::nextafter(static_cast<float>(found.time_s), infinite), found.bits, cut};
}

void Prover::conclude(const std::vector<Id>& round, const std::vector<Finding>& findings) {
  ++rank_;
  std::vector<Id> to_cut;
  std::vector<Id> decided;
  for (std::size_t k = 0; k < round.size(); ++k) {  // before anything is decided by this round
    if (findings[k].cut) {
      graph_.drop_image(round[k]);
      to_cut.push_back(round[k]);
    } else if (findings[k].decides()) {
      decided.push_back(round[k]);
    } else {
      keep_waiting(round[k], findings[k]);
    }
  }
  for (std::size_t k = 0; k < round.size(); ++k) {
    const Finding& finding = findings[k];
    if (!finding.cut && finding.decides()) {
      graph_.decide(round[k], finding.only(), rank_, finding.time_s);
    }
  }
  for (const Id id : decided) wake_dependents(id);
  for (const Id id : decided) graph_.release(id);
  last_round_decided_ = !decided.empty();
  decided = std::vector<Id>();
  cut(to_cut);
}

/// Undecided and not cut: until what its image lies on is decided, or for ever.
void Prover::keep_waiting(Id id, const Finding& finding) {
  graph_.set_seen(id, finding.bits);
  const bool hopeless =
      graph_.gave_up(id) || std::popcount(finding.bits & ~bit_of(Verdict::undecided)) > 1;
  if (may_give_up_hope_ && hopeless) {
    graph_.give_up_hope(id, {finding.bits, 0.0});
  } else {
    graph_.await_links(id);
  }
}

void Prover::cut(std::span<const Id> ids) {
  std::vector<Id> halves;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    forget_ways_over(ids[i]);
    const Id upper = graph_.cut(ids[i]);
    halves.insert(halves.end(), {ids[i], upper});
    if (!earlier_.empty()) {
      worth_asking_.resize(graph_.ids(), every_mode);
      worth_asking_[upper] = worth_asking_[ids[i]];
    }
    if (halves.size() < batch && i + 1 < ids.size()) continue;
    fly(halves);
    halves.clear();
  }
}

void Prover::wake_dependents(Id id) {
  const LeafPlace place = graph_.place(id);
  graph_.for_dependents(place.section, place.range, [&](Id other) {
    if (!graph_.is_open(other)) return;
    waiting_.add(other);
    ways_out_.forget_step(other, id);
  });
}

void Prover::forget_ways_over(Id id) {
  const LeafPlace place = graph_.place(id);
  graph_.for_dependents(place.section, place.range,
                        [&](Id other) { ways_out_.forget_step(other, id); });
}

/// Whether any leaf that waits for no one has a link to a leaf of which `is_new` holds.
template <typename IsNew>
bool Prover::hopeless_lead_to(const IsNew& is_new) const {
  bool found = false;
  for (Id id = 0; id < graph_.ids() && !found; ++id) {
    if (!graph_.is_open(id) || !graph_.is_hopeless(id)) continue;
    for (const LeafGraph::Link& link : graph_.links(id)) {
      graph_.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& leaf) {
        found = found || is_new(link.section, leaf);
      });
    }
  }
  return found;
}

bool Prover::settle(double least_units) {
  for (Id id = 0; id < graph_.ids(); ++id) {
    if (graph_.is_open(id)) waiting_.add(id);
  }
  do {
    last_round_decided_ = false;
    const bool settled = least_by_rounds(
        waiting_, go_on_, [&](Id id) { return examine(id, least_units); },
        [this](const auto& round, const auto& findings) { conclude(round, findings); });
    if (!settled) return false;
    // Ranks count rounds in which any leaf is examined because of the round before: these, too,
    // although nothing can come of it.
    const auto is_new = [this](std::size_t, const LeafGraph::Leaf& leaf) {
      return leaf.verdict != Verdict::undecided && leaf.rank == rank_;
    };
    if (last_round_decided_ && hopeless_lead_to(is_new)) ++rank_;
    prove_trapped();
  } while (!waiting_.empty());
  return true;
}

/// All open leaves, minus what may get out. What remains wakes the leaves that lead there.
void Prover::prove_trapped() {
  // Whatever was open the last time led to something else, and still does unless that was cut.
  if (!std::exchange(is_new_since_trapped_, false)) return;
  // Nobody waits to be examined, so that what was seen last is still so.
  std::vector<Id> candidates = ways_out_.lacking(graph_, [this](Id id) {
    constexpr unsigned may = bit_of(Verdict::undecided) | bit_of(Verdict::trapped);
    if (graph_.is_hopeless(id) || graph_.gave_up(id) || (graph_.seen(id) & ~may) != 0) return true;
    const auto links = graph_.links(id);
    return std::any_of(links.begin(), links.end(), [this](const LeafGraph::Link& link) {
      return !graph_.has_leaves(link.section);
    });
  });
  const std::vector<Id> trapped =
      greatest_by_removal(graph_, std::move(candidates), [this](Id id, const auto& is_in) {
        const auto verdict_at = [&](const LeafGraph::Leaf& other) {
          return is_in(other.id) ? Verdict::trapped : other.verdict;
        };
        return image_verdicts(graph_, id, verdict_at).only() == Verdict::trapped;
      });
  for (const Id id : trapped) graph_.decide(id, Verdict::trapped, 0, infinite);
  for (const Id id : trapped) wake_dependents(id);
  if (!trapped.empty() && waiting_.empty()) {
    std::vector<std::pair<std::size_t, std::uint32_t>> begins;
    for (const Id id : trapped) {
      const LeafPlace place = graph_.place(id);
      begins.emplace_back(place.section, place.range.lo);
    }
    std::sort(begins.begin(), begins.end());
    const auto is_new = [&](std::size_t section, const LeafGraph::Leaf& leaf) {
      return leaf.verdict == Verdict::trapped &&
             std::binary_search(begins.begin(), begins.end(), std::pair(section, leaf.begin));
    };
    if (hopeless_lead_to(is_new)) ++rank_;  // as in settle()
  }
  for (const Id id : trapped) graph_.release(id);
}

void Prover::invalidate(const std::vector<bool>& changed_cells) {
  is_new_since_trapped_ = true;
  ways_out_.forget_all(graph_);
  waiting_.take();  // some may no longer be leaves; `settle` starts with all open ones
  fly(graph_.invalidate(flow_, changed_cells));
}

}  // namespace fairway
