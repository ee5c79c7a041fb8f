#include "fairway/verify/prover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

double width_of(UnitRange range) {
  return static_cast<double>(range.hi) - static_cast<double>(range.lo);
}
bool overlap(UnitRange a, UnitRange b) { return a.lo <= b.hi && b.lo <= a.hi; }

}  // namespace

Prover::Prover(const Flow& flow, const SectionVerdicts& start, int most_crossings,
               std::function<bool()> go_on)
    : flow_(flow),
      most_crossings_(most_crossings),
      go_on_(std::move(go_on)),
      on_section_(start.first.size() - 1),
      dependents_(start.first.size() - 1) {
  leaf_.reserve(start.leaves());
  std::vector<Id> open;
  for (std::size_t s = 0; s + 1 < start.first.size(); ++s) {
    for (std::size_t i = start.first[s]; i < start.first[s + 1]; ++i) {
      Leaf leaf;
      leaf.place = {static_cast<std::uint32_t>(s), start.range_of(s, i)};
      leaf.rank = start.rank[i];
      leaf.time_s = start.time_s[i];
      leaf.verdict = static_cast<Verdict>(start.verdict[i]);
      rank_ = std::max(rank_, leaf.rank);
      const Id id = static_cast<Id>(leaf_.size());
      on_section_[s].push_back(id);
      if (leaf.verdict == Verdict::undecided) open.push_back(id);
      leaf_.push_back(leaf);
    }
  }
  leaf_count_ = leaf_.size();
  is_awake_.assign(leaf_.size(), 0);
  fly(open);
}

std::span<const ImagePiece> Prover::pieces_of(const Leaf& leaf) const {
  return std::span(piece_).subspan(leaf.first_piece, leaf.pieces);
}

template <typename Body>
void Prover::for_leaves(std::size_t section, UnitRange range, const Body& body) const {
  const std::vector<Id>& ids = on_section_[section];
  auto at = std::lower_bound(ids.begin(), ids.end(), range.lo, [&](Id id, std::uint32_t lo) {
    return leaf_[id].place.range.hi < lo;
  });
  for (; at != ids.end() && leaf_[*at].place.range.lo <= range.hi; ++at) body(*at);
}

void Prover::look_up(std::size_t section, UnitRange range, double flown_s,
                     VerdictSet& found) const {
  if (on_section_[section].empty()) found.add(Verdict::undecided, 0.0);
  for_leaves(section, range, [&](Id id) {
    found.add(leaf_[id].verdict, above(flown_s + static_cast<double>(leaf_[id].time_s)));
  });
}

/// Images for leaves that have none yet; they wake.
void Prover::fly(const std::vector<Id>& ids) {
  std::vector<LeafPlace> places(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) places[i] = leaf_[ids[i]].place;
  const ImageStore images = leaf_images(flow_, places, most_crossings_, go_on_);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Leaf& leaf = leaf_[ids[i]];
    const Image image = images[i];
    leaf.flown = true;
    leaf.gave_up = image.gave_up;
    leaf.ends = image.ends;
    leaf.first_piece = piece_.size();
    leaf.pieces = static_cast<std::uint32_t>(image.pieces.size());
    for (const ImagePiece& piece : image.pieces) {
      piece_.push_back(piece);
      dependents_[piece.section].push_back({ids[i], piece.range});
    }
    wake(ids[i]);
  }
}

/// A weave that moves every state of the leaf one way along the border leaves the leaf after
/// finitely many hops, at that end: its hop may touch the leaf itself. Whatever else a state does,
/// it may have done all those hops before: the bound of the time counts them with everything.
VerdictSet Prover::verdicts_of(Id id) const {
  const Leaf& leaf = leaf_[id];
  VerdictSet found = leaf.ends;
  if (leaf.gave_up) found.add(Verdict::undecided, 0.0);
  double hops_s = 0.0;
  for (const ImagePiece& piece : pieces_of(leaf)) {
    const auto flown_s = static_cast<double>(piece.flown_s);
    const double move = piece.hop && piece.section == leaf.place.section
                            ? least_move(piece, leaf.place.range)
                            : 0.0;
    if (on_section_[piece.section].empty()) found.add(Verdict::undecided, 0.0);
    for_leaves(piece.section, piece.range, [&](Id other) {
      if (other == id && move > 0.0) {
        const double hops = std::floor(width_of(leaf.place.range) / move);
        hops_s = std::max(hops_s, above(hops * flown_s));
        return;
      }
      found.add(leaf_[other].verdict, above(flown_s + static_cast<double>(leaf_[other].time_s)));
    });
  }
  found.time_s = above(found.time_s + hops_s);
  return found;
}

