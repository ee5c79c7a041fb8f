#include "fairway/verify/prover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

}  // namespace

Prover::Prover(const Flow& flow, const SectionVerdicts& start, int most_crossings,
               std::function<bool()> go_on, LeafGraph::Keep keep, std::span<const ModeView> earlier)
    : flow_(flow),
      most_crossings_(most_crossings),
      go_on_(std::move(go_on)),
      earlier_(earlier),
      graph_(start, keep),
      rank_(graph_.highest_rank()) {
  std::vector<Id> unknown;  // decided ones too, if their links are to be kept
  for (Id id = 0; id < graph_.ids(); ++id) {
    if (graph_.is_open(id) || keep == LeafGraph::Keep::all_links) unknown.push_back(id);
  }
  fly(unknown);
}

void Prover::look_up(std::size_t section, UnitRange range, double flown_s,
                     VerdictSet& found) const {
  if (!graph_.has_leaves(section)) found.add(Verdict::undecided, 0.0);
  graph_.for_leaves(section, range, [&](Id id) {
    found.add(graph_.verdict(id), above(flown_s + static_cast<double>(graph_.time_s(id))));
  });
}

/// Computes images for leaves that have none yet; these then wait to be examined.
void Prover::fly(std::vector<Id> ids) {
  if (!earlier_.empty()) ids = not_handed_over(ids);
  std::vector<LeafPlace> places(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) places[i] = graph_.place(ids[i]);
  const ImageStore images = leaf_images(flow_, places, most_crossings_, go_on_);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    graph_.set_image(ids[i], images[i]);
    if (graph_.is_open(ids[i])) waiting_.add(ids[i]);
  }
}

/// Hands leaves over to earlier modes where all their states are proved there: most are, so that is
/// asked before their own flights. Returns the others.
std::vector<Prover::Id> Prover::not_handed_over(const std::vector<Id>& ids) {
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
    graph_.for_leaves(link.section, link.range, [&](Id other) {
      worth = worth || (other == id && link.own_move == 0) ||
              graph_.verdict(other) != Verdict::undecided;
    });
    if (worth) return true;
  }
  return false;
}

Prover::Finding Prover::examine(Id id, double least_units) const {
  Finding finding{image_verdicts(graph_, id, [this](Id other) { return graph_.verdict(other); })};
  // An unknown leaf keeps everything that leads to it waiting: cut it finer, ahead of the rest.
  // Not so in a further mode, which is there for what it does in a few turns.
  const double ahead = earlier_.empty() ? 1.0 / 64.0 : 1.0;
  const double least = graph_.gave_up(id) ? std::max(ahead * least_units, 64.0) : least_units;
  // Before it fails as a whole, a part that can be handed over is cut off, down to a small one.
  constexpr double least_part = 0x1p24;
  const bool in_part = graph_.hands_over_in_part(id) && finding.found.only() != Verdict::reach &&
                       width_of(graph_.place(id).range) >= least_part;
  if (in_part) finding.found.add(Verdict::undecided, 0.0);
  finding.cut = finding.found.only() == Verdict::undecided &&
                width_of(graph_.place(id).range) >= 2.0 * least && is_worth_cutting(id);
  return finding;
}

void Prover::conclude(const std::vector<Id>& round, const std::vector<Finding>& findings) {
  ++rank_;
  std::vector<Id> halves;
  for (std::size_t k = 0; k < round.size(); ++k) {
    const Verdict verdict = findings[k].found.only();
    const float time_s = std::nextafter(static_cast<float>(findings[k].found.time_s), infinite);
    if (findings[k].cut) {
      const Id upper = graph_.cut(round[k]);
      halves.insert(halves.end(), {round[k], upper});
      if (!earlier_.empty()) {
        worth_asking_.resize(graph_.ids(), every_mode);
        worth_asking_[upper] = worth_asking_[round[k]];
      }
    } else if (verdict != Verdict::undecided && verdict != Verdict::trapped && time_s < infinite) {
      graph_.decide(round[k], verdict, rank_, time_s);  // in a time that a float can hold
    }
  }
  for (const Id id : round) {
    if (graph_.verdict(id) != Verdict::undecided) wake_dependents(id);
  }
  fly(halves);
}

void Prover::wake_dependents(Id id) {
  const LeafPlace place = graph_.place(id);
  graph_.for_dependents(place.section, place.range, [&](Id other) {
    if (graph_.is_open(other)) waiting_.add(other);
  });
}

bool Prover::settle(double least_units) {
  for (Id id = 0; id < graph_.ids(); ++id) {
    if (graph_.is_open(id)) waiting_.add(id);
  }
  do {
    const bool settled = least_by_rounds(
        waiting_, go_on_, [&](Id id) { return examine(id, least_units); },
        [this](const auto& round, const auto& findings) { conclude(round, findings); });
    if (!settled) return false;
    prove_trapped();
  } while (!waiting_.empty());
  return true;
}

/// Everything undecided, minus what may get out. What remains wakes the leaves that lead there.
void Prover::prove_trapped() {
  std::vector<Id> open;
  for (Id id = 0; id < graph_.ids(); ++id) {
    if (graph_.is_open(id)) open.push_back(id);
  }
  const std::vector<Id> trapped =
      greatest_by_removal(graph_, std::move(open), [this](Id id, const auto& is_in) {
        const auto verdict_at = [&](Id other) {
          return is_in(other) ? Verdict::trapped : graph_.verdict(other);
        };
        return image_verdicts(graph_, id, verdict_at).only() == Verdict::trapped;
      });
  for (const Id id : trapped) graph_.decide(id, Verdict::trapped, 0, infinite);
  for (const Id id : trapped) wake_dependents(id);
}

void Prover::invalidate(const std::vector<bool>& changed_cells) {
  waiting_.take();  // some may no longer be leaves; `settle` starts with all open ones
  fly(graph_.invalidate(flow_, changed_cells));
}

}  // namespace fairway
