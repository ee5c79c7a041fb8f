// field -> plan.
#pragma once

#include "fairway/field/field.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// The field becomes a plan; its arrays move. Commands closer to 0 than a plan allows become 0.
[[nodiscard]] Plan plan_of_field(Field&& field, const Vehicle& vehicle, PlanRecord record = {});

}  // namespace fairway
