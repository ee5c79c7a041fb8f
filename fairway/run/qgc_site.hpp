// The fence, rally points and home altitude that a plan's map came with, for missions exported from
// the plan: uploading a .plan replaces all of them on the vehicle.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fairway/exchange/qgc_mission.hpp"
#include "fairway/plan/plan_record.hpp"

namespace fairway {

/// Those of a QGroundControl .plan. Throws InputError when it cannot be read or is not one.
[[nodiscard]] QgcSite qgc_site_of(const std::filesystem::path& file);

/// The same of the .plan that a plan's map was read from; none when the record names none, or when
/// none of its digest is found: relative to `folder`, where the plan file lies, to the two folders
/// above it, or to the working folder.
[[nodiscard]] std::optional<QgcSite> qgc_site_of(const PlanRecord& record,
                                                 const std::filesystem::path& folder);

/// A sentence on what a mission without a site lacks; it names the map's .plan if there is one.
/// `option`: the caller's name for the option that gives one.
[[nodiscard]] std::string no_fence_warning(const PlanRecord& record, const std::string& option);

}  // namespace fairway