bool Prover::is_worth_cutting(const Leaf& leaf, Id id) const {
  if (leaf.gave_up || leaf.ends.bits != 0) return true;
  for (const ImagePiece& piece : pieces_of(leaf)) {
    bool worth = false;
    const bool moves_on = piece.hop && piece.section == leaf.place.section &&
                          least_move(piece, leaf.place.range) > 0.0;
    for_leaves(piece.section, piece.range, [&](Id other) {
      worth = worth || (other == id && !moves_on) || leaf_[other].verdict != Verdict::undecided;
    });
    if (worth) return true;
  }
  return false;
}

Prover::Finding Prover::examine(Id id, double least_units) const {
  Finding finding{verdicts_of(id)};
  const Leaf& leaf = leaf_[id];
  // What cannot be told keeps all that leads there waiting: it is cut finer, ahead of the rest.
  constexpr double ahead = 1.0 / 64.0;
  const double least = leaf.gave_up ? std::max(ahead * least_units, 64.0) : least_units;
  finding.cut = finding.found.only() == Verdict::undecided &&
                width_of(leaf.place.range) >= 2.0 * least && is_worth_cutting(leaf, id);
  return finding;
}

void Prover::wake(Id id) {
  if (is_awake_[id] != 0 || leaf_[id].verdict != Verdict::undecided || leaf_[id].cut) return;
  is_awake_[id] = 1;
  awake_.push_back(id);
}

void Prover::wake_dependents(const Leaf& leaf) {
  std::vector<Dependent>& all = dependents_[leaf.place.section];
  std::erase_if(all, [&](const Dependent& d) {
    return leaf_[d.leaf].cut || leaf_[d.leaf].verdict != Verdict::undecided;
  });
  for (const Dependent& d : all) {
    if (overlap(d.range, leaf.place.range)) wake(d.leaf);
  }
}

void Prover::cut(Id id, std::vector<Id>& halves) {
  const LeafPlace place = leaf_[id].place;
  const auto half = static_cast<std::uint32_t>(std::ceil(0.5 * width_of(place.range)));
  const std::uint32_t middle = place.range.lo + half;
  const auto low = static_cast<Id>(leaf_.size());
  leaf_[id].cut = true;
  Leaf part;
  part.place = {place.section, {place.range.lo, middle}};
  leaf_.push_back(part);
  part.place.range = {middle, place.range.hi};
  leaf_.push_back(part);
  is_awake_.resize(leaf_.size(), 0);
  std::vector<Id>& ids = on_section_[place.section];
  const auto at = std::find(ids.begin(), ids.end(), id);
  *at = low;
  ids.insert(at + 1, low + 1);
  ++leaf_count_;
  halves.push_back(low);
  halves.push_back(low + 1);
}

