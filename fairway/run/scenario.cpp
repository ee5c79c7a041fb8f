#include "fairway/run/scenario.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/scenario_text.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/size_range.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const Scenario& s, const char* key, const std::string& what) {
  throw InputError(s.place_of(key), fmt::format("{}: {}", key, what));
}

void require_given(const Scenario& s, const char* key, const char* because) {
  if (!s.lines.contains(key)) {
    throw InputError(s.file.string(), fmt::format("{} is missing: {}", key, because));
  }
}

void forbid(const Scenario& s, const char* key, const char* because) {
  if (s.lines.contains(key)) refuse(s, key, because);
}

/// A circle instead of a path file.
void check_loiter(const Scenario& s) {
  for (const char* key : {"mission.path_file", "mission.closed"}) {
    forbid(s, key, "is given in addition to mission.loiter, expected only one of them");
  }
  for (const char* key : {"mission.loiter.center_m", "mission.loiter.radius_m"}) {
    require_given(s, key, "a circle has a centre, [x, y] in metres, and a radius");
  }
  const double radius_m = *s.mission.loiter.radius_m;
  if (!(radius_m >= s.vehicle.turn_radius_m)) {
    refuse(s, "mission.loiter.radius_m",
           fmt::format("is {}, expected at least vehicle.turn_radius_m = {}", length_text(radius_m),
                       length_text(s.vehicle.turn_radius_m)));
  }
}

void check_mission(const Scenario& s) {
  const std::array loiter_keys{"mission.loiter", "mission.loiter.center_m",
                               "mission.loiter.radius_m", "mission.loiter.direction"};
  if (s.mission.kind == MissionKind::path) {
    const bool loiters = std::any_of(loiter_keys.begin(), loiter_keys.end(),
                                     [&](const char* key) { return s.lines.contains(key); });
    if (loiters) {
      check_loiter(s);
    } else {
      require_given(
          s, "mission.path_file",
          "a mission of kind \"path\" needs the path to follow, or a circle, mission.loiter");
    }
    for (const char* key : {"mission.goal_m", "mission.goal_deg", "mission.goal_heading_rad",
                            "mission.hold", "mission.hold_radius_m"}) {
      forbid(s, key, "belongs to missions of kind \"goal\", this one is of kind \"path\"");
    }
    return;
  }
  forbid(s, "mission.path_file",
         "belongs to missions of kind \"path\", this one is of kind \"goal\"");
  for (const char* key : loiter_keys) {
    forbid(s, key, "belongs to missions of kind \"path\", this one is of kind \"goal\"");
  }
  forbid(s, "mission.closed", "belongs to missions of kind \"path\", this one is of kind \"goal\"");
  if (s.mission.goal_deg && s.mission.goal_m) {
    refuse(s, "mission.goal_deg",
           "is given in addition to mission.goal_m, expected only one of them");
  }
  if (!s.mission.hold) {
    forbid(s, "mission.hold_radius_m", "belongs to missions with hold = true");
  } else if (s.mission.goal_heading_rad) {
    refuse(s, "mission.goal_heading_rad",
           "a vehicle that holds at its goal circles there; expected no heading to arrive with");
  }
  if (!s.mission.goal_deg) {
    require_given(s, "mission.goal_m",
                  "a mission of kind \"goal\" needs a position, [x, y] in metres");
  }
}

void check(const Scenario& s) {
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.required && !s.lines.contains(key.name)) {
      throw InputError(s.file.string(), fmt::format("{} is missing, expected {} ({})", key.name,
                                                    key.kind, key.meaning));
    }
  }
  if (!size_range::holds(s.map.cell_m)) {
    refuse(s, "map.cell_m", fmt::format("is {} m, expected 1e-15 to 1e15", s.map.cell_m));
  }
  if (!size_range::holds(s.vehicle.speed_mps)) {
    refuse(s, "vehicle.speed_mps",
           fmt::format("is {} m/s, expected 1e-15 to 1e15", s.vehicle.speed_mps));
  }
  if (s.vehicle.turn_radius_m > size_range::most_cells * s.map.cell_m) {
    refuse(s, "vehicle.turn_radius_m",
           fmt::format("is {} m, expected at most 1e9 cells of {} m", s.vehicle.turn_radius_m,
                       s.map.cell_m));
  }
  if (!(s.vehicle.turn_radius_m > s.map.cell_m)) {
    refuse(s, "vehicle.turn_radius_m",
           fmt::format("is {} m, expected more than map.cell_m, which is {} m",
                       s.vehicle.turn_radius_m, s.map.cell_m));
  }
  if (s.contract) {
    if (const auto defect = contract_defect(*s.contract, s.vehicle)) {
      refuse(s, ("vehicle.contract." + defect->key).c_str(), defect->what);
    }
  }
  check_mission(s);
  if (s.verify.border_samples % 4 != 0) {
    refuse(s, "verify.border_samples",
           fmt::format("is {}, expected a multiple of four", s.verify.border_samples));
  }
  if (s.verify.method != VerifyMethod::bitmap) {
    forbid(s, "verify.border_samples", "belongs to verify.method = \"bitmap\"");
  } else if (s.verify.ceiling) {
    refuse(s, "verify.ceiling",
           "compares what is proved with what any control could keep; a bitmap proves nothing");
  }
}

void root_paths(Scenario& s) {
  const fs::path folder = s.file.parent_path();
  s.map.file = folder / s.map.file;
  if (s.mission.path_file) s.mission.path_file = folder / *s.mission.path_file;
  fs::path& region = s.verify.region.file;
  if (!region.empty()) region = folder / region;
}

}  // namespace

std::string Scenario::place_of(std::string_view key) const {
  if (const auto option = options.find(key); option != options.end()) return option->second;
  const auto line = lines.find(key);
  if (line == lines.end()) return file.string();
  return fmt::format("{}:{}", file.string(), line->second);
}

Scenario scenario_of_text(std::string_view bytes, const fs::path& file,
                          std::span<const ScenarioOverride> overrides) {
  Scenario scenario = keys_of_text(bytes, file, overrides);
  check(scenario);
  root_paths(scenario);
  return scenario;
}

Scenario read_scenario(const fs::path& file, std::span<const ScenarioOverride> overrides) {
  Scenario scenario;
  use_toml_file(file,
                [&](std::string_view text) { scenario = scenario_of_text(text, file, overrides); });
  return scenario;
}

}  // namespace fairway
