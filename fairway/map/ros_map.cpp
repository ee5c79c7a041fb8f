// ROS map_server YAML: image, resolution, origin [x, y, yaw], negate, occupied_thresh,
// free_thresh, mode.

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/map/map_sources.hpp"
#include "fairway/map/occupancy.hpp"

namespace fairway {

namespace {

struct RosMap {
  std::filesystem::path image;
  double resolution_m = 0.0;
  std::array<double, 3> origin{};  // x, y metres, yaw radians
  OccupancyRule rule;
  std::vector<std::string> warnings;
};

class RosYaml {
 public:
  explicit RosYaml(const SourceText& source) : source_(source) {
    try {
      root_ = YAML::Load(source.text);
    } catch (const YAML::Exception& e) {
      throw InputError(
          e.mark.is_null() ? source.file.string() : at_line(source.file, line_of(e.mark)),
          "is not YAML: " + e.msg);
    }
    if (!root_.IsMap())
      throw InputError(at_line(source.file, 1),
                       "is not a ROS map, expected keys image, resolution, origin ...");
    index_keys();
  }

  bool has(const std::string& key) const { return values_.contains(key); }

  const std::map<std::string, YAML::Node>& values() const { return values_; }

  YAML::Node at(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end())
      throw InputError(at_line(source_.file, lines_of(source_.text).size()),
                       fmt::format("the key {} is missing", key));
    return found->second;
  }

  std::string text(const std::string& key) const {
    const YAML::Node node = at(key);
    if (!node.IsScalar()) fail(node, fmt::format("{} is not a plain value", key));
    return node.Scalar();
  }

  double number(const std::string& key) const { return number(at(key), key); }

  double number(const YAML::Node& node, const std::string& key) const {
    if (!node.IsScalar()) fail(node, fmt::format("{} is not a number", key));
    const std::string& scalar = node.Scalar();
    auto value = parse_number(scalar);
    if (!value && (lower(scalar) == ".nan" || lower(scalar).ends_with(".inf")))
      value = std::nan("");
    if (!value) fail(node, fmt::format("{} is {}, expected a number", key, shown(scalar)));
    if (!std::isfinite(*value))
      fail(node, fmt::format("{} is {}, expected a finite number", key, shown(scalar)));
    return *value;
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    throw InputError(at_line(source_.file, line_of(node.Mark())), what);
  }

 private:
  static std::size_t line_of(const YAML::Mark& mark) {
    return mark.is_null() ? 1 : static_cast<std::size_t>(mark.line) + 1;
  }

  // YAML requires distinct keys in a mapping; the parser keeps both and silently uses the first.
  void index_keys() {
    std::map<std::string, std::size_t> first_line;
    for (const auto& entry : root_) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key is not a plain word");
      const std::string key = entry.first.Scalar();
      const std::size_t line = line_of(entry.first.Mark());
      const auto [at, fresh] = first_line.emplace(key, line);
      if (!fresh)
        throw InputError(
            at_line(source_.file, line),
            fmt::format("the key {} occurs twice, first in line {}", shown(key), at->second));
      values_.emplace(key, entry.second);
    }
  }

  const SourceText& source_;
  YAML::Node root_;
  std::map<std::string, YAML::Node> values_;
};

OccupancyRule read_rule(const RosYaml& yaml) {
  OccupancyRule rule;
  if (yaml.has("mode")) {
    const std::string mode = yaml.text("mode");
    if (mode == "trinary")
      rule.mode = OccupancyRule::Mode::trinary;
    else if (mode == "scale")
      rule.mode = OccupancyRule::Mode::scale;
    else if (mode == "raw")
      rule.mode = OccupancyRule::Mode::raw;
    else
      yaml.fail(yaml.at("mode"),
                fmt::format("mode is {}, expected trinary, scale or raw", shown(mode)));
  }
  const std::string negate = lower(yaml.text("negate"));
  if (negate == "1" || negate == "true" || negate == "yes" || negate == "on")
    rule.negate = true;
  else if (negate != "0" && negate != "false" && negate != "no" && negate != "off")
    yaml.fail(yaml.at("negate"),
              fmt::format("negate is {}, expected 0, 1, true or false", shown(negate)));
  rule.occupied = yaml.number("occupied_thresh");
  rule.free = yaml.number("free_thresh");
  for (const auto& [key, value] :
       {std::pair{"occupied_thresh", rule.occupied}, std::pair{"free_thresh", rule.free}})
    if (value < 0.0 || value > 1.0)
      yaml.fail(yaml.at(key), fmt::format("{} is {}, expected 0 to 1", key, value));
  if (rule.free > rule.occupied ||
      (rule.mode == OccupancyRule::Mode::scale && rule.free == rule.occupied))
    yaml.fail(yaml.at("free_thresh"), fmt::format("free_thresh {} is not below occupied_thresh {}",
                                                  rule.free, rule.occupied));
  return rule;
}

RosMap read_keys(const SourceText& source) {
  const RosYaml yaml(source);
  RosMap map;
  const std::string image = yaml.text("image");
  if (image.empty() || image.find('\0') != std::string::npos)
    yaml.fail(yaml.at("image"), "image does not name a file");
  map.image = source.file.parent_path() / image;
  std::error_code ignored;
  if (!std::filesystem::exists(map.image, ignored))
    yaml.fail(yaml.at("image"),
              fmt::format("the image {} does not exist next to this file", shown(image)));
  map.resolution_m = yaml.number("resolution");
  if (map.resolution_m <= 0.0)
    yaml.fail(yaml.at("resolution"),
              fmt::format("resolution is {}, expected metres per pixel above 0", map.resolution_m));
  const YAML::Node origin = yaml.at("origin");
  if (!origin.IsSequence() || origin.size() != 3)
    yaml.fail(origin, "origin is not a list of three numbers [x, y, yaw]");
  for (std::size_t i = 0; i < 3; ++i) map.origin[i] = yaml.number(origin[i], "origin");
  map.rule = read_rule(yaml);
  for (const auto& [key, value] : yaml.values())
    if (key != "image" && key != "resolution" && key != "origin" && key != "negate" &&
        key != "occupied_thresh" && key != "free_thresh" && key != "mode")
      map.warnings.push_back(
          fmt::format("{}: the key {} is unknown and ignored.", source.file.string(), shown(key)));
  return map;
}

}  // namespace

SourceRaster read_ros_map(const SourceText& yaml, const MapRequest& request) {
  const RosMap map = read_keys(yaml);
  require_agreeing_resolution(request, map.resolution_m);
  SourceRaster raster = read_occupancy(map.image, map.rule, request.max_pixels);
  raster.pixel_width_m = raster.pixel_height_m = map.resolution_m;
  raster.warnings.insert(raster.warnings.begin(), map.warnings.begin(), map.warnings.end());
  if (map.origin[2] == 0.0) {
    raster.lower_left_m = {map.origin[0], map.origin[1]};
  } else {
    raster.world_from_grid = {map.origin[0], map.origin[1], map.origin[2]};
    raster.warnings.push_back(
        fmt::format("{}: the origin is rotated by {} rad; all coordinates are in the map's own "
                    "frame, lower-left corner at (0, 0); in the world that corner is at ({}, {}).",
                    yaml.file.string(), map.origin[2], map.origin[0], map.origin[1]));
  }
  raster.inputs = {yaml.input, {map.image.string(), sha256_file(map.image)}};
  return raster;
}

}  // namespace fairway
