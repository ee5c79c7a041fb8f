#include "fairway/run/proved_following.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/field/flyable_path.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

/// How far from the path leaves are looked for from which nothing leaves: wide enough for those
/// that overshoot when they join.
constexpr double widest_radii = 3.0;

/// Coarser ones mix the commands of both sides of the line.
constexpr int fewest_parts = 2;

/// The path's cells end nothing. Cells without a command, cut off from the path, are taken as
/// obstacles: nobody who follows comes there, and states in them are none that the mission can use.
std::vector<CellKind> flown_over(const Plan& plan) {
  std::vector<CellKind> kind = cell_kinds(plan.grid, plan.region, RegionOfInterest{});
  for (std::size_t i = 0; i < kind.size(); ++i) {
    if (kind[i] == CellKind::obstacle) continue;
    kind[i] = std::isnan(plan.heading_rad[i]) ? CellKind::obstacle : CellKind::ordinary;
  }
  return kind;
}

double share_of(const std::array<double, verdict_count>& shares, Verdict verdict) {
  return shares[static_cast<std::size_t>(verdict)];
}

}  // namespace

std::optional<ProvedFollowing> prove_following(
    const Plan& plan, const VehicleContract& contract, int parts_per_cell,
    const SurveyOptions& sampled, const std::function<bool()>& go_on,
    const std::function<void(const std::string& doing)>& progress) {
  if (!plan.record.mission) return {};
  const auto* mission = std::get_if<PathMission>(&*plan.record.mission);
  if (mission == nullptr || !mission->closed) return {};
  progress("proving that the path is followed");
  const std::vector<CellKind> kind = flown_over(plan);
  const Flow flow{plan.grid, plan.vehicle, plan.heading_rad.data(), kind.data()};
  const Parts parts(flow, contract, std::max(parts_per_cell, fewest_parts));
  // The line that the field follows: corners sharper than the vehicle turns are cut.
  const PathLocator path(flyable_path(*mission, plan.vehicle.turn_radius_m));
  const Tube tube(parts, plan.grid, path, widest_radii * plan.vehicle.turn_radius_m);
  FollowOptions options;
  options.limits.go_on = go_on;
  FollowProver prover(parts, tube, options);
  ProvedFollowing made;
  made.length_m = path.length_m();
  made.found = prover.find_core(contract.speed_mps);
  if (!made.found) {
    made.stopped_by_limit = !go_on();
    return made;
  }
  made.stopped_by_limit = !prover.join([](const InclusionLevel&) {});
  std::vector<bool> is_free(plan.grid.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = plan.region[i] != Region::buffer;
  made.shares = survey(flow, is_free, parts, prover.joining().verdicts(contract.speed_mps.least),
                       prover.joining(), contract.speed_mps.least, sampled, {})
                    .shares;
  return made;
}

nlohmann::json following_json(const ProvedFollowing& f) {
  if (!f.found) return {{"proved", false}, {"stopped_by", f.stopped_by_limit ? "limit" : "done"}};
  nlohmann::json profile = nlohmann::json::array();
  const double stretch_m = f.length_m / static_cast<double>(f.found->tube.size());
  for (std::size_t k = 0; k < f.found->tube.size(); ++k) {
    const TubeStretch& s = f.found->tube[k];
    profile.push_back({{"station_m", static_cast<double>(k) * stretch_m},
                       {"distance_m", s.distance_m},
                       {"heading_rad", s.off_rad}});
  }
  return {{"proved", true},
          {"volume_fraction", share_of(f.shares.all, Verdict::reach)},
          {"volume_fraction_free", share_of(f.shares.free, Verdict::reach)},
          {"samples", f.shares.samples},
          {"worst_time_s", f.shares.worst_time_s},
          {"tube_m", f.found->tube_m},
          {"tube_heading_rad", f.found->off_rad},
          {"lap_time_s", {f.found->lap_least_s, f.found->lap_most_s}},
          {"profile", std::move(profile)},
          {"stopped_by", f.stopped_by_limit ? "limit" : "done"}};
}

std::vector<Finding> findings(const ProvedFollowing& f) {
  if (!f.found) {
    return {{"", "", "no tube about the path is proved that the vehicle never leaves"}};
  }
  const int decimals = decimals_of_sample(f.shares.samples);
  return {
      {percent_text(share_of(f.shares.all, Verdict::reach), decimals),
       "states with a way to the path", "are proved to join the path and to follow it for ever"},
      {percent_text(share_of(f.shares.free, Verdict::reach), decimals), "safe starts among them",
       "are proved to join the path and to follow it for ever"},
      {"", "",
       fmt::format("who follows is within {:.3g} m of the path, heads within {:.0f} degrees of "
                   "it, and goes round in {:.3g} to {:.3g} s",
                   f.found->tube_m, f.found->off_rad * 180.0 / pi, f.found->lap_least_s,
                   f.found->lap_most_s)}};
}

}  // namespace fairway
