// JSON files with located errors: the line for broken syntax, the path of keys for the rest.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/map/read_map.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

/// Strictly (base/strict_json.hpp), but to 64 levels: GeoJSON nests.
[[nodiscard]] nlohmann::json parse_json(const SourceText& source);

/// A value and where it is: "FILE: geoFence.polygons[0]". Missing keys and wrong types throw
/// InputError that names the path.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string where)
      : value_(&value), where_(std::move(where)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& where() const { return where_; }

  bool is_object() const { return value_->is_object(); }
  bool is_array() const { return value_->is_array(); }
  bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }

  JsonPlace at(const std::string& key) const;  ///< a key of an object
  JsonPlace at(std::size_t index) const;       ///< an element of an array
  std::size_t size() const;                    ///< of an array

  std::string text() const;
  double number() const;  ///< finite
  int whole_number() const;
  bool boolean() const;

  /// [latitude, longitude, ...], as QGroundControl writes it.
  GeodeticPoint latitude_longitude() const;
  /// [longitude, latitude, ...], as GeoJSON has it.
  GeodeticPoint longitude_latitude() const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace fairway
