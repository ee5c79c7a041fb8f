// Where to begin from an earlier proof. Its verdicts are not looked at: leaves begin where they
// began there, and what follows from them is found again.
#include <algorithm>

#include "fairway/base/error.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/crossing_graph.hpp"

namespace fairway {

void CrossingGraph::begin_as(const ContractVerdicts& earlier) {
  require(earlier.first.size() == first_.size(), "earlier leaves are of the same parts");
  constexpr std::uint64_t whole_side = 0x100000000U;
  constexpr auto unit = static_cast<std::uint32_t>(whole_side / side_units);
  std::vector<Leaf> leaf;
  std::vector<LinkStore::Place> place;
  leaf.reserve(std::max(leaf_.size(), earlier.leaves()));
  for (std::size_t s = 0; s < sections(); ++s) {
    const Id begin = first_[s];
    const Id end = first_[s + 1];
    const auto new_first = static_cast<Id>(leaf.size());
    std::size_t next = earlier.first[s];
    for (Id id = begin; id < end; ++id) {
      leaf.push_back(leaf_[id]);
      place.push_back(slots_.has(id) ? place_[slot(id)] : LinkStore::Place{});
      const LeafState state = leaf_[id].state;
      if (state == LeafState::idle || state == LeafState::closed) continue;
      const std::uint32_t until = id + 1 < end ? leaf_[id + 1].begin : side_units;
      for (; next < earlier.first[s + 1] && earlier.begin[next] / unit < until; ++next) {
        const std::uint32_t at = earlier.begin[next] / unit;
        if (at <= leaf.back().begin) continue;
        leaf.back() = {.begin = leaf.back().begin};
        place.back() = {};
        leaf.push_back({.begin = at});
        place.emplace_back();
      }
    }
    first_[s] = new_first;  // read no more: ends are taken before
  }
  first_.back() = static_cast<Id>(leaf.size());
  require(leaf.size() < ~Id{0}, "a plan has fewer than 2^32 leaves");
  leaf_.resize(leaf.size());
  std::copy(leaf.begin(), leaf.end(), leaf_.all().begin());
  take_slots();
  place_.clear();
  for (Id id = 0; id < leaf.size(); ++id) {
    if (slots_.has(id)) place_.push_back(place[id]);
  }
  links_.keep(place_);
}

}  // namespace fairway
