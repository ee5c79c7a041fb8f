#include "fairway/plan/plan_of_field.hpp"

#include <cmath>
#include <utility>

namespace fairway {

Plan plan_of_field(Field&& field, const Vehicle& vehicle, PlanRecord record) {
  // A command closer to 0 than a plan allows is put on its axis.
  for (float& heading_rad : field.heading_rad) {
    if (heading_rad != 0.0F && std::abs(heading_rad) < 0x1p-52F) heading_rad = 0.0F;
  }
  record.holding_places = std::move(field.holding_places);
  return {field.grid,
          vehicle,
          std::move(field.heading_rad),
          std::move(field.region),
          std::move(field.cost_m),
          {},
          std::move(record)};
}

}  // namespace fairway
