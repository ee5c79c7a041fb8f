#include "fairway/verify/leaf_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr UnitRange whole_side{0, 0xffffffffU};

/// How many of the changed cells lie in a rectangle of cells, at once.
class ChangedCells {
 public:
  ChangedCells(const Grid& grid, const std::vector<bool>& changed) : grid_(grid) {
    const auto nx = static_cast<std::size_t>(grid.nx) + 1;
    sums_.assign(nx * (static_cast<std::size_t>(grid.ny) + 1), 0);
    for (std::size_t i = 0; i < changed.size(); ++i) {
      const Cell c = grid.cell_at(i);
      at(c.ix + 1, c.iy + 1) =
          at(c.ix, c.iy + 1) + at(c.ix + 1, c.iy) - at(c.ix, c.iy) + (changed[i] ? 1 : 0);
    }
  }
  bool any_within(Cell c, double reach_cells) const {
    const double far = std::max(grid_.nx, grid_.ny);
    const int reach = static_cast<int>(std::min(reach_cells, far));
    const int x0 = std::max(c.ix - reach, 0);
    const int y0 = std::max(c.iy - reach, 0);
    const int x1 = std::min(c.ix + reach + 1, grid_.nx);
    const int y1 = std::min(c.iy + reach + 1, grid_.ny);
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0) != 0;
  }

 private:
  std::uint32_t& at(int x, int y) { return sums_[place(x, y)]; }
  std::uint32_t at(int x, int y) const { return sums_[place(x, y)]; }
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * (static_cast<std::size_t>(grid_.nx) + 1) +
           static_cast<std::size_t>(x);
  }
  const Grid& grid_;
  std::vector<std::uint32_t> sums_;  // [iy][ix], of all cells lower and left
};

}  // namespace

LeafGraph::LeafGraph(const SectionVerdicts& start, Keep keep)
    : keep_(keep), roots_(start.first.size() - 1), list_(start.first.size() - 1, none) {
  leaf_.reserve(start.leaves());
  for (std::size_t s = 0; s < roots_.size(); ++s) {
    roots_[s] = {ids(), start.first[s + 1] - start.first[s]};
    for (std::size_t i = start.first[s]; i < start.first[s + 1]; ++i) {
      Leaf leaf;
      leaf.section = static_cast<std::uint32_t>(s);
      leaf.range = start.range_of(s, i);
      leaf.rank = start.rank[i];
      leaf.time_s = start.time_s[i];
      leaf.verdict = static_cast<Verdict>(start.verdict[i]);
      open_count_ += leaf.verdict == Verdict::undecided;
      leaf_.push_back(leaf);
    }
  }
  leaf_count_ = leaf_.size();
}

std::uint32_t LeafGraph::highest_rank() const {
  std::uint32_t rank = 0;
  for (const Leaf& leaf : leaf_) rank = std::max(rank, leaf.rank);
  return rank;
}

std::uint32_t LeafGraph::room_for(std::uint32_t count) {
  if (count < free_.size() && !free_[count].empty()) {
    const std::uint32_t first = free_[count].back();
    free_[count].pop_back();
    return first;
  }
  const auto first = static_cast<std::uint32_t>(link_.size());
  link_.resize(link_.size() + count);
  return first;
}

void LeafGraph::free_links(Leaf& leaf) {
  if (leaf.link_count == 0) return;
  for (std::uint32_t i = leaf.first_link; i < leaf.first_link + leaf.link_count; ++i) {
    const Link& link = link_[i];
    (link.before == none ? list_[link.section] : link_[link.before].next) = link.next;
    if (link.next != none) link_[link.next].before = link.before;
  }
  if (free_.size() <= leaf.link_count) free_.resize(leaf.link_count + 1);
  free_[leaf.link_count].push_back(leaf.first_link);
  leaf.link_count = 0;
}

void LeafGraph::set_image(Id id, const Image& image) {
  Leaf& leaf = leaf_[id];
  free_links(leaf);
  leaf.gave_up = image.gave_up;
  leaf.end_bits = image.ends.bits;
  leaf.end_time_s = image.ends.time_s;
  const auto count = static_cast<std::uint32_t>(image.pieces.size());
  leaf.first_link = room_for(count);
  leaf.link_count = count;
  for (std::uint32_t k = 0; k < count; ++k) {
    const ImagePiece& piece = image.pieces[k];
    const bool own = piece.hop && piece.section == leaf.section;
    Link& link = link_[leaf.first_link + k];
    link.section = piece.section;
    link.range = piece.range;
    link.flown_s = piece.flown_s;
    link.from = id;
    link.own_move = own ? static_cast<std::uint32_t>(least_move(piece, leaf.range)) : 0;
    link.next = list_[piece.section];
    link.before = none;
    if (link.next != none) link_[link.next].before = leaf.first_link + k;
    list_[piece.section] = leaf.first_link + k;
  }
}

void LeafGraph::decide(Id id, Verdict verdict, std::uint32_t rank, float time_s) {
  Leaf& leaf = leaf_[id];
  leaf.verdict = verdict;
  leaf.rank = rank;
  leaf.time_s = time_s;
  --open_count_;
  if (keep_ == Keep::links_of_open_leaves) free_links(leaf);
}

