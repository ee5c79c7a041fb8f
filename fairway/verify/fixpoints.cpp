#include "fairway/verify/fixpoints.hpp"

namespace fairway {
namespace {

using Id = LeafGraph::Id;

/// Tarjan's algorithm, with an explicit stack instead of recursion.
class Components {
 public:
  Components(const LeafGraph& graph, std::span<const Id> among)
      : graph_(graph), number_(graph.ids(), absent), lowest_(graph.ids(), absent) {
    for (const Id id : among) number_[id] = unseen;
    for (const Id id : among) {
      if (number_[id] == unseen) explore(id);
    }
  }
  std::vector<std::vector<Id>> found;

 private:
  static constexpr std::uint32_t absent = ~std::uint32_t{0};
  static constexpr std::uint32_t unseen = absent - 1;
  static constexpr std::uint32_t closed = absent - 2;

  struct Visit {
    Id id;
    std::vector<Id> next;  // not yet examined
  };

  void enter(Id id) {
    number_[id] = lowest_[id] = count_++;
    open_.push_back(id);
    Visit visit{id, {}};
    for (const LeafGraph::Link& link : graph_.links(id)) {
      graph_.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
        const bool counts = other.id != LeafGraph::none && number_[other.id] != absent;
        if (counts && other.id != id) visit.next.push_back(other.id);
      });
    }
    visits_.push_back(std::move(visit));
  }
  void explore(Id root) {
    enter(root);
    while (!visits_.empty()) {
      Visit& visit = visits_.back();
      const Id id = visit.id;
      if (visit.next.empty()) {
        visits_.pop_back();
        if (lowest_[id] == number_[id]) close(id);
        if (!visits_.empty()) {
          const Id parent = visits_.back().id;
          lowest_[parent] = std::min(lowest_[parent], lowest_[id]);
        }
        continue;
      }
      const Id other = visit.next.back();
      visit.next.pop_back();
      if (number_[other] == unseen) {
        enter(other);  // `visit` may have moved
      } else if (number_[other] != closed) {
        lowest_[id] = std::min(lowest_[id], number_[other]);
      }
    }
  }
  void close(Id first) {
    std::vector<Id>& component = found.emplace_back();
    Id id = LeafGraph::none;
    do {
      id = open_.back();
      open_.pop_back();
      number_[id] = closed;
      lowest_[id] = absent;  // never lowers another
      component.push_back(id);
    } while (id != first);
    std::sort(component.begin(), component.end());
  }

  const LeafGraph& graph_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> lowest_;
  std::vector<Id> open_;
  std::vector<Visit> visits_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::vector<std::vector<Id>> components(const LeafGraph& graph, std::span<const Id> among) {
  return Components(graph, among).found;
}

}  // namespace fairway
