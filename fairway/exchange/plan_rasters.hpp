// Plans, verdicts and bitmaps as GeoTIFF for GIS programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/frame.hpp"
#include "fairway/base/grid.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/bitmap/sampled.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Bands heading (rad), cost (m), region (code), as floats, then the heading of each further mode.
/// No command, no way to the goal: no value.
void write_plan_raster(const Plan& plan, const std::filesystem::path& path, Existing existing);

/// The verdicts of a grid at one heading, [iy][ix].
struct VerdictLayer {
  Heading heading;
  std::vector<Verdict> verdict;
  /// The first mode that is proved to reach, no_mode where none is; empty: the plan has one mode.
  std::vector<std::uint8_t> mode = {};
};

/// A band of bytes for each layer, at least one: the verdicts by code. After these, in the same
/// order, a band of modes for each layer that has them.
void write_verdict_raster(const Grid& grid, const Frame& frame,
                          std::span<const VerdictLayer> layers, const std::filesystem::path& path,
                          Existing existing);

/// The code of `at_risk` in rasters, after those of Verdict.
inline constexpr std::uint8_t at_risk_code = verdict_count;

/// What is known of a grid under a contract at one heading, [iy][ix]: Verdict codes, or
/// at_risk_code.
struct ContractLayer {
  Heading heading;
  std::vector<std::uint8_t> code;
};

/// The same under a contract: a verdict is that of every behaviour within it.
void write_contract_raster(const Grid& grid, const Frame& frame,
                           std::span<const ContractLayer> layers, const std::filesystem::path& path,
                           Existing existing);

/// A bitmap's answers for a grid at one heading, [iy][ix].
struct SampledLayer {
  Heading heading;
  std::vector<Sampled> answer;
};

/// The same for a bitmap: answers by code, a picture and not a proof.
void write_sampled_raster(const Grid& grid, const Frame& frame,
                          std::span<const SampledLayer> layers, const std::filesystem::path& path,
                          Existing existing);

/// `count` headings, evenly spaced, the first east.
[[nodiscard]] std::vector<Heading> even_headings(int count);

}  // namespace fairway
