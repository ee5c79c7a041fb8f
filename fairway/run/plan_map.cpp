#include "fairway/run/plan_map.hpp"

#include <utility>

#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/plan_record.hpp"

namespace fairway {
std::variant<Plan, MissionRefusal> plan_map(const ObstacleMap& map, const Vehicle& vehicle,
                                            const Mission& mission, const FieldOptions& options) {
  FieldOrRefusal answer = compute_field(map, vehicle, mission, options);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) return std::move(*refusal);
  return plan_of_field(std::move(std::get<Field>(answer)), vehicle,
                       plan_record(map, mission, options));
}

}  // namespace fairway
