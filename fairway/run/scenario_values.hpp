// How each kind of value is read from a scenario's TOML and shown as JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/toml_value.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

// Each throws InputError at the value's line if it is not such a value. States: headings in radians
// from -7 to 7; on Earth: latitude, longitude, course.
void take(const TomlValue& value, double& x);
void take(const TomlValue& value, std::uint64_t& x);
void take(const TomlValue& value, bool& x);
void take(const TomlValue& value, Vec2& x);
void take(const TomlValue& value, std::filesystem::path& x);
void take(const TomlValue& value, GeodeticPoint& x);
void take(const TomlValue& value, std::vector<State>& x);
void take(const TomlValue& value, std::vector<EarthState>& x);
template <typename T>
void take(const TomlValue& value, std::optional<T>& x) {
  take(value, x.emplace());
}

[[nodiscard]] nlohmann::json shown(double x);
[[nodiscard]] nlohmann::json shown(std::uint64_t x);
[[nodiscard]] nlohmann::json shown(bool x);
[[nodiscard]] nlohmann::json shown(Vec2 x);
[[nodiscard]] nlohmann::json shown(const GeodeticPoint& x);
[[nodiscard]] nlohmann::json shown(const std::filesystem::path& x);
[[nodiscard]] nlohmann::json shown(const std::vector<State>& states);
[[nodiscard]] nlohmann::json shown(const std::vector<EarthState>& states);
template <typename T>
[[nodiscard]] nlohmann::json shown(const std::optional<T>& x) {
  return x ? shown(*x) : nlohmann::json();
}

}  // namespace fairway
