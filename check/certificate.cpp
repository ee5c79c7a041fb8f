#include "check/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "check/leaf_findings.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

/// A byte names a mode, and a plan has no more than 64.
constexpr std::uint64_t most_further_modes = 63;

void take_leaves(const TensorFile& file, const std::string& prefix, std::size_t sections,
                 Mode& mode) {
  const auto name = [&prefix](const char* array) { return prefix + array; };
  mode.first = values<std::uint32_t>(file, name("section_first"), "U32", {sections + 1});
  require(mode.first.front() == 0 && std::is_sorted(mode.first.begin(), mode.first.end()),
          name("section_first") + ": does not ascend from 0");
  const std::vector<std::uint64_t> leaves{mode.first.back()};
  mode.begin = values<std::uint32_t>(file, name("leaf_begin"), "U32", leaves);
  mode.rank = values<std::uint32_t>(file, name("leaf_rank"), "U32", leaves);
  mode.time_s = values<float>(file, name("leaf_time_s"), "F32", leaves);
  mode.verdict = values<std::uint8_t>(file, name("leaf_verdict"), "U8", leaves);
}

/// The part of `all` from one number to another.
template <typename T>
std::vector<T> part_of(const std::vector<T>& all, std::size_t from, std::size_t to) {
  return {all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(to)};
}

/// The modes after the plan's own: their arrays are one after another in the same ones.
void take_further_modes(const TensorFile& file, Certificate& c) {
  const auto found = file.tensors.find("mode_heading_rad");
  if (found == file.tensors.end()) return;
  const std::vector<std::uint64_t>& shape = found->second.shape;
  require(shape.size() == 3 && shape[0] >= 1 && shape[0] <= most_further_modes,
          "mode_heading_rad: is not a list of fields", unreadable);
  const std::vector<std::uint64_t>& grid = file.tensors.at("region").shape;
  const auto commands =
      values<float>(file, "mode_heading_rad", "F32", {shape[0], grid[0], grid[1]});
  const std::size_t cells = c.region.size();
  Mode all;
  take_leaves(file, "mode_", 4 * shape[0] * cells, all);
  all.next = values<std::uint8_t>(file, "mode_leaf_next", "U8", {all.first.back()});
  for (std::size_t k = 1; k <= shape[0]; ++k) {
    Mode mode;
    mode.number = k;
    mode.loop.nx = c.loop().nx;
    mode.loop.ny = c.loop().ny;
    mode.loop.kind = c.loop().kind;
    mode.loop.command_rad = part_of(commands, (k - 1) * cells, k * cells);
    mode.first = part_of(all.first, 4 * (k - 1) * cells, 4 * k * cells + 1);
    const std::size_t from = mode.first.front();
    const std::size_t to = mode.first.back();
    for (std::uint32_t& first : mode.first) first -= static_cast<std::uint32_t>(from);
    mode.begin = part_of(all.begin, from, to);
    mode.rank = part_of(all.rank, from, to);
    mode.time_s = part_of(all.time_s, from, to);
    mode.verdict = part_of(all.verdict, from, to);
    mode.next = part_of(all.next, from, to);
    c.modes.push_back(std::move(mode));
  }
}

void take_arrays(const TensorFile& file, Certificate& c) {
  const std::size_t holding = file.tensors.contains("holding") ? 1 : 0;
  const std::size_t of_modes = file.tensors.contains("mode_heading_rad") ? 7 : 0;
  require(file.tensors.size() == 9 + holding + of_modes,
          "does not have the arrays of a certificate", unreadable);
  Mode& mode = c.modes.emplace_back();
  take_plan_arrays(file, c.geometry, mode.loop, c.region);
  c.holding = holding_of(file, c.region);
  require(c.geometry.cell_m < c.geometry.turn_radius_m,
          "geometry: the cells are not smaller than the turning radius");
  take_leaves(file, "", 4 * c.region.size(), mode);
  take_further_modes(file, c);
}

/// Whether what is claimed of a leaf can be claimed of any.
bool is_meaningful(const Mode& mode, std::size_t leaf) {
  const double t = mode.time_s[leaf];
  const std::uint8_t verdict = mode.verdict[leaf];
  if (verdict == undecided) return mode.rank[leaf] == 0 && t == 0.0 && !mode.hands_over(leaf);
  // Of a further mode nothing counts but that it reaches.
  if (mode.number > 0 && verdict != reach) return false;
  if (verdict == trapped) return mode.rank[leaf] == 0 && t > std::numeric_limits<float>::max();
  const bool is_bound = verdict < trapped && t >= 0.0 && std::isfinite(t);
  return is_bound &&
         (!mode.hands_over(leaf) || (mode.rank[leaf] == 0 && mode.next[leaf] < mode.number));
}

void require_leaves(const Mode& mode) {
  const Loop& loop = mode.loop;
  for (std::size_t s = 0; s + 1 < mode.first.size(); ++s) {
    const int side = static_cast<int>(s % 4);
    const bool has_leaves = loop.kind[s / 4] == ordinary && !std::isnan(loop.command_rad[s / 4]) &&
                            positive(into_frame(side, loop.direction[s / 4]).x) &&
                            loop.kind_at(loop.beyond(s)) == ordinary;
    require((mode.first[s] < mode.first[s + 1]) == has_leaves,
            "a section has leaves where it cannot have any, or none where it must");
    for (std::size_t leaf = mode.first[s]; leaf < mode.first[s + 1]; ++leaf) {
      const bool in_order =
          leaf == mode.first[s] ? mode.begin[leaf] == 0 : mode.begin[leaf - 1] < mode.begin[leaf];
      if (in_order && is_meaningful(mode, leaf)) continue;
      require(false, mode.name_of(leaf) +
                         (in_order ? ": has an invalid verdict, rank or time, or hands over to no "
                                     "earlier mode"
                                   : ": leaves do not ascend from the side's start"));
    }
  }
}

}  // namespace

std::size_t Mode::section_of(std::size_t leaf) const { return section_of_leaf(first, leaf); }

std::string Mode::name_of(std::size_t leaf) const {
  const std::size_t s = section_of(leaf);
  const Cell cell = loop.cell_at(s / 4);
  return fmt::format("leaf {} ({} on side {} of cell ({}, {})){}", leaf, leaf - first[s], s % 4,
                     cell.x, cell.y, number > 0 ? fmt::format(" of mode {}", number) : "");
}

Certificate read_certificate(const std::string& path, const std::string& plan) {
  const TensorFile file = read_tensors(path);
  Certificate c;
  c.record = file.record;
  require(file.record.at("format") != "fairway-bitmap",
          "is a bitmap, a picture drawn from samples: it claims no proof, so there is nothing to "
          "check",
          unreadable);
  require(file.record.at("format") == "fairway-certificate" &&
              file.record.at("format_version").is_number_unsigned() &&
              file.record.at("format_version") == 1 && file.record.at("method") == "certified",
          "is not a certificate of format_version 1 and method \"certified\"", unreadable);
  require_digests(file);
  require_modes_of_plan(file);
  take_arrays(file, c);
  if (!plan.empty()) require_plan(file, c.geometry, plan);
  require_cells(c.geometry, c.loop(), c.region, file.record.at("region_of_interest"));
  for (Mode& mode : c.modes) {
    require_commands(mode.loop);
    mode.loop.take_directions(c.geometry.turn_radius_m, c.geometry.cell_m);
    require_leaves(mode);
  }
  return c;
}

}  // namespace fairway_check
