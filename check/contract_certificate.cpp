#include "check/contract_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "check/followed_mission.hpp"
#include "check/leaf_findings.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

constexpr const char* contract_format = "fairway-contract-certificate";
constexpr const char* modes_name = "mode_heading_rad";
/// A byte names a mode, and a plan has no more than 64.
constexpr std::uint64_t most_further_modes = 63;

/// An arc that nearly is too wide to hold its headings may have been called wild, by the slack that
/// the certificate's author allows for: its part may have no leaves, which claims nothing.
double almost_wild(const Contract& contract) {
  return std::min(std::numbers::pi - contract.side_uncertain, 2.0 * contract.hold_side) - 0.02;
}

void take_arrays(const TensorFile& file, ContractCertificate& c) {
  const bool follows = file.record.contains("follow");
  const std::size_t holding = file.tensors.contains("holding") ? 1 : 0;
  const std::size_t of_modes = !follows && file.tensors.contains(modes_name) ? 8 : 0;
  require(file.tensors.size() == (follows ? 17U : 10U) + holding + of_modes,
          "does not have the arrays of a contract certificate", unreadable);
  take_plan_arrays(file, c.geometry, c.loop, c.region);
  c.holding = holding_of(file, c.region);
  const nlohmann::json& k = file.record.at("parts_per_cell");
  require(k.is_number_unsigned() && k >= 1U && k <= 16U, "parts_per_cell: expected 1 to 16");
  c.parts.per_cell = k.get<int>();
  const std::uint64_t parts =
      c.loop.kind.size() * static_cast<std::uint64_t>(c.parts.per_cell * c.parts.per_cell);
  require(parts < 1U << 29, "parts_per_cell: makes too many parts");
  c.first = values<std::uint32_t>(file, "section_first", "U32", {4 * parts + 1});
  const std::vector<std::uint64_t> leaves{c.first.back()};
  c.begin = values<std::uint32_t>(file, "leaf_begin", "U32", leaves);
  c.group = values<std::uint32_t>(file, "leaf_group", "U32", leaves);
  c.verdict = values<std::uint8_t>(file, "leaf_verdict", "U8", leaves);
  require(file.tensors.contains("group_time_s"), "group_time_s: is missing", unreadable);
  const std::vector<std::uint64_t> groups = file.tensors.at("group_time_s").shape;
  require(groups.size() == 1 && groups[0] >= 1, "group_time_s: is not a list", unreadable);
  c.group_time_s = values<float>(file, "group_time_s", "F32", groups);
  c.group_heading_rad = values<float>(file, "group_heading_rad", "F32", groups);
  if (follows) c.follow = follow_claims_of(file, c.first.back());
}

template <typename T>
std::vector<T> part_of(const std::vector<T>& all, std::size_t from, std::size_t to) {
  return {all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(to)};
}

/// The modes after the plan's own: their arrays are one after another in the same ones, and their
/// groups in one table.
void take_further_modes(const TensorFile& file, ContractCertificate& c) {
  const auto found = file.tensors.find(modes_name);
  if (found == file.tensors.end()) return;
  const std::vector<std::uint64_t>& shape = found->second.shape;
  require(shape.size() == 3 && shape[0] >= 1 && shape[0] <= most_further_modes,
          "mode_heading_rad: is not a list of fields", unreadable);
  const std::uint64_t modes = shape[0];
  const std::uint64_t cells = c.loop.kind.size();
  const auto commands = values<float>(
      file, modes_name, "F32",
      {modes, static_cast<std::uint64_t>(c.loop.ny), static_cast<std::uint64_t>(c.loop.nx)});
  const std::size_t sections = c.first.size() - 1;
  const auto first =
      values<std::uint32_t>(file, "mode_section_first", "U32", {modes * sections + 1});
  require(first.front() == 0 && std::is_sorted(first.begin(), first.end()),
          "mode_section_first: does not ascend from 0");
  const std::vector<std::uint64_t> leaves{first.back()};
  const auto begin = values<std::uint32_t>(file, "mode_leaf_begin", "U32", leaves);
  const auto group = values<std::uint32_t>(file, "mode_leaf_group", "U32", leaves);
  const auto verdict = values<std::uint8_t>(file, "mode_leaf_verdict", "U8", leaves);
  require(file.tensors.contains("mode_group_time_s"), "mode_group_time_s: is missing", unreadable);
  const std::vector<std::uint64_t> groups = file.tensors.at("mode_group_time_s").shape;
  require(groups.size() == 1 && groups[0] >= 1, "mode_group_time_s: is not a list", unreadable);
  for (std::size_t k = 1; k <= modes; ++k) {
    ContractCertificate& m = c.further.emplace_back();
    m.mode = k;
    m.geometry = c.geometry;
    m.loop.nx = c.loop.nx;
    m.loop.ny = c.loop.ny;
    m.loop.kind = c.loop.kind;
    m.loop.command_rad = part_of(commands, (k - 1) * cells, k * cells);
    m.first = part_of(first, sections * (k - 1), sections * k + 1);
    const std::size_t from = m.first.front();
    const std::size_t to = m.first.back();
    for (std::uint32_t& one : m.first) one -= static_cast<std::uint32_t>(from);
    m.begin = part_of(begin, from, to);
    m.group = part_of(group, from, to);
    m.verdict = part_of(verdict, from, to);
    m.group_time_s = values<float>(file, "mode_group_time_s", "F32", groups);
    m.group_heading_rad = values<float>(file, "mode_group_heading_rad", "F32", groups);
    m.group_next = values<std::uint8_t>(file, "mode_group_next", "U8", groups);
  }
}

