// The parameters that [plan] leaves to the preset "default": of a few, those under which most
// states get to the mission.
//
// No fixed values do on every map (docs/tuning.md): where free space is narrow a buffer of one cell
// saves twice as many states as the paper's 2 r, where it is wide the paper's saves more. So a plan
// is made with each candidate and the same states fly under all of them, exactly; that takes a
// hundredth of the time of a proof. The paper's parameters are the first of them: they are kept
// unless others bring half a per cent of all states more to the mission.
//
// Properties that always hold: the choice depends on its arguments alone, not on threads; what is
// given is kept.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Which parameters a preset may choose.
struct OpenParameters {
  bool alpha = false;
  bool sigma_cells = false;
  bool modes = false;
};

/// What is tried, the paper's first, each different; `asked` alone where nothing is open.
[[nodiscard]] std::vector<FieldOptions> candidate_options(const FieldOptions& asked,
                                                          OpenParameters open,
                                                          const Vehicle& vehicle, double cell_m);

/// Of random states on open ground that is joined to the mission, its goal excepted, flown exactly
/// under a plan. Flights that take far longer than any detour are not waited for.
struct FlownShare {
  std::size_t states = 0;
  std::size_t arrive = 0;       ///< reach; under a path mission that is to be followed, follow it
  std::size_t safe_starts = 0;  ///< of the states: free cells with a command of the mission
  std::size_t safe_arrive = 0;
  double mean_time_s = 0.0;  ///< of those that arrive, to the first cell of the mission
  [[nodiscard]] double share() const {
    return states == 0 ? 0.0 : static_cast<double>(arrive) / static_cast<double>(states);
  }
};

[[nodiscard]] FlownShare fly_all_states(const Plan& plan, std::size_t count, std::uint64_t seed);

/// Parameters that were tried; nothing flew where the map does not allow the mission with them.
struct TriedParameters {
  FieldOptions options;
  std::optional<FlownShare> flown;
};

struct ChosenParameters {
  FieldOptions options;
  std::vector<TriedParameters> tried;  ///< empty when there was nothing to choose
};

/// The candidate under which most of the sampled states arrive, the first one with an advance. If
/// the map allows the mission with none of them, the one of the narrowest buffer, whose refusal
/// says most.
[[nodiscard]] ChosenParameters choose_parameters(const ObstacleMap& map, const Vehicle& vehicle,
                                                 const Mission& mission,
                                                 const std::vector<FieldOptions>& candidates);

/// [{"alpha": 2.0, "sigma_cells": 1.0, "flown_share": 0.91}, ...]; a share is null where the map
/// does not allow the mission.
[[nodiscard]] nlohmann::json tried_json(const std::vector<TriedParameters>& tried);

}  // namespace fairway
