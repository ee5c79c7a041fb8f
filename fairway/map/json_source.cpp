#include "fairway/map/json_source.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/map/geodetic_fences.hpp"

namespace fairway {

namespace {

std::string kind_of(const nlohmann::json& value) {
  if (value.is_null()) return "null";
  if (value.is_string()) return "a string";
  if (value.is_number()) return "a number";
  if (value.is_boolean()) return "true or false";
  return value.is_array() ? "a list" : "an object";
}

}  // namespace

nlohmann::json parse_json(const SourceText& source) {
  return parse_strict_json(source.text, source.file.string(), {.deepest = 64});
}

void JsonPlace::fail(const std::string& what) const { throw InputError(where_, what); }

JsonPlace JsonPlace::at(const std::string& key) const {
  if (!value_->is_object()) fail(fmt::format("is {}, expected an object", kind_of(*value_)));
  const auto found = value_->find(key);
  if (found == value_->end())
    fail(fmt::format("the key {} is missing", shown(std::string_view(key))));
  return {*found, where_ + (where_.ends_with(": ") ? "" : ".") + key};
}

std::size_t JsonPlace::size() const {
  if (!value_->is_array()) fail(fmt::format("is {}, expected a list", kind_of(*value_)));
  return value_->size();
}

JsonPlace JsonPlace::at(std::size_t index) const {
  if (index >= size()) fail(fmt::format("has only {} elements", size()));
  return {(*value_)[index], fmt::format("{}[{}]", where_, index)};
}

std::string JsonPlace::text() const {
  if (!value_->is_string()) fail(fmt::format("is {}, expected a string", kind_of(*value_)));
  return value_->get<std::string>();
}

double JsonPlace::number() const {
  if (!value_->is_number()) fail(fmt::format("is {}, expected a number", kind_of(*value_)));
  const double number = value_->get<double>();
  if (!std::isfinite(number)) fail("is not finite");
  return number;
}

int JsonPlace::whole_number() const {
  const double value = number();
  if (std::abs(value) > 1e9 || value != std::floor(value))
    fail(fmt::format("is {}, expected a whole number from -1000000000 to 1000000000", value));
  return static_cast<int>(value);
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) fail(fmt::format("is {}, expected true or false", kind_of(*value_)));
  return value_->get<bool>();
}

GeodeticPoint JsonPlace::latitude_longitude() const {
  if (size() < 2) fail("is too short, expected [latitude, longitude]");
  const GeodeticPoint point{at(std::size_t{0}).number(), at(1).number()};
  require_geodetic(where_, point);
  return point;
}

GeodeticPoint JsonPlace::longitude_latitude() const {
  if (size() < 2) fail("is too short, expected [longitude, latitude]");
  const GeodeticPoint point{at(1).number(), at(std::size_t{0}).number()};
  require_geodetic(where_, point);
  return point;
}

}  // namespace fairway
