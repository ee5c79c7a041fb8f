// A scenario: everything one run needs, from one TOML file (docs/scenario.md).
//
// Defaults live in the option structs of the stages and only there. Paths are relative to the
// scenario's folder. Values are checked one by one and against each other; errors that need
// the map (a goal in an obstacle, for example) come later and find their line with `place_of`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/field/field.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/choose_parameters.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

enum class MissionKind { goal, path };

enum class LoiterDirection { left, right };

/// A path that is a circle, flown round and round.
struct LoiterRequest {
  std::optional<Vec2> center_m;  ///< in the grid's frame
  std::optional<double> radius_m;
  LoiterDirection direction = LoiterDirection::left;
};

/// The [mission] table; becomes a Mission once the map, hence the frame, is known.
struct MissionRequest {
  MissionKind kind = MissionKind::goal;
  std::optional<Vec2> goal_m;             ///< in the grid's frame
  std::optional<GeodeticPoint> goal_deg;  ///< instead, on maps in degrees
  std::optional<double> goal_heading_rad;
  bool hold = false;
  std::optional<double> hold_radius_m;
  std::optional<std::filesystem::path> path_file;
  LoiterRequest loiter;  ///< instead of a path file, when it has a centre
  bool closed = false;
  double delta_position_m = PathMission{}.delta_position_m;
  double delta_heading_rad = PathMission{}.delta_heading_rad;
  PathAccept accept = PathAccept::follow;
};

/// The [simulate] table.
struct SimulateRequest {
  std::vector<State> states;           ///< flights to record, draw and count
  std::vector<EarthState> states_deg;  ///< further ones, on georeferenced maps
  std::uint64_t random = 200;          ///< random safe-start flights to record and draw
  std::uint64_t sample = 10'000;  ///< random safe-start flights behind the shares in the summary
  std::uint64_t seed = 1;
};

/// Where parameters of the plan come from that are not given.
enum class ParameterPreset {
  by_map,  ///< "default": some are chosen when the plan is made (choose_parameters.hpp)
  paper
};

enum class VerifyMethod { certified, bitmap, none };

/// The [verify] table.
struct VerifyRequest {
  VerifyMethod method = VerifyMethod::certified;
  RegionRequest region;
  std::uint64_t border_samples = usual_border_samples;  ///< bitmap: m, a multiple of four
  VerifyLimits limits = limits_of_a_run;
  bool ceiling = false;  ///< also find what any control could keep
};

struct Scenario {
  std::filesystem::path file;
  std::string sha256;  ///< of the file
  MapRequest map;
  bool only_connected =
      false;  ///< map.only_connected: leave out free ground not joined to the mission
  Vehicle vehicle;
  std::optional<VehicleContract> contract;  ///< [vehicle.contract], complete
  MissionRequest mission;
  ParameterPreset preset = ParameterPreset::by_map;
  FieldOptions plan;
  OpenParameters open;    ///< of `plan`: not given, and not yet chosen
  std::size_t modes = 0;  ///< plan.modes: at most so many further ones (choose_modes.hpp)
  bool improve = false;   ///< plan.improve: change commands where verdicts confirm that it helps
  SimulateRequest simulate;
  VerifyRequest verify;
  std::map<std::string, int, std::less<>> lines;  ///< line of every key that was given; 0: below
  std::map<std::string, std::string, std::less<>> options;  ///< of the command, that gave a key

  /// "FILE:LINE" of a key such as "mission.goal_m", the option that gave it ("--set"), or "FILE"
  /// when the key was not given.
  [[nodiscard]] std::string place_of(std::string_view key) const;
};

/// A value from the command line that overrides the file's; for one key the last one counts.
struct ScenarioOverride {
  std::string key;    ///< "map.cell_m"
  std::string value;  ///< as TOML writes it; a string may go without quotes
  std::string option = "--set";
};

/// Throws InputError{FILE:LINE or option, KEY ... what is expected}. The digest is the file's own.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file,
                                     std::span<const ScenarioOverride> overrides = {});

/// The same for text already in memory; `file` names it and roots its relative paths, those of
/// overrides too.
[[nodiscard]] Scenario scenario_of_text(std::string_view text, const std::filesystem::path& file,
                                        std::span<const ScenarioOverride> overrides = {});

}  // namespace fairway
