#include "fairway/bitmap/bitmap_expansion.hpp"

#include <cstddef>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/bitmap/bitmap_graph.hpp"

namespace fairway {
namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t in_region = nowhere - 1;

/// Where every state flies to: a state, the region, or nowhere.
std::vector<std::uint32_t> successors_of(const BitmapGraph& graph) {
  const int m = graph.samples().count();
  const auto ends_as = [](BitmapEnd end) {
    return end == BitmapEnd::reached ? in_region : nowhere;
  };
  std::vector<std::uint32_t> next;
  for (std::size_t border = 0; border < graph.borders().count(); ++border) {
    for (int k = 0; k < m; ++k) {
      for (int i = 0; i < m; ++i) {
        const BitmapGraph::Node node = graph.node_at(border, k, i);
        if (graph.end_of(node) != BitmapEnd::none) {
          next.push_back(ends_as(graph.end_of(node)));
          continue;
        }
        const BitmapGraph::Node after = graph.successor(node, graph.row_of(node));
        const auto place = [&] {
          return (graph.border_of(after) * static_cast<std::size_t>(m) +
                  static_cast<std::size_t>(after.heading)) *
                     static_cast<std::size_t>(m) +
                 static_cast<std::size_t>(after.position);
        };
        next.push_back(graph.end_of(after) == BitmapEnd::none ? static_cast<std::uint32_t>(place())
                                                              : ends_as(graph.end_of(after)));
      }
    }
  }
  return next;
}

}  // namespace

BitmapExpansion expand_borders(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                               const BitmapOptions& options) {
  const BitmapGraph graph(plan, target_cells, options.samples);
  BitmapExpansion out{{plan.grid, options.samples, {}}, 0};
  BorderBitmap& set = out.set;
  const std::size_t per_border = set.states_per_border();
  require(graph.borders().count() * per_border < (std::size_t{1} << 31),
          "the reference expansion takes fewer than 2^31 states");
  set.words = BitmapWords(graph.borders().count() * set.words_per_border());
  const std::vector<std::uint32_t> next = successors_of(graph);
  const auto word_of = [&](std::size_t state) -> std::uint64_t& {
    return set.words[state / per_border * set.words_per_border() + state % per_border / 64];
  };
  const auto bit_of = [&](std::size_t state) {
    return std::uint64_t{1} << (state % per_border % 64);
  };
  for (bool added = true; added;) {
    added = false;
    ++out.sweeps;
    for (std::size_t state = 0; state < next.size(); ++state) {
      const std::uint32_t to = next[state];
      if (to == nowhere || (word_of(state) & bit_of(state)) != 0) continue;
      if (to != in_region && (word_of(to) & bit_of(to)) == 0) continue;
      word_of(state) |= bit_of(state);
      added = true;
    }
  }
  return out;
}

}  // namespace fairway
