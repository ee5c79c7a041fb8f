#include "fairway/base/frame_json.hpp"

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"

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

json json_of(const Frame& frame) {
  json value = {{"world_from_grid",
                 {{"x_m", frame.world_from_grid.x_m},
                  {"y_m", frame.world_from_grid.y_m},
                  {"yaw_rad", frame.world_from_grid.yaw_rad}}},
                {"georeference", nullptr},
                {"projected_crs", nullptr}};
  if (frame.geo) {
    value["georeference"] = {{"latitude_deg", frame.geo->latitude_deg},
                             {"longitude_deg", frame.geo->longitude_deg},
                             {"worst_error_m", frame.geo->worst_error_m}};
  }
  if (frame.projected_crs) value["projected_crs"] = *frame.projected_crs;
  return value;
}

Frame frame_of(const json& value, const std::string& where) {
  Frame frame;
  if (const json* pose = given(value, "world_from_grid", where)) {
    const std::string in = where + ".world_from_grid";
    frame.world_from_grid = {finite_number(*pose, "x_m", in), finite_number(*pose, "y_m", in),
                             finite_number(*pose, "yaw_rad", in)};
  }
  if (const json* geo = given(value, "georeference", where)) {
    const std::string in = where + ".georeference";
    frame.geo = GeoReference{finite_number(*geo, "latitude_deg", in),
                             finite_number(*geo, "longitude_deg", in),
                             finite_number(*geo, "worst_error_m", in)};
  }
  if (given(value, "projected_crs", where) != nullptr) {
    frame.projected_crs = text_member(value, "projected_crs", where);
  }
  return frame;
}

}  // namespace fairway
