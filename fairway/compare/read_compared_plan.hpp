// A plan to be compared from a run's folder, a plan's file or a scenario; proved, if it is not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fairway/compare/compared_plan.hpp"
#include "fairway/run/stage_clock.hpp"

namespace fairway {

/// The plan alone. Throws InputError when nothing of the kind is there, or no plan can be made.
[[nodiscard]] ComparedPlan read_compared_plan(const std::filesystem::path& from, StageClock& clock);

struct ProveComparedOptions {
  double time_limit_s = 60.0;  ///< for each proof that has to be made
  std::uint64_t seed = 1;
};

/// Adds what is proved of it: certificates beside the plan (certificate.safetensors,
/// contract.certificate.safetensors and, of PLAN.safetensors, PLAN.certificate.safetensors) as far
/// as they are of this plan, its goal and its contract; what lacks is proved. Throws InputError for
/// a damaged certificate, or when the plan cannot be proved.
void prove_compared_plan(const ProveComparedOptions& options, StageClock& clock,
                         ComparedPlan& plan);

/// Gives each a name that tells it from the others: the last part of where it is from, or all of
/// it, with its number if even that is the same.
void name_apart(std::vector<ComparedPlan>& plans);

}  // namespace fairway
