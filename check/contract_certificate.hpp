// A contract certificate as its file claims it to be (docs/formats.md, "Contract certificate").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/contract_parts.hpp"
#include "check/plan_arrays.hpp"

namespace fairway_check {

struct ContractCertificate {
  Geometry geometry{};
  Loop loop;                             ///< without radius and directions
  std::vector<std::int8_t> region;       ///< [iy][ix]
  std::vector<std::uint32_t> first;      ///< [4 parts + 1]: of section 4 part + side
  std::vector<std::uint32_t> begin;      ///< [leaves]
  std::vector<std::uint32_t> group;      ///< [leaves]
  std::vector<std::uint8_t> verdict;     ///< [leaves], Verdict
  std::vector<float> group_heading_rad;  ///< [groups], of progress; NaN: no links inside
  std::vector<float> group_time_s;       ///< [groups]
  nlohmann::json record;
  Contract contract{};
  Parts parts;

  /// Where a leaf starts and ends along its side, from 0 to 1.
  double begin_of(std::size_t leaf) const { return begin[leaf] * 0x1p-32; }
  double end_of(std::size_t section, std::size_t leaf) const {
    return leaf + 1 < first[section + 1] ? begin[leaf + 1] * 0x1p-32 : 1.0;
  }
  /// "leaf 3 (0 on side 2 of part (4, 5))".
  std::string name_of(std::size_t leaf) const;
  std::size_t section_of(std::size_t leaf) const;
};

/// Whether the file says that it is one. Throws as below when it cannot be read.
bool is_contract_certificate(const std::string& path);

/// Reads and compares with the plan at that path, if any. Throws Defect 65 when the file is not a
/// contract certificate, Defect 1 when it is one but its digests, geometry, cells, contract, leaves
/// or groups are wrong.
ContractCertificate read_contract_certificate(const std::string& path, const std::string& plan);

}  // namespace fairway_check
