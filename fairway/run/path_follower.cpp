#include "fairway/run/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/field/flyable_path.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

/// How far from the path leaves are looked for from which nothing leaves: wide enough for those
/// that overshoot when they join.
constexpr double widest_radii = 3.0;

const GoalMission* hold_of(const Plan& plan) {
  const auto* goal =
      plan.record.mission ? std::get_if<GoalMission>(&*plan.record.mission) : nullptr;
  return goal != nullptr && goal->hold ? goal : nullptr;
}

/// The line that the field follows: the path with its sharp bends cut, or the circle at a goal.
std::optional<PathMission> line_of(const Plan& plan) {
  if (const GoalMission* goal = hold_of(plan)) {
    return path_of(holding_place_at(plan.grid, goal->goal_m, plan.vehicle));
  }
  const auto* path =
      plan.record.mission ? std::get_if<PathMission>(&*plan.record.mission) : nullptr;
  if (path == nullptr || path->accept != PathAccept::follow) return {};
  return followed_line(*path, plan.vehicle.turn_radius_m);
}

/// How far the line lies from the goal at most.
double farthest_m(const PathMission& line, Vec2 goal_m) {
  double most = 0.0;
  for (const Vec2 v : line.vertices_m) most = std::max(most, norm(v - goal_m));
  return most;
}

double widest_m(const Plan& plan, const PathMission& line) {
  const double widest = widest_radii * plan.vehicle.turn_radius_m;
  const GoalMission* goal = hold_of(plan);
  if (goal == nullptr || !goal->hold_radius_m) return widest;
  return std::min(widest, *goal->hold_radius_m - farthest_m(line, goal->goal_m));
}

/// The cells about the end of an open path and beyond it, up to a turning radius away: who follows
/// comes there. They begin a cell before the end, as commands beyond it point back.
std::vector<std::uint8_t> end_cells(const Plan& plan, const PathLocator& path) {
  std::vector<std::uint8_t> is_end(plan.grid.size(), 0);
  if (path.path().closed) return is_end;
  const Vec2 end = path.place(path.length_m());
  const Vec2 before = path.place(path.length_m() - 1e-3 * plan.grid.cell_m);
  const Vec2 on = (1.0 / norm(end - before)) * (end - before);
  for (std::size_t i = 0; i < is_end.size(); ++i) {
    const Vec2 off = plan.grid.center(plan.grid.cell_at(i)) - end;
    const bool near = norm(off) <= plan.vehicle.turn_radius_m + plan.grid.cell_m;
    is_end[i] = near && dot(off, on) > -plan.grid.cell_m ? 1 : 0;
  }
  return is_end;
}

RegionOfInterest region_of(const Plan& plan, const PathLocator& path) {
  RegionOfInterest region;
  region.kind = RegionOfInterest::Kind::cells;
  region.cells = end_cells(plan, path);
  for (std::size_t i = 0; i < region.cells.size(); ++i) {
    if (plan.region[i] == Region::obstacle) region.cells[i] = 0;
  }
  return region;
}

/// Of a path nothing is claimed where no way leads to it: nobody who follows comes there. Who is
/// cut off from a goal may hold there.
Parts parts_of(const Plan& plan, const std::vector<CellKind>& kind,
               const ContractCertificate& question) {
  const Flow flow{plan.grid, plan.vehicle, plan.heading_rad.data(), kind.data()};
  Parts parts(flow, over_ground(question.contract), question.parts_per_cell);
  if (hold_of(plan) != nullptr) return parts;
  const std::vector<bool> usable = usable_cells(plan);
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (!usable[i]) parts.claim_nothing(plan.grid.cell_at(i));
  }
  return parts;
}

}  // namespace

VehicleContract nearly_exact(const Vehicle& vehicle) {
  VehicleContract contract = VehicleContract::of(vehicle);
  contract.heading_error_rad = 1e-3;
  return contract;
}

std::optional<VehicleContract> contract_to_prove(const Plan& plan, const RegionOfInterest& region) {
  if (plan.record.contract || !PathFollower::is_asked(plan, region)) return plan.record.contract;
  return nearly_exact(plan.vehicle);
}

std::vector<bool> usable_cells(const Plan& plan) {
  std::vector<bool> usable(plan.grid.size());
  for (std::size_t i = 0; i < usable.size(); ++i) {
    usable[i] = !std::isnan(plan.heading_rad[i]) && std::isfinite(plan.cost_m[i]);
  }
  return usable;
}

