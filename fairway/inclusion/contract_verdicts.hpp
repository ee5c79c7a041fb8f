// The product of a proof under a vehicle contract: a verdict for every leaf of every section.
//
// A section is the side of a part: all behaviours that leave the part over it aligned with the
// part; a leaf is a range of its places. Sections are numbered 4 part + PartSide. Leaves belong to
// groups, which are numbered from the ends backwards.
//
// Properties that always hold:
//   1. A section has leaves exactly when its part is ordinary. They cover it: they start from 0, in
//      ascending order.
//   2. All ends in the image of a leaf with verdict reach, collide or leave have that verdict; all
//      its crossings lie in leaves of that verdict, whose groups have no higher number.
//   3. When a crossing lies in the group itself, all headings on the way there lie within
//      `most_off_progress_rad` of group_heading_rad: the behaviour moves on along that heading, and
//      so it leaves the group.
//   4. A leaf with verdict trapped has no end; all its crossings lie in leaves with verdict
//   trapped.
//   5. No behaviour from a leaf of a group takes longer than group_time_s.
//   6. Where a group has a next mode, properties 2 and 3 are not claimed of its leaves: they are
//      handed over. All states within twice the error of the vehicle's estimate of such a leaf are
//      proved to reach under that mode, within group_time_s (contract_hand_over.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/heading.hpp"

namespace fairway {

inline constexpr double most_off_progress_rad = 0.5 * pi - 2e-3;

struct ContractVerdicts {
  std::vector<std::uint32_t> first;      ///< [4 parts + 1]
  std::vector<std::uint32_t> begin;      ///< [leaves], units of a side / 2^32, from its right end
  std::vector<std::uint32_t> group;      ///< [leaves]; 0 when undecided or trapped
  std::vector<std::uint8_t> verdict;     ///< [leaves], Verdict
  std::vector<float> group_heading_rad;  ///< [groups]; NaN: no behaviour comes back to the group
  std::vector<float> group_time_s;       ///< [groups]; +inf for group 0
  /// [groups], the earlier mode that the vehicle changes to, or no_mode; empty: all no_mode.
  std::vector<std::uint8_t> group_next_mode;

  std::size_t leaves() const { return begin.size(); }
};

/// What a query needs of them, wherever it lies.
struct ContractVerdictsView {
  std::span<const std::uint32_t> first;
  std::span<const std::uint32_t> begin;
  std::span<const std::uint32_t> group;
  std::span<const std::uint8_t> verdict;
  std::span<const float> group_time_s;
  std::span<const std::uint8_t> group_next_mode;

  ContractVerdictsView() = default;
  ContractVerdictsView(const ContractVerdicts& v)  // NOLINT: a view of the same
      : first(v.first),
        begin(v.begin),
        group(v.group),
        verdict(v.verdict),
        group_time_s(v.group_time_s),
        group_next_mode(v.group_next_mode) {}
};

/// Calls body(leaf) for the leaves of a section that the range [lo, hi] of places touches, 0 to 1:
/// the last that begins at `lo` or before, and those that begin before `hi`.
template <typename Body>
void for_leaves(const ContractVerdictsView& verdicts, std::size_t section, double lo, double hi,
                const Body& body) {
  constexpr double units = 0x1p32;
  const auto first = verdicts.begin.begin() + verdicts.first[section];
  const auto last = verdicts.begin.begin() + verdicts.first[section + 1];
  auto at = std::upper_bound(first, last, lo * units,
                             [](double place, std::uint32_t begin) { return place < begin; });
  if (at != first) --at;
  for (bool next = true; at != last && next; ++at) {
    next = at + 1 != last && at[1] < hi * units;
    body(static_cast<std::size_t>(at - verdicts.begin.begin()));
  }
}

/// Of further modes joined (contract_modes.hpp), of `sections` sections each, those of one: 1 or
/// more.
inline ContractVerdictsView mode_of_joined(const ContractVerdicts& joined, std::size_t sections,
                                           int mode) {
  ContractVerdictsView of = joined;
  of.first = of.first.subspan(sections * static_cast<std::size_t>(mode - 1), sections + 1);
  return of;
}

}  // namespace fairway
