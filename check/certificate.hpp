// A certificate as its file claims it to be (docs/formats.md, "Certificate").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/plan_arrays.hpp"

namespace fairway_check {

/// One mode: its commands, and what is claimed of the section that they have. Mode 0 is the plan's
/// own; from a leaf of a later one, the vehicle may go on in an earlier one.
struct Mode {
  std::size_t number = 0;
  Loop loop;
  std::vector<std::uint32_t> first;   ///< [4 cells + 1]
  std::vector<std::uint32_t> begin;   ///< [leaves]
  std::vector<std::uint32_t> rank;    ///< [leaves]
  std::vector<float> time_s;          ///< [leaves]
  std::vector<std::uint8_t> verdict;  ///< [leaves], Verdict
  std::vector<std::uint8_t> next;     ///< [leaves], the mode handed over to, or `stays`; or empty

  static constexpr std::uint8_t stays = 255;
  bool hands_over(std::size_t leaf) const { return !next.empty() && next[leaf] != stays; }

  /// Where a leaf starts and ends, in units of a side / 2^32; the last one ends at the side's end.
  double begin_of(std::size_t leaf) const { return begin[leaf]; }
  double end_of(std::size_t section, std::size_t leaf) const {
    return leaf + 1 < first[section + 1] ? begin[leaf + 1] : 0x1p32;
  }
  /// "leaf 3 on the top side of cell (4, 5)".
  std::string name_of(std::size_t leaf) const;
  std::size_t section_of(std::size_t leaf) const;
};

struct Certificate {
  Geometry geometry;
  std::vector<std::int8_t> region;    ///< [iy][ix]
  std::vector<std::uint8_t> holding;  ///< [iy][ix], where trapped is called hold; or empty
  nlohmann::json record;              ///< everything else that is claimed
  std::vector<Mode> modes;            ///< at least one

  const Loop& loop() const { return modes.front().loop; }
};

/// Reads and compares with the plan at that path, if any. Throws Defect 65 when the file is not a
/// certificate, Defect 1 when it is one but its digests, geometry, cells or leaves are wrong.
Certificate read_certificate(const std::string& path, const std::string& plan);

}  // namespace fairway_check
