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
  return {{"program", program_version},
          {"options", options_json(options)},
          {"volume_fraction", shares_json(outcome.volume.all)},
          {"volume_fraction_free", shares_json(outcome.volume.free)},
          {"volume_fraction_buffer", shares_json(outcome.volume.buffer)},
          {"samples", outcome.volume.samples},
          {"worst_time_s", outcome.volume.worst_time_s},
          {"levels", std::move(levels)},
          {"stopped_by", name_of(outcome.stopped_by)}};
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
        where,
        fmt::format("its cells of {} m are not smaller than the turning radius, {} m: such a "
                    "plan cannot be verified",
                    length_text(plan.grid.cell_m), length_text(plan.vehicle.turn_radius_m)));
  }
  Verification made;
  Certificate& c = made.certificate;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.region_of_interest = region;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
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
  made.outcome = certify(c.flow(), is_free, rest, std::move(start), progress);
  c.sections = std::move(made.outcome.sections);
  c.evidence_json = evidence_of(options, made.outcome).dump();
  return made;
}

std::vector<FailingState> failing_states(const Certificate& certificate, std::size_t of_each,
                                         std::uint64_t seed) {
  const Flow flow = certificate.flow();
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < flow.grid.size(); ++i) {
    if (flow.kind[i] == CellKind::ordinary) cells.push_back(i);
  }
  if (cells.empty()) return {};
  constexpr std::size_t draws = 200'000;
  std::vector<Place> states(draws);
  for (std::size_t k = 0; k < draws; ++k) {
    Random random = Random::stream(seed, k);
    const Cell cell = certificate.grid.cell_at(cells[random.below(cells.size())]);
    const Vec2 corner = certificate.grid.corner(cell);
    states[k] = {corner.x + random.unit() * flow.grid.cell_m,
                 corner.y + random.unit() * flow.grid.cell_m, random.uniform(-pi, pi)};
  }
  const ImageStore images = state_images(flow, states, usual_most_crossings, [] { return true; });
  std::array<std::vector<FailingState>, verdict_count> found;
  for (std::size_t k = 0; k < draws; ++k) {
    const Verdict verdict = verdicts_of(images[k], certificate.sections.view()).only();
    auto& alike = found[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::reach || alike.size() == of_each) continue;
    const Place& p = states[k];
    alike.push_back({{{p.x_m, p.y_m}, Heading::from_rad(p.heading_rad)}, verdict});
  }
  std::vector<FailingState> failing;
  for (const Verdict verdict : verdicts_in_order) {
    const auto& alike = found[static_cast<std::size_t>(verdict)];
    failing.insert(failing.end(), alike.begin(), alike.end());
  }
  return failing;
}

std::string failing_states_csv(const std::vector<FailingState>& states) {
  std::string text = "x_m,y_m,heading_rad,verdict\n";
  for (const FailingState& state : states) {
    const Vec2 p = state.start.position_m;
    text +=
        fmt::format("{},{},{},{}\n", p.x, p.y, state.start.heading.rad(), name_of(state.verdict));
  }
  return text;
}

}  // namespace fairway
