// QGC WPL 110: one line per item, twelve fields separated by tabs: index, current, frame, command,
// four parameters, latitude, longitude, altitude, autocontinue. Item 0 is the home position.
// Fence items (MAV_CMD_NAV_FENCE...) are 5000 return point, 5001 and 5002 corners of a keep-in and
// a keep-out polygon (parameter 1: how many corners), 5003 and 5004 circles (parameter 1: radius).

#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"

namespace fairway {

namespace {

struct Item {
  std::string where;
  std::size_t line = 0;
  int index = 0;
  int frame = 0;
  int command = 0;
  double parameter_1 = 0.0;
  GeodeticPoint point;
};

constexpr std::string_view magic = "QGC WPL 110";

double field(const std::vector<std::string_view>& words, std::size_t i, const std::string& where) {
  const auto number = parse_number(words[i]);
  if (!number)
    throw InputError(where,
                     fmt::format("field {} is {}, expected a number", i + 1, shown(words[i])));
  return *number;
}

int whole_field(const std::vector<std::string_view>& words, std::size_t i,
                const std::string& where) {
  const double number = field(words, i, where);
  if (!(number >= 0.0 && number <= 65535.0) || number != std::floor(number))
    throw InputError(where, fmt::format("field {} is {}, expected a whole number from 0 to 65535",
                                        i + 1, shown(words[i])));
  return static_cast<int>(number);
}

std::vector<Item> read_items(const SourceText& source) {
  const std::vector<Line> lines = lines_of(source.text);
  if (lines.empty() || trimmed(lines.front().text) != magic)
    throw InputError(at_line(source.file, 1),
                     fmt::format("{} is not a waypoint file, expected \"{}\"",
                                 shown(lines.empty() ? "" : lines.front().text), magic));
  std::vector<Item> items;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i].text).empty()) continue;
    const std::string where = at_line(source.file, lines[i].number);
    const auto words = split(lines[i].text, ' ');
    if (words.size() != 12)
      throw InputError(where, fmt::format("has {} fields, expected 12", words.size()));
    Item item{where,
              lines[i].number,
              whole_field(words, 0, where),
              whole_field(words, 2, where),
              whole_field(words, 3, where),
              field(words, 4, where),
              {field(words, 8, where), field(words, 9, where)}};
    items.push_back(item);
  }
  return items;
}

// Files with only fences may start with a fence item, which is not a home position.
bool is_home(const Item& item) { return item.index == 0 && item.command == 16; }

// The corners of a polygon are consecutive; each says how many there are.
std::size_t read_fence_polygon(const std::vector<Item>& items, std::size_t first,
                               GeodeticFences& fences) {
  const Item& head = items[first];
  const double count = head.parameter_1;
  if (!(count >= 3.0 && count <= 65535.0) || count != std::floor(count))
    throw InputError(head.where,
                     fmt::format("the polygon has {} corners, expected at least 3", count));
  const auto corners = static_cast<std::size_t>(count);
  GeodeticPolygon polygon{head.command == 5001, head.where, {}};
  GeodeticRing& ring = polygon.rings.emplace_back();
  for (std::size_t i = first; i < first + corners; ++i) {
    if (i >= items.size() || items[i].command != head.command)
      throw InputError(i < items.size() ? items[i].where : items.back().where,
                       fmt::format("the polygon that starts at {} has {} corners, expected {}",
                                   head.where, i - first, corners));
    require_geodetic(items[i].where, items[i].point);
    ring.points.push_back(items[i].point);
    ring.lines.push_back(items[i].line);
  }
  fences.polygons.push_back(std::move(polygon));
  return first + corners;
}

std::vector<MissionPlace> mission_of(const std::vector<Item>& items) {
  std::vector<MissionPlace> places;
  for (const Item& item : items) {
    if (is_home(item) || !visits_a_place(item.command)) continue;
    if (is_current_place(item.point.latitude_deg, item.point.longitude_deg)) continue;
    if (!is_global_frame(item.frame))
      throw InputError(item.where, fmt::format("frame {} is not a global frame, "
                                               "expected latitude and longitude",
                                               item.frame));
    require_geodetic(item.where, item.point);
    places.push_back({item.where, item.point});
  }
  return places;
}

}  // namespace

bool is_waypoint_file(std::string_view head) { return head.starts_with("QGC WPL"); }

std::vector<MissionPlace> read_waypoint_mission(const SourceText& source) {
  return mission_of(read_items(source));
}

GeodeticFences read_waypoint_fences(const SourceText& source) {
  const std::vector<Item> items = read_items(source);
  GeodeticFences fences;
  fences.inputs.push_back(source.input);
  for (std::size_t i = 0; i < items.size();) {
    const Item& item = items[i];
    if (item.command == 5001 || item.command == 5002) {
      i = read_fence_polygon(items, i, fences);
      continue;
    }
    if (item.command == 5003 || item.command == 5004) {
      require_geodetic(item.where, item.point);
      fences.circles.push_back({item.command == 5003, item.where, item.point, item.parameter_1});
    }
    const bool names_home = item.command == 5000 || (is_home(item) && !fences.home);
    if (names_home && !is_current_place(item.point.latitude_deg, item.point.longitude_deg)) {
      require_geodetic(item.where, item.point);
      fences.home = item.point;
    }
    ++i;
  }
  for (const MissionPlace& place : mission_of(items)) fences.places.push_back(place.point);
  return fences;
}

}  // namespace fairway
