#include "fairway/inclusion/crossing_graph.hpp"

#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

std::uint16_t unit_below(double place) {
  return static_cast<std::uint16_t>(
      std::clamp(std::floor(place * side_units), 0.0, side_units - 1.0));
}
/// The last unit that [.., place] touches.
std::uint16_t last_unit(double place) {
  return static_cast<std::uint16_t>(
      std::clamp(std::ceil(place * side_units) - 1.0, 0.0, side_units - 1.0));
}

/// Whether some behaviour crosses out of the side.
bool is_crossed(const Parts& parts, PartPlace part, std::size_t side) {
  return parts.arc(part).meets({0.5 * pi * (static_cast<double>(side) - 1.0), pi});
}

}  // namespace

CrossingLink CrossingLink::of(const Crossing& crossing, std::size_t part_index) {
  constexpr double coarse_rad = 1e-6;  // above the rounding of floats
  CrossingLink link;
  link.section = static_cast<std::uint32_t>(section_number(part_index, crossing.side));
  link.lo = unit_below(crossing.lo);
  link.hi = std::max(link.lo, last_unit(crossing.hi));
  link.heading_lo_rad =
      static_cast<float>(std::remainder(crossing.headings.lo_rad, whole_turn_rad) - coarse_rad);
  link.heading_width_rad = static_cast<float>(crossing.headings.width_rad + 2.0 * coarse_rad);
  link.flown = static_cast<float>(crossing.flown * generous);
  return link;
}

CrossingGraph::CrossingGraph(const Parts& parts, std::uint32_t pieces)
    : first_(sections_per_part * parts.size() + 1) {
  require(sections_per_part * parts.size() < ~Id{0} / pieces, "a plan has fewer than 2^32 leaves");
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const PartPlace place = parts.place(p);
    for (std::size_t side = 0; side < sections_per_part; ++side) {
      first_[sections_per_part * p + side] = static_cast<Id>(leaf_.size());
      if (parts.kind(place) != PartKind::ordinary) continue;
      const bool crossed = is_crossed(parts, place, side);
      for (std::uint32_t k = 0; k < (crossed ? pieces : 1U); ++k) {
        Leaf& leaf = leaf_.emplace_back();
        leaf.begin = side_units / pieces * k;
        leaf.state = crossed ? LeafState::fresh : LeafState::idle;
      }
    }
  }
  first_.back() = static_cast<Id>(leaf_.size());
  first_link_.assign(leaf_.size() + 1, 0);
}

std::size_t CrossingGraph::section_of(Id id) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), id);
  return static_cast<std::size_t>(next - first_.begin()) - 1;
}

CrossingGraph::Range CrossingGraph::leaves_of(std::size_t section, std::uint32_t lo,
                                              std::uint32_t hi) const {
  const Id begin = first_[section];
  Id last = first_[section + 1];
  Id at = begin;
  Id high = last;
  while (at < high) {  // the first leaf that begins after lo
    const Id middle = at + (high - at) / 2;
    if (leaf_[middle].begin <= lo) {
      at = middle + 1;
    } else {
      high = middle;
    }
  }
  const Id low = at > begin ? at - 1 : begin;
  Id end = at;
  while (end < last && leaf_[end].begin < hi) ++end;
  return {low, end};
}

