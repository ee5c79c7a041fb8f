#include "fairway/verify/reprove.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/verify/fixpoints.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/leaf_graph.hpp"
#include "fairway/verify/section_flight.hpp"

namespace fairway {
namespace {

using Id = LeafGraph::Id;
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Clears what no leaf may claim, and what a trapped one need not claim.
void drop_nonsense(SectionVerdicts& s) {
  for (std::size_t i = 0; i < s.leaves(); ++i) {
    if (s.verdict[i] >= stored_verdict_count)
      s.verdict[i] = static_cast<std::uint8_t>(Verdict::undecided);
    const auto verdict = static_cast<Verdict>(s.verdict[i]);
    const bool ends = verdict != Verdict::trapped && verdict != Verdict::undecided;
    if (ends && std::isfinite(s.time_s[i])) continue;
    if (verdict != Verdict::trapped) s.verdict[i] = static_cast<std::uint8_t>(Verdict::undecided);
    s.rank[i] = 0;
    s.time_s[i] = verdict == Verdict::trapped ? infinite : 0.0F;
  }
}

/// The decided leaves, each with its image.
LeafGraph flown(const Flow& flow, const SectionVerdicts& claimed, int most_crossings,
                const std::function<bool()>& go_on) {
  LeafGraph graph(claimed, LeafGraph::Keep::all_links);
  std::vector<Id> decided;
  std::vector<LeafPlace> places;
  for (Id id = 0; id < graph.ids(); ++id) {
    if (graph.is_open(id)) continue;
    decided.push_back(id);
    places.push_back(graph.place(id));
  }
  const ImageStore images = leaf_images(flow, places, most_crossings, go_on);
  for (std::size_t i = 0; i < decided.size(); ++i) graph.set_image(decided[i], images[i]);
  return graph;
}

/// The rule, where `holds[leaf]` says which verdicts count.
bool obeys_the_rule(const LeafGraph& graph, Id id, const std::vector<std::uint8_t>& holds) {
  const auto verdict_at = [&](const LeafGraph::Leaf& other) {
    return holds[other.id] != 0 ? other.verdict : Verdict::undecided;
  };
  const VerdictSet found = image_verdicts(graph, id, verdict_at);
  if (found.only() != graph.verdict(id)) return false;
  if (graph.verdict(id) == Verdict::trapped) return true;
  bool ranks_fall = true;
  for (const LeafGraph::Link& link : graph.links(id)) {
    graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
      const bool hops_off = other.id == id && graph.own_move(id, link) > 0.0;
      ranks_fall = ranks_fall && (hops_off || graph.rank(other.id) < graph.rank(id));
    });
  }
  return ranks_fall && found.time_s <= static_cast<double>(graph.time_s(id));
}

/// Further work needs ranks above these: ranks that no correct proof would reach are renumbered in
/// their order, which is all that matters.
void make_room_above(std::vector<std::uint32_t>& rank) {
  constexpr std::uint32_t high = 0x10000000;
  if (rank.empty() || *std::max_element(rank.begin(), rank.end()) < high) return;
  std::vector<std::uint32_t> in_order = rank;
  std::sort(in_order.begin(), in_order.end());
  in_order.erase(std::unique(in_order.begin(), in_order.end()), in_order.end());
  for (std::uint32_t& r : rank) {
    const auto at = std::lower_bound(in_order.begin(), in_order.end(), r);
    r = static_cast<std::uint32_t>(at - in_order.begin());
  }
}

}  // namespace

bool sections_fit(const Flow& flow, const SectionVerdicts& sections) {
  if (sections.first.size() != 4 * flow.grid.size() + 1) return false;
  for (std::size_t s = 0; s + 1 < sections.first.size(); ++s) {
    if ((sections.first[s] < sections.first[s + 1]) != is_section(flow, s)) return false;
  }
  return true;
}

SectionVerdicts reproved(const Flow& flow, SectionVerdicts claimed, int most_crossings,
                         const std::function<bool()>& go_on) {
  require(sections_fit(flow, claimed), "the sections with leaves match the flow");
  drop_nonsense(claimed);
  const LeafGraph graph = flown(flow, claimed, most_crossings, go_on);
  std::vector<std::uint8_t> holds(graph.ids());
  for (Id id = 0; id < graph.ids(); ++id) holds[id] = graph.is_open(id) ? 0 : 1;

  // A greatest fixpoint, by removal; because ranks fall, all its flights meet their ends. The first
  // round is nearly all of the work.
  std::vector<std::uint8_t> fails(graph.ids(), 0);
  for_ranges(fails.size(), 1024, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i) {
      const Id id = static_cast<Id>(i);
      fails[i] = holds[i] != 0 && !obeys_the_rule(graph, id, holds) ? 1 : 0;
    }
  });
  Worklist fallen;
  for (Id id = 0; id < graph.ids(); ++id) {
    if (fails[id] == 0) continue;
    holds[id] = 0;
    fallen.add(id);
  }
  while (!fallen.empty()) {
    const LeafPlace place = graph.place(fallen.take_last());
    graph.for_dependents(place.section, place.range, [&](Id other) {
      if (holds[other] == 0 || obeys_the_rule(graph, other, holds)) return;
      holds[other] = 0;
      fallen.add(other);
    });
  }
  // The ids in a new graph number the leaves in order.
  for (std::size_t i = 0; i < claimed.leaves(); ++i) {
    if (holds[i] != 0) continue;
    claimed.verdict[i] = static_cast<std::uint8_t>(Verdict::undecided);
    claimed.rank[i] = 0;
    claimed.time_s[i] = 0.0F;
  }
  make_room_above(claimed.rank);
  return claimed;
}

}  // namespace fairway