bool PathFollower::is_asked(const Plan& plan, const RegionOfInterest& region) {
  return region.kind == RegionOfInterest::Kind::goal && line_of(plan).has_value();
}

PathFollower::PathFollower(const Plan& plan, const ContractCertificate& question,
                           const InclusionLimits& limits)
    : path_(*line_of(plan)),
      kind_(cell_kinds(plan.grid, plan.region, region_of(plan, path_))),
      parts_(parts_of(plan, kind_, question)),
      tube_(parts_, plan.grid, path_, widest_m(plan, path_.path())),
      speed_mps_(over_ground(question.contract).speed_mps),
      prover_(parts_, tube_, [&] {
        FollowOptions options;
        options.limits = limits;
        options.laps = hold_of(plan) == nullptr;
        return options;
      }()) {
  if (const GoalMission* goal = hold_of(plan)) goal_m_ = goal->goal_m;
}

bool PathFollower::find_core() {
  found_ = prover_.find_core(speed_mps_);
  return found_.has_value();
}

bool PathFollower::join(const std::function<void(const InclusionLevel&)>& progress,
                        const ContractVerdicts* earlier) {
  return prover_.join(progress, earlier);
}

void PathFollower::fill_question(ContractCertificate& c) const {
  c.kind = kind_;
  c.region_of_interest.kind = RegionOfInterest::Kind::cells;
  c.region_of_interest.cells.assign(kind_.size(), 0);
  for (std::size_t i = 0; i < kind_.size(); ++i) {
    if (kind_[i] == CellKind::target) c.region_of_interest.cells[i] = 1;
  }
  c.follow.emplace().path = path_.path();
}

void PathFollower::fill(ContractCertificate& c) const {
  fill_question(c);
  auto [verdicts, proof] = prover_.proved(speed_mps_.least);
  c.verdicts = std::move(verdicts);
  c.follow = std::move(proof);
  c.follow->path = path_.path();
  if (!goal_m_) return;
  constexpr double rounding = 1.0 + 1e-9;
  c.follow->hold =
      HoldDisc{*goal_m_, rounding * (farthest_m(path_.path(), *goal_m_) + found_->tube_m)};
}

nlohmann::json following_json(const FollowProof& proof) {
  const TubeStretch widest = widest_of(proof.tube);
  nlohmann::json profile = nlohmann::json::array();
  const double length_m = PathLocator(proof.path).length_m();
  const double stretch_m = length_m / static_cast<double>(proof.tube.size());
  for (std::size_t k = 0; k < proof.tube.size(); ++k) {
    profile.push_back({{"station_m", static_cast<double>(k) * stretch_m},
                       {"distance_m", proof.tube[k].distance_m},
                       {"heading_rad", proof.tube[k].off_rad}});
  }
  nlohmann::json found = {{"tube_m", widest.distance_m},
                          {"tube_heading_rad", widest.off_rad},
                          {"length_m", length_m},
                          {"lap_time_s", {proof.stages.lap_least_s, proof.stages.lap_most_s}},
                          {"profile", std::move(profile)}};
  if (proof.hold) found["hold_radius_m"] = proof.hold->radius_m;
  return found;
}

std::string lap_words(const FollowProof& proof) {
  const double most_s = rounded_up(proof.stages.lap_most_s, 3);
  if (!proof.path.closed) return fmt::format("it takes at most {:g} s to its end", most_s);
  const double least_s = proof.stages.lap_least_s;
  return fmt::format("a lap takes {:g} to {:g} s", least_s > 0.0 ? rounded_down(least_s, 3) : 0.0,
                     most_s);
}

std::vector<Finding> findings(const FollowProof& proof) {
  if (proof.hold) {
    return {{"", "",
             fmt::format("who reaches the goal is within {:g} m of it for ever",
                         rounded_up(proof.hold->radius_m, 3))}};
  }
  const TubeStretch widest = widest_of(proof.tube);
  return {
      {"", "",
       fmt::format("who follows is within {:g} m of the path and heads within {:.0f} degrees "
                   "of it; {}",
                   rounded_up(static_cast<double>(widest.distance_m), 3),
                   std::ceil(static_cast<double>(widest.off_rad) * 180.0 / pi), lap_words(proof))}};
}

}  // namespace fairway
