#include "check/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "check/leaf_findings.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

void take_arrays(const TensorFile& file, Certificate& c) {
  require(file.tensors.size() == (file.tensors.contains("holding") ? 10U : 9U),
          "does not have the arrays of a certificate", unreadable);
  take_plan_arrays(file, c.geometry, c.loop, c.region);
  c.holding = holding_of(file, c.region);
  require(c.geometry.cell_m < c.geometry.turn_radius_m,
          "geometry: the cells are not smaller than the turning radius");
  c.first = values<std::uint32_t>(file, "section_first", "U32", {4 * c.loop.kind.size() + 1});
  const std::vector<std::uint64_t> leaves{c.first.back()};
  c.begin = values<std::uint32_t>(file, "leaf_begin", "U32", leaves);
  c.rank = values<std::uint32_t>(file, "leaf_rank", "U32", leaves);
  c.time_s = values<float>(file, "leaf_time_s", "F32", leaves);
  c.verdict = values<std::uint8_t>(file, "leaf_verdict", "U8", leaves);
}

void require_leaves(const Certificate& c) {
  require(c.first.front() == 0 && std::is_sorted(c.first.begin(), c.first.end()),
          "section_first: does not ascend from 0");
  for (std::size_t s = 0; s + 1 < c.first.size(); ++s) {
    const int side = static_cast<int>(s % 4);
    const bool has_leaves = c.loop.kind[s / 4] == ordinary &&
                            !std::isnan(c.loop.command_rad[s / 4]) &&
                            positive(into_frame(side, c.loop.direction[s / 4]).x) &&
                            c.loop.kind_at(c.loop.beyond(s)) == ordinary;
    require((c.first[s] < c.first[s + 1]) == has_leaves,
            "a section has leaves where it cannot have any, or none where it must");
    for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
      const double t = c.time_s[leaf];
      const bool in_order =
          leaf == c.first[s] ? c.begin[leaf] == 0 : c.begin[leaf - 1] < c.begin[leaf];
      const bool meaningful = c.verdict[leaf] == undecided ? c.rank[leaf] == 0 && t == 0.0
                              : c.verdict[leaf] == trapped
                                  ? c.rank[leaf] == 0 && t > std::numeric_limits<float>::max()
                                  : c.verdict[leaf] < trapped && t >= 0.0 && std::isfinite(t);
      if (in_order && meaningful) continue;
      require(false, c.name_of(leaf) + (in_order ? ": has an invalid verdict, rank or time"
                                                 : ": leaves do not ascend from the side's start"));
    }
  }
}

}  // namespace

std::size_t Certificate::section_of(std::size_t leaf) const { return section_of_leaf(first, leaf); }

std::string Certificate::name_of(std::size_t leaf) const {
  const std::size_t s = section_of(leaf);
  const Cell cell = loop.cell_at(s / 4);
  return fmt::format("leaf {} ({} on side {} of cell ({}, {}))", leaf, leaf - first[s], s % 4,
                     cell.x, cell.y);
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
  take_arrays(file, c);
  if (!plan.empty()) require_plan(file, c.geometry, plan);
  require_cells(c.geometry, c.loop, c.region, file.record.at("region_of_interest"));
  c.loop.take_directions(c.geometry.turn_radius_m, c.geometry.cell_m);
  require_leaves(c);
  return c;
}

}  // namespace fairway_check
