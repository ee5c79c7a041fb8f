#include "fairway/run/verification.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/version.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/verify/images.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr bool outcomes_have_the_numbers_of_their_verdicts() {
  for (const Outcome outcome : outcomes_in_order) {
    const auto verdict = static_cast<Verdict>(outcome);
    if (std::string_view(name_of(outcome)) != name_of(verdict)) return false;
  }
  return static_cast<int>(outcome_codes) <= verdict_count;
}
static_assert(outcomes_have_the_numbers_of_their_verdicts());

json options_json(const CertifyOptions& o) {
  return {
      {"undecided_max", o.undecided_max},
      {"time_limit_s", o.time_limit_s > 0.0 ? json(o.time_limit_s) : json()},
      {"memory_limit_mb",
       o.memory_limit_bytes > 0 ? json(static_cast<double>(o.memory_limit_bytes) / 1e6) : json()},
      {"samples", o.samples},
      {"seed", o.seed},
      {"last_level", o.last_level}};
}

json evidence_of(const CertifyOptions& options, const Certified& outcome) {
  json levels = json::array();
  for (const LevelRecord& level : outcome.levels) {
    levels.push_back({{"level", level.level},
                      {"leaves", level.leaves},
                      {"undecided_leaves", level.undecided},
                      {"undecided_volume", level.undecided_volume}});
  }
  json evidence = {{"program", program_version},
                   {"options", options_json(options)},
                   {"volume_fraction", shares_json(outcome.volume.all)},
                   {"volume_fraction_free", shares_json(outcome.volume.free)},
                   {"volume_fraction_buffer", shares_json(outcome.volume.buffer)},
                   {"samples", outcome.volume.samples},
                   {"worst_time_s", outcome.volume.worst_time_s},
                   {"levels", std::move(levels)},
                   {"stopped_by", name_of(outcome.stopped_by)}};
  if (outcome.volume.reach_by_mode.size() > 1) {
    evidence["reach_by_mode"] = outcome.volume.reach_by_mode;
  }
  return evidence;
}

/// Seconds of a limit that are left after `so_far_s`; 0 is no limit, so at least next to nothing.
double rest_of_limit(double limit_s, double so_far_s) {
  constexpr double next_to_nothing_s = 1e-9;
  return limit_s > 0.0 ? std::max(limit_s - so_far_s, next_to_nothing_s) : 0.0;
}

}  // namespace

Verification verify_plan(const Plan& plan, const std::string& where, const RegionOfInterest& region,
                         const CertifyOptions& options, std::optional<EarlierProof> earlier,
                         const CertifyProgress& progress) {
  if (!(plan.grid.cell_m < plan.vehicle.turn_radius_m)) {
    throw InputError(
        where, fmt::format("its cells of {} m are not smaller than the turning radius of {} m, as "
                           "verification requires",
                           length_text(plan.grid.cell_m), length_text(plan.vehicle.turn_radius_m)));
  }
  Verification made;
  made.options = options;
  Certificate& c = made.certificate;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.region_of_interest = region;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.holding = holding_cells(plan);
  c.kind = cell_kinds(plan.grid, plan.region, region);
  c.plan = plan_digests(plan);
  c.frame = plan.record.frame;
  std::vector<bool> is_free(plan.grid.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = plan.region[i] == Region::free;
  SectionVerdicts start;
  CertifyOptions rest = options;
  if (earlier) {
    const auto began = std::chrono::steady_clock::now();
    const auto so_far_s = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    };
    const auto go_on = [&] {
      return options.time_limit_s <= 0.0 || so_far_s() < options.time_limit_s;
    };
    start =
        taken_over(std::move(*earlier), c, options.most_crossings, go_on, made.resumed.emplace());
    rest.time_limit_s = rest_of_limit(options.time_limit_s, so_far_s());
  }
  made.outcome = certify(c.flow(), is_free, rest, std::move(start), progress, plan.further_rad());
  c.sections = std::move(made.outcome.sections);
  c.mode_heading_rad = plan.mode_heading_rad;
  c.mode_sections = std::move(made.outcome.further);
  c.evidence_json = evidence_of(options, made.outcome).dump();
  return made;
}

}  // namespace fairway