bool Prover::settle(double least_units) {
  for (Id id = 0; id < leaf_.size(); ++id) wake(id);
  std::vector<Finding> findings;
  std::vector<Id> halves;
  do {
    while (!awake_.empty()) {
      if (!go_on_()) return false;
      const std::vector<Id> round = std::exchange(awake_, {});
      findings.assign(round.size(), {});
      const auto look = [&](std::size_t a, std::size_t b) {
        for (std::size_t k = a; k < b; ++k) findings[k] = examine(round[k], least_units);
      };
      if (round.size() < 256) {
        look(0, round.size());
      } else {
        for_ranges(round.size(), 64, look);
      }
      ++rank_;
      for (const Id id : round) is_awake_[id] = 0;
      halves.clear();
      for (std::size_t k = 0; k < round.size(); ++k) {
        const Verdict verdict = findings[k].found.only();
        Leaf& leaf = leaf_[round[k]];
        if (findings[k].cut) {
          cut(round[k], halves);
        } else if (verdict != Verdict::undecided && verdict != Verdict::trapped) {
          leaf.verdict = verdict;
          leaf.rank = rank_;
          leaf.time_s = std::nextafter(static_cast<float>(findings[k].found.time_s), infinite);
        }
      }
      for (const Id id : round) {
        if (leaf_[id].verdict != Verdict::undecided) wake_dependents(leaf_[id]);
      }
      fly(halves);
    }
    prove_trapped();
  } while (!awake_.empty());
  return true;
}

/// All that is undecided, less what may get out. What is left wakes those that lead there.
void Prover::prove_trapped() {
  std::vector<Id> work;
  for (Id id = 0; id < leaf_.size(); ++id) {
    Leaf& leaf = leaf_[id];
    if (leaf.verdict != Verdict::undecided || leaf.cut) continue;
    leaf.verdict = Verdict::trapped;  // until something speaks against it
    work.push_back(id);
  }
  const std::vector<Id> suspects = work;
  std::vector<std::uint8_t> queued(leaf_.size(), 0);
  for (const Id id : work) queued[id] = 1;
  while (!work.empty()) {
    const Id id = work.back();
    work.pop_back();
    queued[id] = 0;
    Leaf& leaf = leaf_[id];
    if (leaf.verdict != Verdict::trapped || verdicts_of(id).only() == Verdict::trapped) continue;
    leaf.verdict = Verdict::undecided;
    for (const Dependent& d : dependents_[leaf.place.section]) {
      if (queued[d.leaf] != 0 || leaf_[d.leaf].cut || leaf_[d.leaf].verdict != Verdict::trapped ||
          !overlap(d.range, leaf.place.range)) {
        continue;
      }
      queued[d.leaf] = 1;
      work.push_back(d.leaf);
    }
  }
  for (const Id id : suspects) {
    Leaf& leaf = leaf_[id];
    if (leaf.verdict != Verdict::trapped) continue;
    leaf.rank = 0;
    leaf.time_s = infinite;
  }
  for (const Id id : suspects) {
    if (leaf_[id].verdict == Verdict::trapped) wake_dependents(leaf_[id]);
  }
}

SectionVerdicts Prover::sections() const {
  SectionVerdicts out;
  out.first.reserve(on_section_.size() + 1);
  out.first.push_back(0);
  for (const std::vector<Id>& ids : on_section_) {
    for (const Id id : ids) {
      const Leaf& leaf = leaf_[id];
      out.begin.push_back(leaf.place.range.lo);
      out.rank.push_back(leaf.rank);
      out.verdict.push_back(static_cast<std::uint8_t>(leaf.verdict));
      out.time_s.push_back(leaf.time_s);
    }
    out.first.push_back(static_cast<std::uint32_t>(out.begin.size()));
  }
  return out;
}

std::size_t Prover::undecided() const {
  std::size_t count = 0;
  for (const Leaf& leaf : leaf_) count += !leaf.cut && leaf.verdict == Verdict::undecided;
  return count;
}

std::size_t Prover::bytes() const {
  std::size_t total = leaf_.capacity() * sizeof(Leaf) + piece_.capacity() * sizeof(ImagePiece) +
                      is_awake_.capacity();
  for (const auto& ids : on_section_)
    total += sizeof(std::vector<Id>) + ids.capacity() * sizeof(Id);
  for (const auto& all : dependents_)
    total += sizeof(std::vector<Dependent>) + all.capacity() * sizeof(Dependent);
  return total;
}

bool Prover::can_refine(double least_units) const {
  return std::any_of(leaf_.begin(), leaf_.end(), [&](const Leaf& leaf) {
    return !leaf.cut && leaf.verdict == Verdict::undecided &&
           width_of(leaf.place.range) >= 2.0 * least_units;
  });
}

}  // namespace fairway
