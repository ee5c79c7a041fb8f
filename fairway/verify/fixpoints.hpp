// Fixpoints over the graph of leaves: what follows for all leaves from a rule for one.
//
// A least fixpoint holds for what arrives at the ends in finitely many steps (reach, collide,
// leave). A greatest one holds for what is never driven out (trapped). The strongly connected
// components say which leaves wait for each other. None of them knows how the vehicle moves: that
// is in the links.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fairway/base/interval.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/verify/leaf_graph.hpp"

namespace fairway {

/// The verdicts of everything that flights of a leaf end in or arrive at, with a bound of the time
/// to them; `verdict_at(leaf)` returns those of leaves.
///
/// A link that moves every state of the leaf along its own section leads out of the leaf after
/// finitely many hops, so it may touch the leaf itself. A state may have done all those hops
/// before it does anything else, so the time bound includes them for every other link.
template <typename VerdictAt>
VerdictSet image_verdicts(const LeafGraph& graph, LeafGraph::Id id, const VerdictAt& verdict_at) {
  VerdictSet found = graph.ends(id);
  if (graph.gave_up(id)) found.add(Verdict::undecided, 0.0);
  if (graph.is_hopeless(id)) return found;
  double hops_s = 0.0;
  for (const LeafGraph::Link& link : graph.links(id)) {
    const auto flown_s = static_cast<double>(link.flown_s);
    if (!graph.has_leaves(link.section)) found.add(Verdict::undecided, 0.0);
    graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
      if (other.id == id && link.hop != 0) {
        const double move = graph.own_move(id, link);
        if (move > 0.0) {
          const double hops = std::floor(width_of(graph.place(id).range) / move);
          hops_s = std::max(hops_s, above(hops * flown_s));
          return;
        }
      }
      found.add(verdict_at(other), above(flown_s + static_cast<double>(other.time_s)));
    });
  }
  found.time_s = above(found.time_s + hops_s);
  return found;
}

/// Leaves to examine, each once.
class Worklist {
 public:
  void add(LeafGraph::Id id) {
    if (id >= waits_.size()) waits_.resize(id + std::size_t{1}, 0);
    if (waits_[id] != 0) return;
    waits_[id] = 1;
    ids_.push_back(id);
  }
  bool empty() const { return ids_.empty(); }
  /// Removes and returns all of them.
  std::vector<LeafGraph::Id> take() {
    for (const LeafGraph::Id id : ids_) waits_[id] = 0;
    return std::exchange(ids_, {});
  }
  LeafGraph::Id take_last() {
    const LeafGraph::Id id = ids_.back();
    ids_.pop_back();
    waits_[id] = 0;
    return id;
  }
  std::size_t bytes() const { return waits_.capacity() + ids_.capacity() * sizeof(LeafGraph::Id); }

 private:
  std::vector<LeafGraph::Id> ids_;
  std::vector<std::uint8_t> waits_;
};

/// A least fixpoint, by rounds: all waiting leaves are examined, on all threads, against the result
/// of the previous rounds; `conclude` then changes the graph and adds leaves that may now follow.
/// Independent of threads and of the order of the list. False: `go_on` stopped it between rounds.
template <typename Examine, typename Conclude>
bool least_by_rounds(Worklist& waiting, const std::function<bool()>& go_on, const Examine& examine,
                     const Conclude& conclude) {
  using Finding = decltype(examine(LeafGraph::Id{}));
  static_assert(!std::is_same_v<Finding, bool>, "threads write findings side by side");
  constexpr std::size_t worth_sharing = 256;
  std::vector<Finding> findings;
  while (!waiting.empty()) {
    if (!go_on()) return false;
    const std::vector<LeafGraph::Id> round = waiting.take();
    findings.assign(round.size(), {});
    const auto look = [&](std::size_t a, std::size_t b) {
      for (std::size_t k = a; k < b; ++k) findings[k] = examine(round[k]);
    };
    if (round.size() < worth_sharing) {
      look(0, round.size());
    } else {
      for_ranges(round.size(), 64, look);
    }
    conclude(round, std::as_const(findings));
  }
  return true;
}

/// A greatest fixpoint, by removal: the largest part of `among` in which `stays(leaf, is_in)` holds
/// for every leaf, where `is_in(leaf)` says which leaves are left. In the order of `among`.
template <typename Stays>
std::vector<LeafGraph::Id> greatest_by_removal(const LeafGraph& graph,
                                               std::vector<LeafGraph::Id> among,
                                               const Stays& stays) {
  if (among.empty()) return among;
  std::vector<std::uint8_t> in(graph.ids(), 0);
  const auto is_in = [&](LeafGraph::Id id) { return id != LeafGraph::none && in[id] != 0; };
  for (const LeafGraph::Id id : among) in[id] = 1;
  // Most are found out at once, on all threads: each writes to its own place.
  std::vector<std::uint8_t> doubted(among.size(), 0);
  for_ranges(among.size(), 1024, [&](std::size_t a, std::size_t b) {
    for (std::size_t k = a; k < b; ++k) doubted[k] = stays(among[k], is_in) ? 0 : 1;
  });
  Worklist doubtful;
  for (std::size_t k = 0; k < among.size(); ++k) {
    if (doubted[k] != 0) doubtful.add(among[k]);
  }
  doubted = std::vector<std::uint8_t>();
  while (!doubtful.empty()) {
    const LeafGraph::Id id = doubtful.take_last();
    if (!is_in(id) || stays(id, is_in)) continue;
    in[id] = 0;
    const LeafPlace place = graph.place(id);
    graph.for_dependents(place.section, place.range, [&](LeafGraph::Id other) {
      if (is_in(other)) doubtful.add(other);
    });
  }
  std::erase_if(among, [&](LeafGraph::Id id) { return !is_in(id); });
  return among;
}

/// The strongly connected components of `among` under links: leaves that wait for each other. A
/// component comes after those it leads to; its leaves ascend.
[[nodiscard]] std::vector<std::vector<LeafGraph::Id>> components(
    const LeafGraph& graph, std::span<const LeafGraph::Id> among);

}  // namespace fairway
