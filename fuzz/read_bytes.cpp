#include "fuzz/read_bytes.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "fairway/base/error.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/map/read_path.hpp"
#include "fairway/map/read_region.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/simulate/state_files.hpp"

namespace fairway {

namespace {

enum class Verb { map, path, path_in_degrees, plan, bitmap, region, scenario, states };

struct Feed {
  std::string_view reader;
  const char* file;
  Verb verb;
};

constexpr std::array<Feed, 18> feeds = {{{"ros_map", "map.yaml", Verb::map},
                                         {"moving_ai", "map.map", Verb::map},
                                         {"geojson", "map.geojson", Verb::map},
                                         {"qgc_plan", "map.plan", Verb::map},
                                         {"ardupilot_fence", "map.fence", Verb::map},
                                         {"waypoints", "map.txt", Verb::map},
                                         {"pnm", "map.pgm", Verb::map},
                                         {"image", "map.png", Verb::map},
                                         {"elevation", "map.tif", Verb::map},
                                         {"world_file", "placed.wld", Verb::map},
                                         {"path_csv", "path.csv", Verb::path},
                                         {"path_json", "path.geojson", Verb::path_in_degrees},
                                         {"path_waypoints", "path.txt", Verb::path_in_degrees},
                                         {"plan_file", "plan.safetensors", Verb::plan},
                                         {"bitmap_file", "bitmap.safetensors", Verb::bitmap},
                                         {"region", "region.geojson", Verb::region},
                                         {"scenario", "scenario.toml", Verb::scenario},
                                         {"states_csv", "states.csv", Verb::states}}};

constexpr std::array<std::string_view, feeds.size()> names = [] {
  std::array<std::string_view, feeds.size()> result{};
  for (std::size_t i = 0; i < feeds.size(); ++i) result[i] = feeds[i].reader;
  return result;
}();

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  std::FILE* stream = std::fopen(file.string().c_str(), "wb");
  if (stream == nullptr) throw std::runtime_error("cannot write " + file.string());
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  if (std::fclose(stream) != 0 || !whole) throw std::runtime_error("cannot write whole file");
}

// A folder for this process, with the images that some inputs refer to.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("fairway-corpus-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    write_file(path_ / "image.pgm", std::string_view("P5 3 2 255\n\x00\xcd\xfe\xff\x80\x01", 17));
    write_file(path_ / "placed.pgm", "P2 2 1 255 0 255");
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path file(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

MapRequest request_for(const Feed& to, const Folder& folder) {
  MapRequest request;
  request.file = folder.file(to.reader == "world_file" ? "placed.pgm" : to.file);
  request.cell_m = 2.0;
  request.inclusion = Inclusion::any;
  request.footprint_radius_m = 1.0;
  request.max_pixels = 1 << 16;
  request.max_cells = 1 << 16;
  if (to.reader == "elevation") request.altitude_m = 100.0;
  if (to.reader == "moving_ai" || to.reader == "pnm" || to.reader == "image")
    request.resolution_m = 1.0;
  return request;
}

ObstacleMap world_for(Verb verb) {
  ObstacleMap world;
  world.grid = {100, 100, -500.0, -500.0, 10.0};
  world.obstacle.resize(world.grid.size());
  if (verb == Verb::path_in_degrees) world.frame.geo = GeoReference{47.0, 8.0, 0.0};
  return world;
}

void read(const Feed& to, const Folder& folder) {
  const std::filesystem::path file = folder.file(to.file);
  switch (to.verb) {
    case Verb::map:
      (void)read_map(request_for(to, folder));
      return;
    case Verb::path:
    case Verb::path_in_degrees:
      (void)read_path(file, world_for(to.verb), true);
      return;
    case Verb::plan:
      (void)read_plan(file);
      return;
    case Verb::bitmap:
      (void)read_bitmap(file);
      return;
    case Verb::region: {
      const ObstacleMap world = world_for(to.verb);
      (void)read_region(file, world.grid, world.frame);
      return;
    }
    case Verb::scenario:
      (void)read_scenario(file);
      return;
    case Verb::states:
      (void)read_states(file);
      return;
  }
}

}  // namespace

std::span<const std::string_view> readers_to_feed() { return names; }

std::string feed(std::string_view reader, std::string_view bytes) {
  static const Folder folder;
  for (const Feed& to : feeds) {
    if (to.reader != reader) continue;
    write_file(folder.file(to.file), bytes);
    try {
      read(to, folder);
      return "read";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  throw std::invalid_argument("no reader of that name");
}

}  // namespace fairway
