#include "fairway/certificate/contract_mode_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file_parts.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {
namespace {

constexpr std::size_t mode_arrays = 8;

std::vector<std::uint64_t> leaves_of(const ContractVerdicts& m) { return {m.leaves()}; }
std::vector<std::uint64_t> groups_of(const ContractVerdicts& m) { return {m.group_time_s.size()}; }

/// Leaves of one mode that are out of range, if any; groups of other modes are.
bool mode_fits(const ContractVerdicts& m, std::size_t first, std::size_t last, std::size_t mode) {
  for (std::size_t leaf = first; leaf < last; ++leaf) {
    const bool reaches = m.verdict[leaf] == static_cast<std::uint8_t>(Verdict::reach);
    const std::uint32_t group = m.group[leaf];
    if (m.verdict[leaf] > static_cast<std::uint8_t>(Verdict::reach) ||
        group >= m.group_time_s.size() || reaches != (group > 0)) {
      return false;
    }
    const std::uint8_t next = m.group_next_mode[group];
    if (next != no_mode && next >= mode) return false;
  }
  return true;
}

}  // namespace

void add_wide_mode_tensors(const ContractCertificate& c, std::vector<Tensor>& tensors) {
  if (c.further_modes() == 0) return;
  const ContractVerdicts& m = c.mode_verdicts;
  const std::vector<std::uint64_t> fields{static_cast<std::uint64_t>(c.further_modes()),
                                          static_cast<std::uint64_t>(c.grid.ny),
                                          static_cast<std::uint64_t>(c.grid.nx)};
  tensors.insert(tensors.end(),
                 {{"mode_heading_rad", "F32", fields, bytes_of(c.mode_heading_rad)},
                  {"mode_section_first", "U32", {m.first.size()}, bytes_of(m.first)},
                  {"mode_leaf_begin", "U32", leaves_of(m), bytes_of(m.begin)},
                  {"mode_leaf_group", "U32", leaves_of(m), bytes_of(m.group)},
                  {"mode_group_heading_rad", "F32", groups_of(m), bytes_of(m.group_heading_rad)},
                  {"mode_group_time_s", "F32", groups_of(m), bytes_of(m.group_time_s)}});
}

void add_mode_bytes(const ContractCertificate& c, std::vector<Tensor>& tensors) {
  if (c.further_modes() == 0) return;
  const ContractVerdicts& m = c.mode_verdicts;
  tensors.push_back({"mode_leaf_verdict", "U8", leaves_of(m), bytes_of(m.verdict)});
  tensors.push_back({"mode_group_next", "U8", groups_of(m), bytes_of(m.group_next_mode)});
}

std::size_t take_contract_modes(const Safetensors& file, const std::string& where,
                                ContractCertificate& c) {
  const auto is_it = [](const Tensor& tensor) { return tensor.name == "mode_heading_rad"; };
  if (std::none_of(file.tensors.begin(), file.tensors.end(), is_it)) return 0;
  const auto nx = static_cast<std::uint64_t>(c.grid.nx);
  const auto ny = static_cast<std::uint64_t>(c.grid.ny);
  c.mode_heading_rad = array_of<float>(file, "mode_heading_rad", "F32", {0, ny, nx}, where);
  const auto modes = static_cast<std::size_t>(c.further_modes());
  const std::size_t sections = c.verdicts.first.size() - 1;
  ContractVerdicts& m = c.mode_verdicts;
  m.first =
      array_of<std::uint32_t>(file, "mode_section_first", "U32", {modes * sections + 1}, where);
  m.begin = array_of<std::uint32_t>(file, "mode_leaf_begin", "U32", {0}, where);
  m.group = array_of<std::uint32_t>(file, "mode_leaf_group", "U32", leaves_of(m), where);
  m.verdict = array_of<std::uint8_t>(file, "mode_leaf_verdict", "U8", leaves_of(m), where);
  m.group_time_s = array_of<float>(file, "mode_group_time_s", "F32", {0}, where);
  m.group_heading_rad = array_of<float>(file, "mode_group_heading_rad", "F32", groups_of(m), where);
  m.group_next_mode = array_of<std::uint8_t>(file, "mode_group_next", "U8", groups_of(m), where);
  bool fits = modes >= 1 && modes < most_modes && leaves_are_in_order(m.first, m.begin) &&
              !m.group_time_s.empty();
  for (std::size_t g = 0; fits && g < m.group_time_s.size(); ++g) {
    fits = m.group_time_s[g] >= 0.0F && !std::isinf(m.group_heading_rad[g]);
  }
  for (std::size_t mode = 1; fits && mode <= modes; ++mode) {
    fits = mode_fits(m, m.first[sections * (mode - 1)], m.first[sections * mode], mode);
  }
  if (!fits) {
    throw InputError(where, "has leaves of further modes that are out of order or out of range");
  }
  return mode_arrays;
}

}  // namespace fairway
