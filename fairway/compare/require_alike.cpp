#include "fairway/compare/require_alike.hpp"

#include <algorithm>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/map/region.hpp"

namespace fairway {
namespace {

std::string frame_words(const Frame& f) {
  if (f.geo) {
    return fmt::format("about latitude {:g}, longitude {:g}", f.geo->latitude_deg,
                       f.geo->longitude_deg);
  }
  const WorldFromGrid& w = f.world_from_grid;
  return fmt::format("{}with its origin at ({:g}, {:g}), turned by {:g} rad",
                     f.projected_crs ? "on Earth, " : "", w.x_m, w.y_m, w.yaw_rad);
}

std::string mission_words(const Mission& mission) {
  if (const auto* goal = std::get_if<GoalMission>(&mission)) {
    return fmt::format(
        "{} at {}{}", goal->hold ? "to stay" : "the goal", place_text(goal->goal_m),
        goal->hold_radius_m ? fmt::format(" within {:g} m", *goal->hold_radius_m) : "");
  }
  const auto& path = std::get<PathMission>(mission);
  return fmt::format("{} {} path of {} from {}, within {:g} m and {:g} rad",
                     path.accept == PathAccept::follow ? "to follow" : "to touch",
                     path.closed ? "a closed" : "an open", plural(path.vertices_m.size(), "point"),
                     place_text(path.vertices_m.front()), path.delta_position_m,
                     path.delta_heading_rad);
}

/// Goals with other headings are alike: what comes after reaching is not compared.
bool same_mission(const Mission& a, const Mission& b) {
  const auto* goal = std::get_if<GoalMission>(&a);
  const auto* other = std::get_if<GoalMission>(&b);
  if (goal == nullptr || other == nullptr) return a == b;
  return goal->goal_m == other->goal_m && goal->hold == other->hold &&
         goal->hold_radius_m == other->hold_radius_m;
}

/// The digests of its input files, but for the scenario's, which differs where anything does.
std::set<std::string> map_digests(const Plan& plan) {
  std::set<std::string> digests;
  if (!plan.record.inputs) return digests;
  for (const InputFile& input : *plan.record.inputs) {
    if (!input.path.ends_with(".toml")) digests.insert(input.sha256);
  }
  return digests;
}

void require_same_frame(const ComparedPlan& first, const ComparedPlan& plan) {
  const Frame a = frame_in(first.plan.record);
  const Frame b = frame_in(plan.plan.record);
  const auto same_place = [](const std::optional<GeoReference>& p,
                             const std::optional<GeoReference>& q) {
    return p.has_value() == q.has_value() &&
           (!p || (p->latitude_deg == q->latitude_deg && p->longitude_deg == q->longitude_deg));
  };
  if (a.world_from_grid == b.world_from_grid && same_place(a.geo, b.geo) &&
      a.projected_crs == b.projected_crs) {
    return;
  }
  throw InputError(
      plan.from.string(),
      fmt::format(
          "its frame lies {}; that of {} {}{}: only plans in one frame can be "
          "compared",
          frame_words(b), first.from.string(), frame_words(a),
          a.projected_crs != b.projected_crs ? ", in another coordinate reference system" : ""));
}

void require_same_mission(const ComparedPlan& first, const ComparedPlan& plan) {
  const auto& a = first.plan.record.mission;
  const auto& b = plan.plan.record.mission;
  if (a.has_value() != b.has_value()) {
    const ComparedPlan& silent = a ? plan : first;
    throw InputError(silent.from.string(),
                     fmt::format("does not say its mission, while {} does: only plans of one "
                                 "mission can be compared",
                                 (a ? first : plan).from.string()));
  }
  if (!a || same_mission(*a, *b)) return;
  throw InputError(plan.from.string(),
                   fmt::format("its mission is {}; that of {} is {}: only plans of one mission can "
                               "be compared",
                               mission_words(*b), first.from.string(), mission_words(*a)));
}

void require_same_ground(const ComparedPlan& first, const ComparedPlan& plan) {
  const Grid& a = first.plan.grid;
  const Grid& b = plan.plan.grid;
  if (a == b) return;
  const bool overlap = a.x0_m < b.x0_m + b.width_m() && b.x0_m < a.x0_m + a.width_m() &&
                       a.y0_m < b.y0_m + b.height_m() && b.y0_m < a.y0_m + a.height_m();
  if (!overlap) {
    throw InputError(plan.from.string(),
                     fmt::format("its grid does not overlap that of {}", first.from.string()));
  }
  if (map_digests(first.plan) == map_digests(plan.plan)) return;
  throw InputError(
      plan.from.string(),
      fmt::format(
          "has cells of {} m and another map than {}, with cells of {} m: only plans of one "
          "map can be compared over different cells",
          length_text(b.cell_m), first.from.string(), length_text(a.cell_m)));
}

/// What differs, as a sentence, or nothing.
void tell_differences(const ComparedPlan& first, const ComparedPlan& plan,
                      std::vector<std::string>& told) {
  const Plan& a = first.plan;
  const Plan& b = plan.plan;
  const auto tell = [&](const std::string& what) {
    told.push_back(fmt::format("{} and {} {}.", first.name, plan.name, what));
  };
  if (a.vehicle != b.vehicle) {
    tell(
        fmt::format("are for different vehicles: {:g} m/s and turns of {:g} m, {:g} m/s and turns "
                    "of {:g} m",
                    a.vehicle.speed_mps, a.vehicle.turn_radius_m, b.vehicle.speed_mps,
                    b.vehicle.turn_radius_m));
  }
  if (a.record.contract != b.record.contract) tell("are under different contracts");
  if (a.grid != b.grid) {
    tell(fmt::format("have different cells, of {} and {} m: compared where both are free",
                     length_text(a.grid.cell_m), length_text(b.grid.cell_m)));
    return;
  }
  std::size_t obstacles = 0;
  std::size_t goals = 0;
  for (std::size_t i = 0; i < a.region.size(); ++i) {
    const auto differ = [&](Region what) { return (a.region[i] == what) != (b.region[i] == what); };
    obstacles += differ(Region::obstacle) ? 1 : 0;
    goals += differ(Region::goal) ? 1 : 0;
  }
  if (obstacles > 0) {
    tell(fmt::format("have different obstacles, in {} of {}: compared where both are free",
                     grouped(obstacles), plural(a.region.size(), "cell")));
  } else if (goals > 0) {
    tell(
        fmt::format("differ in {} of the goal: compared outside both, and times and lengths are "
                    "to each one's own",
                    plural(goals, "cell")));
  }
}

}  // namespace

std::vector<std::string> require_alike(std::span<const ComparedPlan> plans) {
  std::vector<std::string> told;
  for (std::size_t i = 1; i < plans.size(); ++i) {
    require_same_frame(plans[0], plans[i]);
    require_same_mission(plans[0], plans[i]);
    require_same_ground(plans[0], plans[i]);
    tell_differences(plans[0], plans[i], told);
  }
  return told;
}

}  // namespace fairway
