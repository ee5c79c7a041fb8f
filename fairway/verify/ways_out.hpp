// Which open leaves lead only to each other, found again and again while the graph changes.
//
// A leaf that is not one of them has a way of links, over open leaves, to one that `leaks`: that
// leads to something else, whatever becomes of other leaves. One such way is kept of every leaf, by
// its first step. It holds until a leaf on it is cut or decided; only then another is looked for.
// So the work follows what has changed, not what is open.
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
  }
  void forget_all() { step_.clear(); }

  /// The open leaves, in the order of their ids, that have no way to one that leaks. A leaf that
  /// leaks does so until it is cut; every other one is among the dependents of its links.
  template <typename Leaks>
  std::vector<Id> lacking(const LeafGraph& graph, const Leaks& leaks) {
    step_.resize(graph.ids(), unknown);
    state_.assign(graph.ids(), unseen);
    for_ranges(graph.ids(), 4096, [&](std::size_t a, std::size_t b) {
      std::vector<Id> way;
      for (std::size_t id = a; id < b; ++id) {
        if (graph.is_open(static_cast<Id>(id))) follow(graph, static_cast<Id>(id), way);
      }
    });
    std::vector<Id> lacking;
    for (Id id = 0; id < graph.ids(); ++id) {
      if (state_[id] == is_lost) lacking.push_back(id);
    }
    gather(lacking, [&](Id id, std::vector<Id>& found) {
      step_[id] = leaks(id) ? it_leaks : first_step(graph, id);
      if (step_[id] == unknown) return;
      state(id).store(gets_out, std::memory_order_relaxed);
      found.push_back(id);
    });
    while (!round_.empty()) {
      const std::vector<Id> round = std::exchange(round_, {});
      gather(round, [&](Id id, std::vector<Id>& found) {
        const LeafPlace place = graph.place(id);
        graph.for_dependents(place.section, place.range, [&](Id other) {
          if (state(other).load(std::memory_order_relaxed) != is_lost) return;
          std::uint8_t was = is_lost;
          if (!state(other).compare_exchange_strong(was, gets_out)) return;
          step_[other] = id;
          found.push_back(other);
        });
      });
    }
    std::erase_if(lacking, [&](Id id) { return state_[id] != is_lost; });
    return lacking;
  }
  std::size_t bytes() const { return step_.capacity() * sizeof(Id) + state_.capacity(); }

 private:
  static constexpr Id unknown = LeafGraph::none;
  static constexpr Id it_leaks = unknown - 1;
  enum State : std::uint8_t { unseen, is_lost, gets_out };

  std::atomic_ref<std::uint8_t> state(Id id) { return std::atomic_ref(state_[id]); }

  /// Follows the way kept of a leaf; what it ends in holds for every leaf on it.
  void follow(const LeafGraph& graph, Id id, std::vector<Id>& way) {
    way.clear();
    std::uint8_t end = unseen;
    while ((end = state(id).load(std::memory_order_relaxed)) == unseen) {
      way.push_back(id);
      const Id next = step_[id];
      if (next == it_leaks) {
        end = gets_out;
        break;
      }
      if (next == unknown || !graph.is_open(next)) {
        end = is_lost;
        break;
      }
      id = next;
    }
    for (const Id on_it : way) state(on_it).store(end, std::memory_order_relaxed);
  }

  /// Another leaf that it leads to and that gets out, or unknown.
  Id first_step(const LeafGraph& graph, Id id) {
    Id found = unknown;
    for (const LeafGraph::Link& link : graph.links(id)) {
      graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
        if (found != unknown || other.id == LeafGraph::none || !graph.is_open(other.id)) return;
        if (state(other.id).load(std::memory_order_relaxed) == gets_out) found = other.id;
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

  std::vector<Id> step_;             // [id], the next leaf on its way out
  std::vector<std::uint8_t> state_;  // [id]
  std::vector<Id> round_;            // get out; what leads there is still to be looked at
};

}  // namespace fairway
