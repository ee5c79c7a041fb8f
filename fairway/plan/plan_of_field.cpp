#include "fairway/plan/plan_of_field.hpp"

#include <utility>

namespace fairway {

Plan plan_of_field(Field&& field, const Vehicle& vehicle, PlanRecord record) {
  return {field.grid,
          vehicle,
          std::move(field.heading_rad),
          std::move(field.region),
          std::move(field.cost_m),
          std::move(record)};
}

}  // namespace fairway
