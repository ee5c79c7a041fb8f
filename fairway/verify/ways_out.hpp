// Which open leaves lead only to each other, found again and again while the graph changes.
//
// A leaf that is not one of them has a way of links, over open leaves, to one that `leaks`: that
// leads to something else, whatever becomes of other leaves. Of every leaf the first step of such a
// way is kept, until the leaf that it leads to is cut or decided; only then another is looked for,
// of it and of those whose ways led over it. So the work follows what has changed, not what is
// open.
//
// What is found is no proof: it may be too much, never too little (greatest_by_removal proves).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "fairway/base/parallel.hpp"
#include "fairway/verify/leaf_graph.hpp"

namespace fairway {

class WaysOut {
 public:
  using Id = LeafGraph::Id;

  /// The leaf is new, or its image.
  void forget(Id id) {
    if (id >= step_.size()) step_.resize(id + std::size_t{1}, unknown);
    step_[id] = unknown;
    changed_.push_back(id);
  }
  /// The leaf `to` is about to be cut, or was decided; that one is among its dependents.
  void forget_step(Id id, Id to) {
    if (step_[id] == to) forget(id);
  }
  void forget_all(const LeafGraph& graph) {
    for (Id id = 0; id < graph.ids(); ++id) forget(id);
  }

  /// The open leaves, in the order of their ids, that have no way to one that leaks. A leaf that
  /// leaks does so until it is cut; every other one is among the dependents of its links.
  template <typename Leaks>
  std::vector<Id> lacking(const LeafGraph& graph, const Leaks& leaks) {
    lost_.resize(step_.size(), 0);
    std::vector<Id> lost = without_step(graph);
    gather(lost, [&](Id id, std::vector<Id>& found) {
      step_[id] = leaks(id) ? it_leaks : first_step(graph, id);
      if (step_[id] == unknown) return;
      is_lost(id).store(0, std::memory_order_relaxed);
      found.push_back(id);
    });
    while (!round_.empty()) {
      const std::vector<Id> round = std::exchange(round_, {});
      gather(round, [&](Id id, std::vector<Id>& found) {
        const LeafPlace place = graph.place(id);
        graph.for_dependents(place.section, place.range, [&](Id other) {
          if (is_lost(other).load(std::memory_order_relaxed) == 0) return;
          if (is_lost(other).exchange(0, std::memory_order_relaxed) == 0) return;
          step_[other] = id;
          found.push_back(other);
        });
      });
    }
    std::erase_if(lost, [&](Id id) { return lost_[id] == 0; });
    for (const Id id : lost) {
      lost_[id] = 0;
      forget(id);  // if they stay, they are looked at again
    }
    std::sort(lost.begin(), lost.end());
    return lost;
  }
  std::size_t bytes() const {
    return step_.capacity() * sizeof(Id) + lost_.capacity() + changed_.capacity() * sizeof(Id);
  }

 private:
  static constexpr Id unknown = LeafGraph::none;
  static constexpr Id it_leaks = unknown - 1;

  std::atomic_ref<std::uint8_t> is_lost(Id id) { return std::atomic_ref(lost_[id]); }

  /// The open leaves that have lost their way, each once: those that changed, and those whose ways
  /// lead over them.
  std::vector<Id> without_step(const LeafGraph& graph) {
    std::vector<Id> lost;
    for (const Id id : std::exchange(changed_, {})) {
      if (!graph.is_open(id) || step_[id] != unknown || lost_[id] != 0) continue;
      lost_[id] = 1;
      lost.push_back(id);
    }
    for (std::size_t k = 0; k < lost.size(); ++k) {
      const Id id = lost[k];
      const LeafPlace place = graph.place(id);
      graph.for_dependents(place.section, place.range, [&](Id other) {
        if (step_[other] != id || lost_[other] != 0) return;
        lost_[other] = 1;
        step_[other] = unknown;
        lost.push_back(other);
      });
    }
    return lost;
  }

  /// Another leaf that it leads to and that gets out, or unknown.
  Id first_step(const LeafGraph& graph, Id id) {
    Id found = unknown;
    for (const LeafGraph::Link& link : graph.links(id)) {
      graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
        if (found != unknown || other.id == LeafGraph::none || !graph.is_open(other.id)) return;
        if (is_lost(other.id).load(std::memory_order_relaxed) == 0) found = other.id;
      });
      if (found != unknown) break;
    }
    return found;
  }

  /// Calls with each leaf and a list to add to; the lists together are the next round.
  template <typename Body>
  void gather(const std::vector<Id>& ids, const Body& body) {
    constexpr std::size_t grain = 512;
    std::mutex gathering;
    const auto some = [&](std::size_t a, std::size_t b) {
      std::vector<Id> found;
      for (std::size_t k = a; k < b; ++k) body(ids[k], found);
      const std::lock_guard<std::mutex> lock(gathering);
      round_.insert(round_.end(), found.begin(), found.end());
    };
    if (ids.size() < 2 * grain) {
      some(0, ids.size());
    } else {
      for_ranges(ids.size(), grain, some);
    }
  }

  std::vector<Id> step_;            // [id], where its way out goes on
  std::vector<std::uint8_t> lost_;  // [id], while they are looked for
  std::vector<Id> changed_;         // without a step; some twice, or of no leaf any more
  std::vector<Id> round_;           // get out; what leads there is still to be looked at
};

}  // namespace fairway
