#include "fairway/inclusion/crossing_graph.hpp"

#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/inclusion/set_flight.hpp"
#include "fairway/inclusion/tube.hpp"

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

}  // namespace

CrossingLink CrossingLink::of(const Crossing& crossing, std::size_t part_index) {
  constexpr double units_per_rad = 0x1p16 / whole_turn_rad;
  constexpr double rounding = 1e-3;  // of a unit
  CrossingLink link;
  link.section = static_cast<std::uint32_t>(section_number(part_index, crossing.side));
  link.lo = unit_below(crossing.lo);
  link.hi = std::max(link.lo, last_unit(crossing.hi));
  const double from = units_per_rad * counted_from_zero(crossing.headings.lo_rad) - rounding;
  const double first = std::floor(from);
  const double to = from + units_per_rad * crossing.headings.width_rad + 2.0 * rounding;
  link.heading_lo = static_cast<std::uint16_t>(static_cast<std::int64_t>(first) & 0xffff);
  link.heading_width =
      static_cast<std::uint16_t>(std::clamp(std::ceil(to) - first - 1.0, 0.0, 65535.0));
  link.flown = static_cast<float>(crossing.flown * generous);
  return link;
}

bool CrossingLink::covers(const CrossingLink& other) const {
  const std::uint16_t off = static_cast<std::uint16_t>(other.heading_lo - heading_lo);
  return section == other.section && lo <= other.lo && hi >= other.hi && flown >= other.flown &&
         off + std::uint32_t{other.heading_width} <= heading_width;
}

LinkStore::Place LinkStore::add(std::span<const CrossingLink> links) {
  if (links.empty()) return {};
  require(links.size() <= block_size, "LinkStore: links fit into a block");
  if (block_.empty() || block_.back().size() + links.size() > block_size) {
    block_.emplace_back().reserve(block_size);
  }
  std::vector<CrossingLink>& last = block_.back();
  const Place place{static_cast<std::uint32_t>(block_.size() - 1),
                    static_cast<std::uint16_t>(last.size()),
                    static_cast<std::uint16_t>(links.size())};
  last.insert(last.end(), links.begin(), links.end());
  return place;
}

void LinkStore::keep(std::span<Place> places) {
  std::vector<std::size_t> waiting(block_.size(), 0);  // links not yet moved
  for (const Place& p : places) {
    if (p.count > 0) waiting[p.block] += p.count;
  }
  std::vector<bool> is_sparse(block_.size());
  for (std::size_t b = 0; b < block_.size(); ++b) {
    is_sparse[b] = 8 * waiting[b] < 7 * block_size;
    if (waiting[b] == 0) block_[b] = {};
  }
  block_.emplace_back();  // full: what is moved goes to new ones
  for (Place& p : places) {
    if (p.count == 0 || !is_sparse[p.block]) continue;
    const std::uint32_t from = p.block;
    p = add(of(p));
    waiting[from] -= p.count;
    if (waiting[from] == 0) block_[from] = {};
  }
  std::vector<std::uint32_t> number(block_.size());
  std::uint32_t count = 0;
  for (std::size_t b = 0; b < block_.size(); ++b) {
    number[b] = count;
    if (block_[b].empty()) continue;
    if (count < b) block_[count] = std::move(block_[b]);
    ++count;
  }
  block_.resize(count);
  for (Place& p : places) {
    if (p.count > 0) p.block = number[p.block];
  }
}

std::size_t LinkStore::bytes() const {
  std::size_t sum = block_.capacity() * sizeof(std::vector<CrossingLink>);
  for (const auto& block : block_) sum += block.capacity() * sizeof(CrossingLink);
  return sum;
}

CrossingGraph::CrossingGraph(const Parts& parts, std::uint32_t pieces)
    : first_(sections_per_part * parts.size() + 1) {
  require(sections_per_part * parts.size() < ~Id{0} / pieces, "a plan has fewer than 2^32 leaves");
  const auto is_ordinary = [&](std::size_t s) {
    return parts.kind(parts.place(s / sections_per_part)) == PartKind::ordinary;
  };
  const auto crossed = [&](std::size_t s) {
    return is_crossed(parts.arc(parts.place(s / sections_per_part)),
                      static_cast<PartSide>(s % sections_per_part));
  };
  for (std::size_t s = 0; s < sections(); ++s) {
    first_[s + 1] = first_[s] + (!is_ordinary(s) ? 0U : crossed(s) ? pieces : 1U);
  }
  leaf_.resize(first_.back());
  for (std::size_t s = 0; s < sections(); ++s) {
    for (Id id = first_[s]; id < first_[s + 1]; ++id) {
      leaf_[id].begin = side_units / pieces * (id - first_[s]);
      leaf_[id].state = crossed(s) ? LeafState::fresh : LeafState::idle;
    }
  }
  take_slots();
  place_.resize(slots());
}