/// That the commands are those of all further modes of the plan that the file names.
void require_modes_are_the_plans(const TensorFile& file) {
  if (!file.tensors.contains(modes_name)) return;  // further modes may be left unproved
  const nlohmann::json& of_plan = file.record.at("plan_sha256");
  require(of_plan.contains(modes_name) &&
              of_plan[modes_name] == file.record.at("sha256").at(modes_name),
          "mode_heading_rad is not that of the plan that it names");
}

void require_groups(const ContractCertificate& c) {
  require(std::isnan(c.group_heading_rad[0]) && c.group_time_s[0] > 0.0F &&
              std::isinf(c.group_time_s[0]),
          "group 0: expected no direction and no bound");
  for (std::size_t g = 1; g < c.group_time_s.size(); ++g) {
    const float u = c.group_heading_rad[g];
    require((std::isnan(u) || std::abs(u) <= 3.2F) && c.group_time_s[g] >= 0.0F &&
                std::isfinite(c.group_time_s[g]),
            fmt::format("group {}: has an invalid direction or time", g));
  }
}

void require_leaves(ContractCertificate& c) {
  require(c.first.front() == 0 && std::is_sorted(c.first.begin(), c.first.end()),
          "section_first: does not ascend from 0");
  for (std::size_t part = 0; part < c.parts.kind.size(); ++part) {
    Arc& arc = c.parts.arc[part];
    const bool is_ordinary = c.parts.kind[part] == ordinary && arc.width < std::numbers::pi;
    const bool has_leaves = c.first[4 * part] < c.first[4 * part + 1];
    const bool is_wild = is_ordinary && !has_leaves && arc.width > almost_wild(c.contract);
    if (is_wild) arc = {};
    // Where no way leads to a path nothing is claimed: who comes there comes to no leaf.
    const bool expected = is_ordinary && !is_wild && (has_leaves || !c.follow);
    for (std::size_t s = 4 * part; s < 4 * part + 4; ++s) {
      require((c.first[s] < c.first[s + 1]) == expected,
              "a section has leaves where it cannot have any, or none where it must");
      for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
        const bool in_order =
            leaf == c.first[s] ? c.begin[leaf] == 0 : c.begin[leaf - 1] < c.begin[leaf];
        const std::uint8_t v = c.verdict[leaf];
        const bool has_group = v == reach || v == collide || v == leave;
        // Of a further mode nothing counts but that it reaches, and it hands over to earlier ones.
        require(c.mode == 0 || v == undecided || v == reach,
                c.name_of(leaf) + ": has an invalid verdict or group");
        require(!c.follow || c.follow->stage[leaf] == 0 || v == reach,
                c.name_of(leaf) + ": is of the core, but is not claimed to follow");
        if (in_order && v < verdict_count && c.group[leaf] < c.group_time_s.size() &&
            (c.group[leaf] > 0) == has_group &&
            (!c.hands_over(leaf) || c.group_next[c.group[leaf]] < c.mode)) {
          continue;
        }
        require(false, c.name_of(leaf) + (in_order ? ": has an invalid verdict or group"
                                                   : ": leaves do not ascend from the side's "
                                                     "start"));
      }
    }
  }
}

}  // namespace

std::size_t ContractCertificate::section_of(std::size_t leaf) const {
  return section_of_leaf(first, leaf);
}

std::string ContractCertificate::name_of(std::size_t leaf) const {
  const std::size_t s = section_of(leaf);
  const Cell part = parts.part_at(s / 4);
  return fmt::format("leaf {} ({} on side {} of part ({}, {})){}", leaf, leaf - first[s], s % 4,
                     part.x, part.y, mode > 0 ? fmt::format(" of mode {}", mode) : "");
}

bool is_contract_certificate(const std::string& path) {
  const TensorFile file = read_tensors(path);
  return file.record.at("format") == contract_format;
}

ContractCertificate read_contract_certificate(const std::string& path, const std::string& plan) {
  const TensorFile file = read_tensors(path);
  ContractCertificate c;
  c.record = file.record;
  require(file.record.at("format") == contract_format &&
              file.record.at("format_version").is_number_unsigned() &&
              file.record.at("format_version") == 1 && file.record.at("method") == "contract",
          "is not a contract certificate of format_version 1 and method \"contract\"", unreadable);
  require_digests(file);
  require_modes_are_the_plans(file);
  take_arrays(file, c);
  if (!c.follow) take_further_modes(file, c);
  if (!plan.empty()) require_plan(file, c.geometry, plan);
  if (!plan.empty() && c.follow) require_mission(*c.follow, file.record.at("follow"), plan);
  require_cells(c.geometry, c.loop, c.region, file.record.at("region_of_interest"));
  c.contract = contract_of(file.record.at("contract"));
  const auto radius = file.record.at("contract").at("turn_radius_m").get<std::vector<double>>();
  require(radius[0] <= c.geometry.turn_radius_m && c.geometry.turn_radius_m <= radius[1],
          "contract: turn_radius_m: does not hold the plan's turning radius");
  c.parts = parts_of(c.loop, c.geometry.cell_m, c.parts.per_cell, c.contract);
  require_groups(c);
  require_leaves(c);
  for (ContractCertificate& m : c.further) {
    require_commands(m.loop);
    m.contract = c.contract;
    m.parts = parts_of(m.loop, m.geometry.cell_m, c.parts.per_cell, m.contract);
    require_groups(m);
    require_leaves(m);
  }
  return c;
}

}  // namespace fairway_check
