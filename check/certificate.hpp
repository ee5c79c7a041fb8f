// A certificate as its file claims it to be (docs/formats.md, "Certificate").
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "check/flight.hpp"

namespace fairway_check {

/// Shares of the volume by verdict.
using Shares = std::array<double, verdict_count>;
/// Of all ordinary cells, of those for safe starts, of the others.
enum Portion { all_cells, free_cells, buffer_cells };
using PortionShares = std::array<Shares, 3>;
inline constexpr const char* portion_name[3]{"volume_fraction", "volume_fraction_free",
                                             "volume_fraction_buffer"};

struct Certificate {
  std::vector<double> geometry;       ///< x0, y0, cell_m, turn_radius_m, speed_mps, units
  std::vector<std::int8_t> region;    ///< [iy][ix]
  std::vector<std::uint32_t> first;   ///< [4 cells + 1]
  std::vector<std::uint32_t> begin;   ///< [leaves]
  std::vector<std::uint32_t> rank;    ///< [leaves]
  std::vector<float> time_s;          ///< [leaves]
  std::vector<std::uint8_t> verdict;  ///< [leaves], Verdict
  PortionShares shares{};             ///< as claimed; 0 of no cells
  double samples = 0.0;
  double worst_time_s = 0.0;
  Loop loop;

  /// Where a leaf begins and ends, in units of a side / 2^32; the last one at the side's end.
  double begin_of(std::size_t leaf) const { return begin[leaf]; }
  double end_of(std::size_t section, std::size_t leaf) const {
    return leaf + 1 < first[section + 1] ? begin[leaf + 1] : 0x1p32;
  }
  /// "leaf 3 on the top side of cell (4, 5)".
  std::string name_of(std::size_t leaf) const;
  std::size_t section_of(std::size_t leaf) const;
};

/// Reads and compares with the plan of that path, if any. Throws Defect 65 when the file is no
/// certificate, Defect 1 when it is one and its digests, geometry, cells or leaves are wrong.
void read_certificate(const std::string& path, const std::string& plan, Certificate& certificate);

}  // namespace fairway_check
