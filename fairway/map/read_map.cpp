#include "fairway/map/read_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"
#include "fairway/map/image_rows.hpp"
#include "fairway/map/map_sources.hpp"
#include "fairway/map/rasterise.hpp"

namespace fairway {

namespace {

enum class Kind { ros, moving_ai, image, json, waypoints, fence };

std::string first_bytes(const std::filesystem::path& file) {
  require_regular_file(file);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
      std::fopen(file.string().c_str(), "rb"), &std::fclose);
  if (!stream) throw InputError(file.string(), "cannot be opened for reading");
  std::string head(512, '\0');
  head.resize(std::fread(head.data(), 1, head.size(), stream.get()));
  if (head.empty()) throw InputError(file.string(), "is empty");
  return head;
}

bool is_image(std::string_view head) {
  using namespace std::string_view_literals;
  return is_pnm(head) || head.starts_with("\x89PNG"sv) || head.starts_with("BM"sv) ||
         head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) ||
         head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv) ||
         head.starts_with("\xff\xd8\xff"sv);
}

Kind kind_of(const std::filesystem::path& file) {
  const std::string head = first_bytes(file);
  const std::string extension = lower(file.extension().string());
  if (is_image(head)) return Kind::image;
  if (extension == ".yaml" || extension == ".yml") return Kind::ros;
  const std::string_view text = trimmed(head);
  if (is_waypoint_file(text)) return Kind::waypoints;
  if (text.starts_with('{') || extension == ".geojson" || extension == ".json" ||
      extension == ".plan")
    return Kind::json;
  if (text.starts_with("type ") || extension == ".map") return Kind::moving_ai;
  if (extension == ".txt" || extension == ".fen" || extension == ".fence") return Kind::fence;
  throw InputError(file.string(),
                   "is of no known kind, expected a ROS map .yaml, MovingAI .map, GeoJSON, "
                   "QGroundControl .plan, ArduPilot fence, or a PGM, PNG, BMP, JPEG or TIFF image");
}

void require_range(const char* key, double value, bool zero_allowed) {
  if (!std::isfinite(value) || value < 0.0 || (value == 0.0 && !zero_allowed))
    throw InputError(key, fmt::format("is {}, expected a finite number {}", value,
                                      zero_allowed ? "of at least 0" : "above 0"));
}

void check(const MapRequest& request) {
  require_range("map.cell_m", request.cell_m, false);
  require_range("map.footprint_radius_m", request.footprint_radius_m, true);
  require_range("map.margin_m", request.margin_m, true);
  if (request.world_margin_m) require_range("map.world_margin_m", *request.world_margin_m, true);
  require_range("map.least_world_margin_m", request.least_world_margin_m, true);
  if (request.altitude_m && !std::isfinite(*request.altitude_m))
    throw InputError("map.altitude_m", "is not finite, expected metres");
  if (request.resolution_m) require_range("map.resolution_m", *request.resolution_m, false);
}

RasteriseOptions options_of(const MapRequest& request) {
  return {request.cell_m,
          request.footprint_radius_m,
          request.unknown_is_obstacle,
          request.outside_is_obstacle,
          0.0,
          request.max_cells};
}

// Keep-in fences are many only by the user's word on what that means.
ObstacleMap rasterise_fences(const GeodeticFences& fences, const MapRequest& request) {
  const FenceSet in_metres = in_tangent_plane(fences, request.reference);
  const std::size_t keep_ins = in_metres.keep_in.size() + in_metres.keep_in_circles.size();
  if (keep_ins > 1 && !request.inclusion)
    throw InputError(request.file.string(),
                     fmt::format("has {} keep-in fences; map.inclusion is missing: \"all\" (stay "
                                 "in every one) or \"any\" (stay in one of them)",
                                 keep_ins));
  RasteriseOptions options = options_of(request);
  options.least_world_margin_m = request.least_world_margin_m;
  options.growth_m += in_metres.geo ? in_metres.geo->worst_error_m : 0.0;
  return rasterise(in_metres, options, request.inclusion.value_or(Inclusion::all),
                   request.world_margin_m);
}

void require_no_altitude(const MapRequest& request) {
  if (request.altitude_m)
    throw InputError("map.altitude_m", "has no meaning for " + request.file.string() +
                                           ", only for elevation rasters and GeoJSON heights");
}

GeodeticFences read_json_fences(const MapRequest& request) {
  const SourceText source = read_source(request.file);
  const nlohmann::json json = parse_json(source);
  if (!is_qgc_plan(json)) return read_geojson(source, json, request);
  require_no_altitude(request);
  return read_qgc_plan(source, json);
}

ObstacleMap read_kind(Kind kind, const MapRequest& request) {
  if (kind != Kind::image && kind != Kind::json) require_no_altitude(request);
  switch (kind) {
    case Kind::ros:
      return rasterise(read_ros_map(read_source(request.file), request), options_of(request));
    case Kind::moving_ai:
      return rasterise(read_moving_ai(read_source(request.file), request), options_of(request));
    case Kind::image:
      return rasterise(read_placed_raster(request), options_of(request));
    case Kind::json:
      return rasterise_fences(read_json_fences(request), request);
    case Kind::waypoints:
      return rasterise_fences(read_waypoint_fences(read_source(request.file)), request);
    case Kind::fence:
      return rasterise_fences(read_ardupilot_fence(read_source(request.file)), request);
  }
  throw PreconditionViolation("a kind of map without a reader");
}

}  // namespace

double required_resolution_m(const MapRequest& request) {
  if (!request.resolution_m)
    throw InputError(request.file.string(),
                     "has no scale of its own; map.resolution_m is missing (metres per pixel)");
  return *request.resolution_m;
}

void require_agreeing_resolution(const MapRequest& request, double pixel_m) {
  if (request.resolution_m && std::abs(*request.resolution_m - pixel_m) > 1e-6 * pixel_m)
    throw InputError(request.file.string(),
                     fmt::format("has pixels of {} m, but map.resolution_m is {}; leave it out",
                                 pixel_m, *request.resolution_m));
}

ObstacleMap read_map(const MapRequest& request) {
  check(request);
  ObstacleMap map = read_kind(kind_of(request.file), request);
  if (std::find(map.obstacle.begin(), map.obstacle.end(), 0) == map.obstacle.end())
    map.warnings.push_back(request.file.string() + ": no cell of the map is free.");
  return map;
}

}  // namespace fairway