LeafGraph::Id LeafGraph::cut(Id id) {
  const UnitRange range = leaf_[id].range;
  const auto half = static_cast<std::uint32_t>(std::ceil(0.5 * width_of(range)));
  const std::uint32_t middle = range.lo + half;
  const Id low = ids();
  free_links(leaf_[id]);
  leaf_[id].halves = low;
  Leaf part;
  part.section = leaf_[id].section;
  part.range = {range.lo, middle};
  leaf_.push_back(part);
  part.range = {middle, range.hi};
  leaf_.push_back(part);
  ++leaf_count_;
  ++open_count_;
  return low;
}

void LeafGraph::make_undecided(Id id) {
  Leaf& leaf = leaf_[id];
  leaf.verdict = Verdict::undecided;
  leaf.rank = 0;
  leaf.time_s = 0.0F;
  ++open_count_;
}

/// Of every leaf, whether its flights may have come near a changed cell: they came no farther than
/// they are long. Those of a leaf that gave up, or that circle, have no known length.
std::vector<bool> LeafGraph::may_have_flown_through(const Flow& flow,
                                                    const std::vector<bool>& changed_cells) const {
  const ChangedCells changed(flow.grid, changed_cells);
  // From the cell left into the one beyond, the rounding of times, and the border of the last cell.
  constexpr double margin_cells = 4.0;
  const double cells_per_s = 1.001 * flow.vehicle.speed_mps / flow.grid.cell_m;
  std::vector<bool> may(leaf_.size(), false);
  for (Id id = 0; id < ids(); ++id) {
    const Leaf& leaf = leaf_[id];
    if (leaf.halves != none) continue;
    double longest_s = leaf.gave_up ? std::numeric_limits<double>::infinity() : leaf.end_time_s;
    for (const Link& link : links(id)) {
      longest_s = std::max(longest_s, static_cast<double>(link.flown_s));
    }
    may[id] = changed.any_within(flow.grid.cell_at(leaf.section / 4),
                                 longest_s * cells_per_s + margin_cells);
  }
  return may;
}

void LeafGraph::add_roots(std::size_t section, std::uint32_t count) {
  roots_[section] = {ids(), count};
  const std::uint64_t step = (std::uint64_t{1} << 32) / count;
  for (std::uint32_t k = 0; k < count; ++k) {
    Leaf leaf;
    leaf.section = static_cast<std::uint32_t>(section);
    leaf.range = {static_cast<std::uint32_t>(k * step),
                  k + 1 == count ? whole_side.hi : static_cast<std::uint32_t>((k + 1) * step)};
    leaf_.push_back(leaf);
  }
  leaf_count_ += count;
  open_count_ += count;
}

std::vector<LeafGraph::Id> LeafGraph::invalidate(const Flow& flow,
                                                 const std::vector<bool>& changed_cells) {
  require(keep_ == Keep::all_links, "a graph that is to be invalidated keeps all links");
  require(changed_cells.size() == flow.grid.size(), "a flag for every cell");
  const std::vector<bool> stale = may_have_flown_through(flow, changed_cells);
  std::vector<Id> work;  // undecided since, and what depends on them not yet
  for (Id id = 0; id < stale.size(); ++id) {
    Leaf& leaf = leaf_[id];
    if (!stale[id]) continue;
    if (leaf.verdict != Verdict::undecided) make_undecided(id);
    free_links(leaf);
    leaf.end_bits = 0;
    leaf.end_time_s = 0.0;
    leaf.gave_up = true;  // until it has an image
    work.push_back(id);
  }
  std::vector<Id> to_fly;
  constexpr std::uint32_t new_roots = 4;
  for (std::size_t s = 0; s < roots_.size(); ++s) {
    const bool there = is_section(flow, s);
    if (there && roots_[s].count == 0) {
      add_roots(s, new_roots);
    } else if (!there &&
               roots_[s].count > 0) {  // its leaves are stale: a changed cell is beside it
      for_leaves(s, whole_side, [&](Id id) {
        leaf_[id].halves = id;  // no leaf any more
        --leaf_count_;
        --open_count_;
      });
      roots_[s].count = 0;
    }
  }
  for (Id id = 0; id < ids(); ++id) {
    if (is_open(id) && (id >= stale.size() || stale[id])) to_fly.push_back(id);
  }
  while (!work.empty()) {
    const Leaf leaf = leaf_[work.back()];
    work.pop_back();
    for_dependents(leaf.section, leaf.range, [&](Id other) {
      if (leaf_[other].verdict == Verdict::undecided) return;
      make_undecided(other);
      work.push_back(other);
    });
  }
  return to_fly;
}

SectionVerdicts LeafGraph::sections() const {
  SectionVerdicts out;
  out.first.reserve(roots_.size() + 1);
  out.first.push_back(0);
  for (std::size_t s = 0; s < roots_.size(); ++s) {
    for_leaves(s, whole_side, [&](Id id) {
      const Leaf& leaf = leaf_[id];
      out.begin.push_back(leaf.range.lo);
      out.rank.push_back(leaf.rank);
      out.verdict.push_back(static_cast<std::uint8_t>(leaf.verdict));
      out.time_s.push_back(leaf.time_s);
    });
    out.first.push_back(static_cast<std::uint32_t>(out.begin.size()));
  }
  return out;
}

std::size_t LeafGraph::bytes() const {
  std::size_t total = leaf_.capacity() * sizeof(Leaf) + roots_.capacity() * sizeof(Roots) +
                      link_.capacity() * sizeof(Link) + list_.capacity() * sizeof(std::uint32_t);
  for (const auto& unused : free_) total += unused.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace fairway