/// Of the leaves as they are.
void CrossingGraph::take_slots() {
  slots_ = {};
  for (Id id = 0; id < leaf_.size(); ++id) {
    slots_.add(leaf_[id].state != LeafState::closed && leaf_[id].state != LeafState::idle);
  }
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

void CrossingGraph::fly_leaf(Id id, std::size_t section, const Parts& parts,
                             const BehaviourOptions& options, std::vector<CrossingLink>& links) {
  Leaf& leaf = leaf_[id];
  const BehaviourImage image =
      image_of_crossing(parts, parts.place(section / sections_per_part),
                        static_cast<PartSide>(section % sections_per_part),
                        leaf.begin / static_cast<double>(side_units),
                        end_of(id, section) / static_cast<double>(side_units), options);
  leaf.state = LeafState::open;
  leaf.ends = image.ends;
  leaf.gave_up = image.gave_up || image.crossings.size() > LinkStore::block_size;
  leaf.is_beside_tube = image.distance_m == Tube::outside;
  leaf.end_flown = static_cast<float>(image.flown * generous);
  links.clear();
  if (leaf.gave_up) return;
  for (const Crossing& crossing : image.crossings) {
    const CrossingLink link = CrossingLink::of(crossing, parts.index(crossing.part));
    // Successive steps of a turn often tell the same, of more headings.
    constexpr std::size_t most_asked = 16;
    const auto latest =
        links.end() - static_cast<std::ptrdiff_t>(std::min(links.size(), most_asked));
    if (std::any_of(latest, links.end(), [&](const CrossingLink& l) { return l.covers(link); })) {
      continue;
    }
    const auto covered =
        std::remove_if(latest, links.end(), [&](const CrossingLink& l) { return link.covers(l); });
    links.erase(covered, links.end());
    links.push_back(link);
  }
}

void CrossingGraph::fly(const Parts& parts, const BehaviourOptions& options,
                        const std::function<bool()>& go_on) {
  // Some thousand leaves at a time, so that few links are there twice.
  constexpr std::size_t batch = 8192;
  constexpr std::size_t chunk = 64;
  std::vector<Id> fresh;
  std::vector<std::uint32_t> section;
  std::array<std::vector<CrossingLink>, batch / chunk> flown;
  const auto fly_batch = [&] {
    for_ranges((fresh.size() + chunk - 1) / chunk, 1, [&](std::size_t a, std::size_t b) {
      std::vector<CrossingLink> links;
      for (std::size_t c = a; c < b; ++c) {
        flown[c].clear();
        if (!go_on()) continue;
        for (std::size_t k = c * chunk; k < std::min(fresh.size(), (c + 1) * chunk); ++k) {
          fly_leaf(fresh[k], section[k], parts, options, links);
          place_[slot(fresh[k])].count = static_cast<std::uint16_t>(links.size());
          flown[c].insert(flown[c].end(), links.begin(), links.end());
        }
      }
    });
    std::size_t taken = 0;
    for (std::size_t k = 0; k < fresh.size(); ++k) {
      const std::vector<CrossingLink>& from = flown[k / chunk];
      if (k % chunk == 0) taken = 0;
      LinkStore::Place& place = place_[slot(fresh[k])];
      const std::size_t count = place.count;
      place = links_.add({from.data() + taken, count});
      taken += count;
    }
    fresh.clear();
    section.clear();
  };
  for (std::size_t s = 0; s < sections(); ++s) {
    for (Id id = first_[s]; id < first_[s + 1]; ++id) {
      if (leaf_[id].state != LeafState::fresh) continue;
      fresh.push_back(id);
      section.push_back(static_cast<std::uint32_t>(s));
      if (fresh.size() == batch) fly_batch();
    }
  }
  fly_batch();
}

void CrossingGraph::forget_links() {
  place_ = {};
  links_ = {};
}

/// Those of leaves that are kept: before the leaves themselves are cut.
void CrossingGraph::cut_places(const std::vector<bool>& which) {
  const auto is_in = [&](Id id) {
    const LeafState state = leaf_[id].state;
    return which[id] || (state != LeafState::closed && state != LeafState::idle);
  };
  Slots slots;
  for (Id id = 0; id < leaf_.size(); ++id) {
    slots.add(is_in(id));
    if (which[id]) slots.add(true);
  }
  std::vector<LinkStore::Place> place;
  place.reserve(slots.count());
  for (Id id = 0; id < leaf_.size(); ++id) {
    if (!is_in(id)) continue;
    const bool kept = leaf_[id].state == LeafState::open && !which[id];
    place.push_back(kept ? place_[slot(id)] : LinkStore::Place{});
    if (which[id]) place.emplace_back();
  }
  slots_ = std::move(slots);
  place_ = std::move(place);
  links_.keep(place_);
}

void CrossingGraph::cut(const std::vector<bool>& which) {
  const auto old_count = static_cast<Id>(leaf_.size());
  const auto more = std::count(which.begin(), which.end(), true);
  require(old_count + static_cast<std::size_t>(more) < ~Id{0}, "a plan has fewer than 2^32 leaves");
  cut_places(which);
  // From the last one on, each moves to its place, where none is that has not moved yet.
  leaf_.resize(old_count + static_cast<std::size_t>(more));
  Id to = static_cast<Id>(leaf_.size());
  Id end = old_count;
  first_.back() = to;
  for (std::size_t s = sections(); s-- > 0;) {
    const Id begin = first_[s];
    std::uint32_t until = side_units;
    for (Id id = end; id-- > begin;) {
      const Leaf old = leaf_[id];
      if (which[id]) {
        leaf_[--to] = {.begin = old.begin + (until - old.begin) / 2};
        leaf_[--to] = {.begin = old.begin};
      } else {
        leaf_[--to] = old;
      }
      until = old.begin;
    }
    end = begin;
    first_[s] = to;
  }
}

}  // namespace fairway
