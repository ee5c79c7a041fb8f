// QGroundControl .plan: JSON with geoFence (polygons, circles), mission and plannedHomePosition.
// Positions are [latitude, longitude], rings are not closed, null stands for NaN, unknown keys are
// ignored.

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/fence_sources.hpp"

namespace fairway {

namespace {

void read_fence_polygons(const JsonPlace& polygons, GeodeticFences& fences) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const JsonPlace entry = polygons.at(i);
    GeodeticPolygon polygon{entry.at("inclusion").boolean(), entry.where(), {}};
    const JsonPlace vertices = entry.at("polygon");
    GeodeticRing& ring = polygon.rings.emplace_back();
    for (std::size_t v = 0; v < vertices.size(); ++v)
      ring.points.push_back(vertices.at(v).latitude_longitude());
    fences.polygons.push_back(std::move(polygon));
  }
}

void read_fence_circles(const JsonPlace& circles, GeodeticFences& fences) {
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const JsonPlace entry = circles.at(i);
    const JsonPlace circle = entry.at("circle");
    fences.circles.push_back({entry.at("inclusion").boolean(), entry.where(),
                              circle.at("center").latitude_longitude(),
                              circle.at("radius").number()});
  }
}

void read_simple_item(const JsonPlace& item, std::vector<MissionPlace>& places) {
  const int command = item.at("command").whole_number();
  if (!visits_a_place(command)) return;
  const JsonPlace params = item.at("params");
  if (params.size() != 7) params.fail(fmt::format("has {} elements, expected 7", params.size()));
  if (params.at(4).value().is_null() || params.at(5).value().is_null()) return;
  const GeodeticPoint point{params.at(4).number(), params.at(5).number()};
  if (is_current_place(point.latitude_deg, point.longitude_deg)) return;
  if (item.has("frame") && !is_global_frame(item.at("frame").whole_number()))
    item.at("frame").fail("is not a global frame, expected latitude and longitude");
  require_geodetic(params.where(), point);
  places.push_back({params.where(), point});
}

void read_items(const JsonPlace& items, std::vector<MissionPlace>& places) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const JsonPlace item = items.at(i);
    const std::string type = item.has("type") ? item.at("type").text() : "SimpleItem";
    if (type == "SimpleItem") {
      read_simple_item(item, places);
    } else if (item.has("TransectStyleComplexItem")) {  // surveys and corridors
      read_items(item.at("TransectStyleComplexItem").at("Items"), places);
    } else if (item.has("landCoordinate") && item.has("landingApproachCoordinate")) {
      for (const char* key : {"landingApproachCoordinate", "landCoordinate"})
        places.push_back({item.at(key).where(), item.at(key).latitude_longitude()});
    } else {
      item.fail(fmt::format(
          "is a complex item of kind {} without plain waypoints",
          item.has("complexItemType") ? shown(item.at("complexItemType").text()) : "unknown"));
    }
  }
}

JsonPlace root_of(const SourceText& source, const nlohmann::json& json) {
  JsonPlace root(json, source.file.string() + ": ");
  if (!is_qgc_plan(json))
    throw InputError(source.file.string(), "is not a plan, expected \"fileType\": \"Plan\"");
  return root;
}

}  // namespace

bool is_qgc_plan(const nlohmann::json& json) {
  return json.is_object() && json.contains("fileType") && json["fileType"] == "Plan";
}

std::vector<MissionPlace> read_plan_mission(const SourceText& source, const nlohmann::json& json) {
  const JsonPlace root = root_of(source, json);
  std::vector<MissionPlace> places;
  read_items(root.at("mission").at("items"), places);
  return places;
}

GeodeticFences read_qgc_plan(const SourceText& source, const nlohmann::json& json) {
  const JsonPlace root = root_of(source, json);
  GeodeticFences fences;
  fences.inputs.push_back(source.input);
  if (root.has("geoFence") && !root.at("geoFence").value().is_null()) {
    const JsonPlace fence = root.at("geoFence");
    if (fence.has("version") && fence.at("version").number() != 2.0)
      fence.at("version").fail("is not 2; open and save the plan with a current QGroundControl");
    if (fence.has("polygons")) read_fence_polygons(fence.at("polygons"), fences);
    if (fence.has("circles")) read_fence_circles(fence.at("circles"), fences);
  }
  if (!root.has("mission")) return fences;
  const JsonPlace mission = root.at("mission");
  if (mission.has("plannedHomePosition") && !mission.at("plannedHomePosition").value().is_null()) {
    const GeodeticPoint home = mission.at("plannedHomePosition").latitude_longitude();
    if (!is_current_place(home.latitude_deg, home.longitude_deg)) fences.home = home;
  }
  if (mission.has("items"))
    for (const MissionPlace& place : read_plan_mission(source, json))
      fences.places.push_back(place.point);
  return fences;
}

}  // namespace fairway
