#include "fairway/exchange/plan_rasters.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/exchange/write_geotiff.hpp"
#include "fairway/vehicle/modes.hpp"

namespace fairway {

void write_plan_raster(const Plan& plan, const std::filesystem::path& path, Existing existing) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> cost_m = plan.cost_m;
  for (float& cost : cost_m) {
    if (!std::isfinite(cost)) cost = none;
  }
  std::vector<float> region(plan.region.size());
  for (std::size_t i = 0; i < region.size(); ++i) region[i] = static_cast<float>(plan.region[i]);
  constexpr const char* heading_meaning =
      "heading to steer, radians counter-clockwise from the grid's x axis (east unless the grid is "
      "rotated); no value: no command";
  std::vector<RasterBand> bands{
      {"heading_rad", "rad", heading_meaning, plan.heading_rad},
      {"cost_m", "m", "cost to go, metres; no value: the goal cannot be reached", cost_m},
      {"region", "", "0 free (safe start), 1 obstacle, -1 buffer, 2 goal", region}};
  const std::span<const float> further(plan.mode_heading_rad);
  for (std::size_t mode = 1; mode <= plan.further_modes(); ++mode) {
    const auto field = further.subspan((mode - 1) * plan.grid.size(), plan.grid.size());
    bands.push_back({fmt::format("heading_rad of mode {}", mode), "rad", heading_meaning, field});
  }
  write_geotiff(plan.grid, frame_in(plan.record), bands, path, existing);
}

namespace {

/// "0 undecided, 1 reach, ...".
template <typename Code>
std::string codes_text(int count) {
  std::string codes;
  for (int v = 0; v < count; ++v) {
    codes += fmt::format("{}{} {}", v == 0 ? "" : ", ", v, name_of(static_cast<Code>(v)));
  }
  return codes;
}

template <typename Code>
RasterBand band_of(const char* what, Heading heading, std::string meaning,
                   const std::vector<Code>& cells) {
  static_assert(sizeof(Code) == 1);
  return {fmt::format("{} at heading {:.6g} rad", what, heading.rad()), "", std::move(meaning),
          std::span(reinterpret_cast<const std::uint8_t*>(cells.data()), cells.size())};
}

}  // namespace

void write_verdict_raster(const Grid& grid, const Frame& frame,
                          std::span<const VerdictLayer> layers, const std::filesystem::path& path,
                          Existing existing) {
  require(!layers.empty(), "a raster of verdicts has a heading");
  std::vector<RasterBand> bands;
  for (const VerdictLayer& layer : layers) {
    bands.push_back(
        band_of("verdict", layer.heading,
                "what is proved for a vehicle there: " + codes_text<Verdict>(verdict_count),
                layer.verdict));
  }
  static_assert(no_mode == no_value_byte);
  for (const VerdictLayer& layer : layers) {
    if (layer.mode.empty()) continue;
    bands.push_back(band_of("mode", layer.heading,
                            "the first mode of the plan that is proved to reach from there; no "
                            "value: none is",
                            layer.mode));
  }
  write_geotiff(grid, frame, bands, path, existing);
}

void write_contract_raster(const Grid& grid, const Frame& frame,
                           std::span<const ContractLayer> layers, const std::filesystem::path& path,
                           Existing existing) {
  require(!layers.empty(), "a raster of verdicts has a heading");
  const std::string meaning = fmt::format(
      "what is proved for every vehicle there that keeps the contract: {}; {} at_risk: one that "
      "fails is known",
      codes_text<Verdict>(verdict_count), at_risk_code);
  std::vector<RasterBand> bands;
  for (const ContractLayer& layer : layers) {
    bands.push_back(band_of("verdict", layer.heading, meaning, layer.code));
  }
  write_geotiff(grid, frame, bands, path, existing);
}

void write_sampled_raster(const Grid& grid, const Frame& frame,
                          std::span<const SampledLayer> layers, const std::filesystem::path& path,
                          Existing existing) {
  require(!layers.empty(), "a raster of samples has a heading");
  std::vector<RasterBand> bands;
  for (const SampledLayer& layer : layers) {
    bands.push_back(band_of(
        "samples", layer.heading,
        "what samples show for a vehicle there, not a proof: " + codes_text<Sampled>(sampled_count),
        layer.answer));
  }
  write_geotiff(grid, frame, bands, path, existing);
}

std::vector<Heading> even_headings(int count) {
  std::vector<Heading> headings;
  for (int k = 0; k < count; ++k) headings.push_back(Heading::from_rad(two_pi * k / count));
  return headings;
}

}  // namespace fairway
