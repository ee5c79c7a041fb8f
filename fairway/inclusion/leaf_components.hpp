// Strongly connected components of leaves, those that others lead to first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/inclusion/crossing_graph.hpp"

namespace fairway {

/// Tarjan's algorithm, without recursion.
template <typename Counts>
class LeafComponents {
 public:
  LeafComponents(const CrossingGraph& graph, const Counts& counts)
      : graph_(graph), counts_(counts), number_(graph.slots(), 0) {}

  template <typename Body>
  void for_each(const Body& body) {
    for (Id root = 0; root < graph_.leaves(); ++root) {
      if (!counts_(root) || number_[graph_.slot(root)] != 0) continue;
      enter(root);
      while (!way_.empty()) {
        Visit& visit = way_.back();
        if (next_target(visit)) {
          const Id to = visit.target++;
          if (!counts_(to)) continue;
          const std::uint32_t number = number_[graph_.slot(to)];
          if (number == 0) {
            enter(to);
          } else if (number != done) {
            visit.low = std::min(visit.low, number);
          }
          continue;
        }
        const Id left = visit.leaf;
        const std::uint32_t low = visit.low;
        way_.pop_back();
        if (!way_.empty()) way_.back().low = std::min(way_.back().low, low);
        if (low != number_[graph_.slot(left)]) continue;
        auto first = stack_.end();
        while (*--first != left) {
        }
        const std::span<const Id> members(first, stack_.end());
        body(members);
        for (const Id id : members) number_[graph_.slot(id)] = done;
        stack_.erase(first, stack_.end());
      }
    }
  }

 private:
  using Id = CrossingGraph::Id;
  static constexpr std::uint32_t done = ~std::uint32_t{0};
  struct Visit {
    Id leaf;
    Id target;
    Id last;
    std::uint32_t link;  // the next one
    std::uint32_t low;   // the lowest number on the stack that is met so far
  };

  void enter(Id id) {
    number_[graph_.slot(id)] = ++count_;
    stack_.push_back(id);
    way_.push_back({id, 0, 0, 0, count_});
  }
  bool next_target(Visit& visit) const {
    const auto links = graph_.links(visit.leaf);
    while (visit.target >= visit.last) {
      if (visit.link >= links.size()) return false;
      const CrossingGraph::Range range = graph_.leaves_of(links[visit.link++]);
      visit.target = range.first;
      visit.last = range.last;
    }
    return true;
  }

  const CrossingGraph& graph_;
  Counts counts_;
  std::vector<std::uint32_t> number_;  // [slots]
  std::vector<Id> stack_;
  std::vector<Visit> way_;
  std::uint32_t count_ = 0;
};

/// Calls body(members) for every component of the leaves with counts(leaf), which have slots; what
/// body does to a leaf that is told may make it count no more.
template <typename Counts, typename Body>
void for_components(const CrossingGraph& graph, const Counts& counts, const Body& body) {
  LeafComponents<Counts>(graph, counts).for_each(body);
}

}  // namespace fairway
