#include "fairway/run/export_raster.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// A member that is not null.
const json* given(const json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw InputError(where, "is not an object");
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

}  // namespace

WorldPlace world_place_of(const std::string& record_json, const std::string& where) {
  const json record = parse_strict_json(record_json, where);
  WorldPlace place;
  const json* frame = given(record, "frame", where);
  if (frame == nullptr) return place;
  const std::string at = where + ": fairway.frame";
  if (const json* pose = given(*frame, "world_from_grid", at)) {
    const std::string in = at + ".world_from_grid";
    place.world_from_grid = {finite_number(*pose, "x_m", in), finite_number(*pose, "y_m", in),
                             finite_number(*pose, "yaw_rad", in)};
  }
  if (const json* geo = given(*frame, "georeference", at)) {
    const std::string in = at + ".georeference";
    place.geo = GeoReference{finite_number(*geo, "latitude_deg", in),
                             finite_number(*geo, "longitude_deg", in),
                             finite_number(*geo, "worst_error_m", in)};
  }
  if (given(*frame, "projected_crs", at) != nullptr) {
    place.projected_crs = text_member(*frame, "projected_crs", at);
  }
  return place;
}

LonLatOf lon_lat_of(const Plan& plan, const std::string& where) {
  const WorldPlace place = world_place_of(plan.record_json, where);
  auto degrees = degrees_from_frame(place.geo, place.projected_crs, where);
  if (!degrees) return {};
  return [degrees = std::move(degrees)](Vec2 position_m) {
    const GeodeticPoint point = degrees(position_m);
    return LonLat{point.longitude_deg, point.latitude_deg};
  };
}

void export_plan(const Plan& plan, const std::string& where, const std::filesystem::path& path,
                 Existing existing) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> cost_m = plan.cost_m;
  for (float& cost : cost_m) {
    if (!std::isfinite(cost)) cost = none;
  }
  std::vector<float> region(plan.region.size());
  for (std::size_t i = 0; i < region.size(); ++i) region[i] = static_cast<float>(plan.region[i]);
  const std::vector<RasterBand> bands{
      {"heading_rad", "rad",
       "heading to steer, radians counter-clockwise from the grid's x axis (east unless the grid "
       "is "
       "turned); no value: no command",
       plan.heading_rad},
      {"cost_m", "m", "cost to go, metres; no value: the goal cannot be reached", cost_m},
      {"region", "", "0 free (safe start), 1 obstacle, -1 buffer, 2 goal", region}};
  write_geotiff(plan.grid, world_place_of(plan.record_json, where), bands, path, existing);
}

void export_verdicts(const Certificate& certificate, const std::string& where,
                     std::span<const Heading> headings, const std::filesystem::path& path,
                     Existing existing) {
  require(!headings.empty(), "a raster of verdicts has a heading");
  require_writable_place(path, existing);
  const WorldPlace place = world_place_of(certificate.record_json, where);
  std::string codes;
  for (int v = 0; v < verdict_count; ++v) {
    codes += fmt::format("{}{} {}", v == 0 ? "" : ", ", v, name_of(static_cast<Verdict>(v)));
  }
  std::vector<std::vector<std::uint8_t>> layers;
  for (const Heading heading : headings) {
    std::vector<std::uint8_t>& layer = layers.emplace_back(certificate.grid.size());
    const std::vector<Verdict> verdicts = verdicts_at(certificate, heading);
    for (std::size_t i = 0; i < layer.size(); ++i)
      layer[i] = static_cast<std::uint8_t>(verdicts[i]);
  }
  std::vector<RasterBand> bands;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    bands.push_back({fmt::format("verdict at heading {:.6g} rad", headings[k].rad()), "",
                     "what is proved of the vehicle there: " + codes, layers[k]});
  }
  write_geotiff(certificate.grid, place, bands, path, existing);
}

std::vector<Heading> even_headings(int count) {
  std::vector<Heading> headings;
  for (int k = 0; k < count; ++k) headings.push_back(Heading::from_rad(two_pi * k / count));
  return headings;
}

}  // namespace fairway