void CrossingGraph::fly(const Parts& parts, const BehaviourOptions& options,
                        const std::function<bool()>& go_on) {
  std::vector<Id> fresh;
  std::vector<std::uint32_t> section;
  for (std::size_t s = 0; s < sections(); ++s) {
    for (Id id = first_[s]; id < first_[s + 1]; ++id) {
      if (leaf_[id].state != LeafState::fresh) continue;
      fresh.push_back(id);
      section.push_back(static_cast<std::uint32_t>(s));
    }
  }
  constexpr std::size_t chunk = 64;
  struct Flown {
    std::vector<CrossingLink> links;
    std::array<std::uint32_t, chunk> count{};
  };
  std::vector<Flown> flown((fresh.size() + chunk - 1) / chunk);
  for_ranges(flown.size(), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t c = a; c < b && go_on(); ++c) {
      for (std::size_t k = c * chunk; k < std::min(fresh.size(), (c + 1) * chunk); ++k) {
        const Id id = fresh[k];
        Leaf& leaf = leaf_[id];
        const std::size_t s = section[k];
        const BehaviourImage image =
            image_of_crossing(parts, parts.place(s / 4), static_cast<PartSide>(s % 4),
                              leaf.begin / static_cast<double>(side_units),
                              end_of(id, s) / static_cast<double>(side_units), options);
        leaf.state = LeafState::open;
        leaf.ends = image.ends;
        leaf.gave_up = image.gave_up;
        leaf.distance_m = image.distance_m;
        leaf.off_rad = std::nextafter(static_cast<float>(image.off_rad), HUGE_VALF);
        leaf.end_flown = static_cast<float>(image.flown * generous);
        if (image.gave_up) continue;
        for (const Crossing& crossing : image.crossings) {
          flown[c].links.push_back(CrossingLink::of(crossing, parts.index(crossing.part)));
        }
        flown[c].count[k % chunk] = static_cast<std::uint32_t>(image.crossings.size());
      }
    }
  });
  // The links in the order of the leaves.
  std::vector<std::uint32_t> first_link(leaf_.size() + 1);
  std::size_t total = link_.size();
  for (const Flown& f : flown) total += f.links.size();
  require(total < ~std::uint32_t{0}, "a plan has fewer than 2^32 links");
  std::vector<CrossingLink> link;
  link.reserve(total);
  std::size_t next = 0;  // of fresh
  std::size_t taken = 0;
  for (Id id = 0; id < leaf_.size(); ++id) {
    first_link[id] = static_cast<std::uint32_t>(link.size());
    if (next < fresh.size() && fresh[next] == id) {
      Flown& f = flown[next / chunk];
      if (next % chunk == 0) taken = 0;
      const std::uint32_t count = f.count[next % chunk];
      link.insert(link.end(), f.links.begin() + static_cast<std::ptrdiff_t>(taken),
                  f.links.begin() + static_cast<std::ptrdiff_t>(taken + count));
      taken += count;
      if (++next % chunk == 0) f.links = {};
    } else {
      const auto old = links(id);
      link.insert(link.end(), old.begin(), old.end());
    }
  }
  first_link.back() = static_cast<std::uint32_t>(link.size());
  link_ = std::move(link);
  first_link_ = std::move(first_link);
}

void CrossingGraph::cut(const std::vector<bool>& which) {
  std::vector<Leaf> leaf;
  std::vector<std::uint32_t> first_link;
  std::vector<CrossingLink> link;
  for (std::size_t s = 0; s < sections(); ++s) {
    const Id begin = first_[s];
    const Id end = first_[s + 1];
    const Id new_first = static_cast<Id>(leaf.size());
    for (Id id = begin; id < end; ++id) {
      const Leaf& old = leaf_[id];
      first_link.push_back(static_cast<std::uint32_t>(link.size()));
      if (which[id]) {
        const std::uint32_t middle =
            old.begin + ((id + 1 < end ? leaf_[id + 1].begin : side_units) - old.begin) / 2;
        for (const std::uint32_t at : {old.begin, middle}) {
          Leaf& half = leaf.emplace_back();
          half.begin = at;
          if (at == old.begin) first_link.push_back(static_cast<std::uint32_t>(link.size()));
        }
        continue;
      }
      leaf.push_back(old);
      if (old.state != LeafState::open) continue;
      const auto kept = links(id);
      link.insert(link.end(), kept.begin(), kept.end());
    }
    first_[s] = new_first;  // read no more: ends are taken before
  }
  first_.back() = static_cast<Id>(leaf.size());
  first_link.push_back(static_cast<std::uint32_t>(link.size()));
  require(leaf.size() < ~Id{0}, "a plan has fewer than 2^32 leaves");
  leaf_ = std::move(leaf);
  link_ = std::move(link);
  first_link_ = std::move(first_link);
}

}  // namespace fairway
