#include "fairway/map/read_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/map/fence_sources.hpp"
#include "fairway/map/image_rows.hpp"
#include "fairway/map/map_sources.hpp"
#include "fairway/map/rasterise.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {

using namespace std::string_literals;

namespace {

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

// Where no keep-in fence bounds the world, it includes the mission. Places beyond the plane, and
// paths that cannot be read, are left to the reader of the mission.
void hold_mission(const MapRequest& request, FenceSet& fences) {
  if (!fences.geo || !fences.names_a_place()) return;
  const TangentPlane plane({fences.geo->latitude_deg, fences.geo->longitude_deg});
  std::vector<Vec2> places = request.also_hold_m;
  for (const GeodeticPoint point : request.also_hold_deg) places.push_back(plane.to_plane_m(point));
  if (request.also_hold_path) {
    ObstacleMap frame;
    frame.frame.geo = fences.geo;
    try {
      for (const Vec2 vertex : path_vertices(*request.also_hold_path, frame))
        places.push_back(vertex);
    } catch (const InputError&) {
    }
  }
  for (const Vec2 place : places) {
    if (!(norm(place) <= tangent_plane_limit_m)) continue;
    fences.places_m.push_back(place);
    fences.geo->worst_error_m =
        std::max(fences.geo->worst_error_m, plane.worst_error_m(plane.from_plane(place)));
  }
}

// Several keep-in fences need the user's word on what they mean together.
ObstacleMap rasterise_fences(const GeodeticFences& fences, const MapRequest& request) {
  FenceSet in_metres = in_tangent_plane(fences, request.reference);
  const std::size_t keep_ins = in_metres.keep_in.size() + in_metres.keep_in_circles.size();
  if (keep_ins > 1 && !request.inclusion)
    throw InputError(request.file.string(),
                     fmt::format("has {} keep-in fences; map.inclusion is missing: \"all\" (stay "
                                 "in every one) or \"any\" (stay in one of them)",
                                 keep_ins));
  if (keep_ins == 0) hold_mission(request, in_metres);
  RasteriseOptions options = options_of(request);
  options.least_world_margin_m = request.least_world_margin_m;
  options.growth_m += in_metres.geo ? in_metres.geo->worst_error_m : 0.0;
  return rasterise(in_metres, options, request.inclusion.value_or(Inclusion::all),
                   request.world_margin_m);
}

void require_no_altitude(const MapRequest& request) {
  if (request.altitude_m)
    throw InputError("map.altitude_m", "does not apply to " + request.file.string() +
                                           ", only to elevation rasters and GeoJSON heights");
}

GeodeticFences read_json_fences(const MapRequest& request) {
  const SourceText source = read_source(request.file);
  const nlohmann::json json = parse_json(source);
  if (!is_qgc_plan(json)) return read_geojson(source, json, request);
  require_no_altitude(request);
  return read_qgc_plan(source, json);
}

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

struct Head {
  const std::filesystem::path& file;
  std::string_view bytes;
  std::string_view text;  // trimmed; empty for images
  std::string extension;  // in small letters

  bool ends_in(std::initializer_list<const char*> endings) const {
    return std::find(endings.begin(), endings.end(), extension) != endings.end();
  }
};

// A kind of map file. The first that recognises a file reads it; the errors, the help and the
// scenario's documentation are made from these rows.
struct MapKind {
  const char* name;
  bool (*recognises)(const Head&);
  ObstacleMap (*reads)(const MapRequest&);
  bool knows_heights;  // else map.altitude_m does not apply
};

constexpr MapKind map_kinds[] = {
    {"an image (GeoTIFF; PNG, PGM, PPM, BMP, JPEG or TIFF with a world file or `map.resolution_m`)",
     [](const Head& h) { return is_pnm(h.bytes) || is_gdal_image(h.bytes) || is_pnm_file(h.file); },
     [](const MapRequest& r) { return rasterise(read_placed_raster(r), options_of(r)); }, true},
    {"ROS map_server .yaml",
     [](const Head& h) {
       return h.ends_in({".yaml", ".yml"});
     },
     [](const MapRequest& r) {
       return rasterise(read_ros_map(read_source(r.file), r), options_of(r));
     },
     false},
    {"QGC waypoints", [](const Head& h) { return is_waypoint_file(h.text); },
     [](const MapRequest& r) {
       return rasterise_fences(read_waypoint_fences(read_source(r.file)), r);
     },
     false},
    {"GeoJSON or QGroundControl .plan",
     [](const Head& h) {
       return h.text.starts_with('{') || h.ends_in({".geojson", ".json", ".plan"});
     },
     [](const MapRequest& r) { return rasterise_fences(read_json_fences(r), r); }, true},
    {"MovingAI .map",
     [](const Head& h) { return h.text.starts_with("type ") || h.ends_in({".map"}); },
     [](const MapRequest& r) {
       return rasterise(read_moving_ai(read_source(r.file), r), options_of(r));
     },
     false},
    {"ArduPilot fence (.fen, .fence, .txt)",
     [](const Head& h) {
       return h.ends_in({".txt", ".fen", ".fence"});
     },
     [](const MapRequest& r) {
       return rasterise_fences(read_ardupilot_fence(read_source(r.file)), r);
     },
     false},
};

const MapKind& kind_of(const std::filesystem::path& file) {
  const std::string bytes = first_bytes(file);
  const bool binary = is_pnm(bytes) || is_gdal_image(bytes);
  const std::string text = binary ? std::string() : plain_text(bytes, file.string());
  const Head head{file, bytes, trimmed(text), lower(file.extension().string())};
  for (const MapKind& kind : map_kinds)
    if (kind.recognises(head)) return kind;
  refuse_other_kind(MappedFile(file).bytes(), FileKind::unknown, file.string());
  throw InputError(file.string(), "has an unrecognised format; expected " + map_kinds_text());
}

ObstacleMap read_kind(const MapRequest& request) {
  const MapKind& kind = kind_of(request.file);
  if (!kind.knows_heights) require_no_altitude(request);
  return kind.reads(request);
}

// An error in a map that a scenario names, with the scenario's line.
[[noreturn]] void refuse_with_place(const MapRequest& request, const InputError& error) {
  const bool of_a_key = error.where().starts_with("map.");
  const std::string place = request.place_of(of_a_key ? error.where() : "map.file");
  if (of_a_key) throw InputError(place, error.what());
  throw InputError(error.where(), fmt::format("{} (map.file of {})", reason_of(error), place));
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

std::string map_kinds_text() {
  std::string text;
  for (std::size_t i = 1; i < std::size(map_kinds); ++i) text += map_kinds[i].name + ", "s;
  return text + "or " + map_kinds[0].name;
}

ObstacleMap read_map(const MapRequest& request) {
  ObstacleMap map;
  try {
    check(request);
    map = read_kind(request);
  } catch (const InputError& error) {
    if (!request.place_of) throw;
    refuse_with_place(request, error);
  }
  if (std::find(map.obstacle.begin(), map.obstacle.end(), 0) == map.obstacle.end())
    map.warnings.push_back(request.file.string() + ": no cell of the map is free.");
  return map;
}

}  // namespace fairway
