// A contract certificate as its file claims it to be (docs/formats.md, "Contract certificate").
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/contract_parts.hpp"
#include "check/follow_claims.hpp"
#include "check/plan_arrays.hpp"

namespace fairway_check {

/// In group_next: the leaves are not handed over.
inline constexpr std::uint8_t not_handed_over = 0xff;

/// Of a further mode: the same with its commands; what is not of a mode is empty.
struct ContractCertificate {
  std::size_t mode = 0;
  Geometry geometry{};
  Loop loop;                             ///< without radius and directions
  std::vector<std::int8_t> region;       ///< [iy][ix]
  std::vector<std::uint8_t> holding;     ///< [iy][ix], where trapped is called hold; or empty
  std::vector<std::uint32_t> first;      ///< [4 parts + 1]: of section 4 part + side
  std::vector<std::uint32_t> begin;      ///< [leaves]
  std::vector<std::uint32_t> group;      ///< [leaves]
  std::vector<std::uint8_t> verdict;     ///< [leaves], Verdict
  std::vector<float> group_heading_rad;  ///< [groups], of progress; NaN: no links inside
  std::vector<float> group_time_s;       ///< [groups]
  std::vector<std::uint8_t> group_next;  ///< [groups], the earlier mode that takes over; or empty
  std::vector<ContractCertificate> further;  ///< modes after the plan's own
  std::optional<FollowClaims> follow;        ///< then verdict reach is: joins the core, and follows
  nlohmann::json record;
  Contract contract{};
  Parts parts;

  /// Where a leaf starts and ends along its side, from 0 to 1.
  double begin_of(std::size_t leaf) const { return begin[leaf] * 0x1p-32; }
  double end_of(std::size_t section, std::size_t leaf) const {
    return leaf + 1 < first[section + 1] ? begin[leaf + 1] * 0x1p-32 : 1.0;
  }
  bool hands_over(std::size_t leaf) const {
    return !group_next.empty() && group_next[group[leaf]] != not_handed_over;
  }
  const ContractCertificate& of_mode(std::size_t number) const {
    return number == 0 ? *this : further[number - 1];
  }
  /// "leaf 3 (0 on side 2 of part (4, 5))".
  std::string name_of(std::size_t leaf) const;
  std::size_t section_of(std::size_t leaf) const;

  /// Calls visit(leaf) for those of a section that [low, high] shares more than an end with; for
  /// all that meet at a single place.
  template <typename Visit>
  void for_leaves(std::size_t section, double low, double high, Visit visit) const {
    const auto from = begin.begin() + first[section];
    const auto to = begin.begin() + first[section + 1];
    const bool single = low == high;
    auto at = std::lower_bound(from, to, low * 0x1p32);
    if (at != from && (single || at == to || *at > low * 0x1p32)) --at;
    for (; at != to && (single ? *at <= high * 0x1p32 : *at < high * 0x1p32); ++at) {
      visit(static_cast<std::size_t>(at - begin.begin()));
    }
  }
};

/// Whether the file says that it is one. Throws as below when it cannot be read.
bool is_contract_certificate(const std::string& path);

/// Reads and compares with the plan at that path, if any. Throws Defect 65 when the file is not a
/// contract certificate, Defect 1 when it is one but its digests, geometry, cells, contract, leaves
/// or groups are wrong.
ContractCertificate read_contract_certificate(const std::string& path, const std::string& plan);

}  // namespace fairway_check
