// Replans for another mission on the plan's own grid, without the map's files.
//
// Properties that always hold:
//   1. With the plan's own mission the answer is the plan, bit for bit, when this program made it
//      and its commands are the field's: of a map the field takes no more than its obstacle cells,
//      and a plan has those. Commands that were improved are not improved again,
//      and there are no further modes.
//   2. Vehicle, options and inputs are the plan's; the record names the new mission.
// Cost: that of the field, about 0.2 microseconds per cell and core.
#pragma once

#include <string>
#include <variant>

#include "fairway/field/field.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// The options that a plan was made with. Throws InputError{where, ...} when its record names none,
/// or one that this version does not have.
[[nodiscard]] FieldOptions field_options_of(const PlanRecord& record, const std::string& where);

/// `options`: of the plan, by field_options_of(). Throws PreconditionViolation as compute_field
/// does.
[[nodiscard]] std::variant<Plan, MissionRefusal> replan(const Plan& plan, const Mission& mission,
                                                        const FieldOptions& options);

}  // namespace fairway
