#include "fairway/run/scenario_keys.hpp"

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "fairway/run/contract_keys.hpp"
#include "fairway/run/region_key.hpp"
#include "fairway/run/scenario_key_kinds.hpp"
#include "fairway/run/scenario_values.hpp"
#include "fairway/vehicle/modes.hpp"

namespace fairway {
namespace {

using nlohmann::json;

ScenarioKey required(ScenarioKey made) {
  made.required = true;
  return made;
}

/// Not shown while it is open what it will be.
ScenarioKey unless(bool OpenParameters::*is_open, ScenarioKey made) {
  made.shown = [is_open, shown = std::move(made.shown)](const Scenario& s) {
    return s.open.*is_open ? json() : shown(s);
  };
  return made;
}

constexpr Range any_finite{};
constexpr Range positive{0.0, 1e9, true};
constexpr Range not_negative{0.0, 1e9, false};
constexpr Range share{0.0, 1.0, true};
constexpr Range factor{0.0, 1000.0, true};
constexpr Range width{0.0, 1000.0, false};
constexpr Range metres{-1e9, 1e9, false};
constexpr Range degrees{-180.0, 180.0, false};
constexpr Range turn_degrees{-360.0, 360.0, false};

// Members of const and mutable scenarios alike.
// NOLINTBEGIN(bugprone-macro-parentheses): a member's name cannot stand in parentheses
#define FAIRWAY_MEMBER(path) \
  [](auto& s) -> auto& { return s.path; }
// NOLINTEND(bugprone-macro-parentheses)

std::vector<ScenarioKey> map_keys() {
  return {
      required(key("map.file", "file", any_finite, FAIRWAY_MEMBER(map.file), map_kinds_text())),
      required(number("map.cell_m", positive, FAIRWAY_MEMBER(map.cell_m),
                      "side of a plan cell, metres; less than the turning radius")),
      number("map.resolution_m", positive, FAIRWAY_MEMBER(map.resolution_m),
             "metres per pixel, only for maps without a scale of their own; their lower-left "
             "corner is at (0, 0)"),
      choice<std::optional<Inclusion>>("map.inclusion",
                                       {{"all", Inclusion::all}, {"any", Inclusion::any}},
                                       FAIRWAY_MEMBER(map.inclusion),
                                       "stay inside all of several keep-in fences, or inside any "
                                       "one; required when there are several"),
      choice<bool>("map.unknown", {{"obstacle", true}, {"free", false}},
                   FAIRWAY_MEMBER(map.unknown_is_obstacle), "how unknown map cells are treated"),
      choice<bool>("map.outside", {{"obstacle", true}, {"free", false}},
                   FAIRWAY_MEMBER(map.outside_is_obstacle),
                   "the world beyond the map: a ring of obstacle cells, or free to leave"),
      key("map.only_connected", "true or false", any_finite, FAIRWAY_MEMBER(only_connected),
          "leave out free ground that is not connected to the goal or path: it becomes an obstacle "
          "and no share counts it"),
      number("map.footprint_radius_m", not_negative, FAIRWAY_MEMBER(map.footprint_radius_m),
             "obstacles grow by this, metres"),
      key("map.reference_deg", "[latitude, longitude]", degrees, FAIRWAY_MEMBER(map.reference),
          "maps in degrees: origin of the metric frame; by default the file's home position, else "
          "the middle of the map"),
      number("map.altitude_m", metres, FAIRWAY_MEMBER(map.altitude_m),
             "elevation maps: flight altitude; higher ground is an obstacle"),
      number("map.margin_m", not_negative, FAIRWAY_MEMBER(map.margin_m),
             "elevation maps: required clearance above the ground, metres"),
      number(
          "map.world_margin_m", not_negative, FAIRWAY_MEMBER(map.world_margin_m),
          "free room around obstacles and mission when no keep-in fence bounds the world; "
          "without it a tenth of the longer side, at least ten cells, and at least the room for a "
          "goal or a turn and its buffer: (alpha + the larger of beta and 2) turning radii and "
          "two cells"),
  };
}

std::vector<ScenarioKey> vehicle_keys() {
  return {
      required(number("vehicle.speed_mps", positive, FAIRWAY_MEMBER(vehicle.speed_mps),
                      "constant speed, metres per second")),
      required(number("vehicle.turn_radius_m", positive, FAIRWAY_MEMBER(vehicle.turn_radius_m),
                      "smallest turning radius, metres; more than `map.cell_m`")),
  };
}

std::vector<ScenarioKey> mission_keys() {
  return {
      required(choice<MissionKind>(
          "mission.kind", {{"goal", MissionKind::goal}, {"path", MissionKind::path}},
          FAIRWAY_MEMBER(mission.kind), "reach a place, or follow a path")),
      key("mission.goal_m", "[x, y]", metres, FAIRWAY_MEMBER(mission.goal_m),
          "goal missions: the goal's position, metres in the map's frame"),
      key("mission.goal_deg", "[latitude, longitude]", degrees, FAIRWAY_MEMBER(mission.goal_deg),
          "goal missions on georeferenced maps: the goal's position, instead of `mission.goal_m`"),
      key("mission.hold", "true or false", any_finite, FAIRWAY_MEMBER(mission.hold),
          "goal missions: stay at the goal, circling about it for ever"),
      number("mission.hold_radius_m", positive, FAIRWAY_MEMBER(mission.hold_radius_m),
             "with `mission.hold`: stay within this of the goal, metres; by default within the "
             "least that can be proved"),
      number("mission.goal_heading_rad", Range{-7.0, 7.0}, FAIRWAY_MEMBER(mission.goal_heading_rad),
             "goal missions: heading on arrival, radians counter-clockwise from east; steering "
             "takes over where a flight enters the goal"),
      key("mission.path_file", "file", any_finite, FAIRWAY_MEMBER(mission.path_file),
          "path missions: CSV with x_m,y_m, GeoJSON LineString, QGC waypoints or .plan"),
      key("mission.loiter.center_m", "[x, y]", metres, FAIRWAY_MEMBER(mission.loiter.center_m),
          "path missions: centre of a circle to fly round and round, instead of "
          "`mission.path_file`; metres in the map's frame"),
      number("mission.loiter.radius_m", positive, FAIRWAY_MEMBER(mission.loiter.radius_m),
             "path missions: radius of that circle, metres; at least `vehicle.turn_radius_m`"),
      choice<LoiterDirection>("mission.loiter.direction",
                              {{"left", LoiterDirection::left}, {"right", LoiterDirection::right}},
                              FAIRWAY_MEMBER(mission.loiter.direction),
                              "path missions: which way that circle turns"),
      key("mission.closed", "true or false", any_finite, FAIRWAY_MEMBER(mission.closed),
          "path missions: the last vertex joins the first"),
      number("mission.delta_position_m", positive, FAIRWAY_MEMBER(mission.delta_position_m),
             "path missions: closer than this to the path counts as on it (Eq. 5)"),
      number("mission.delta_heading_rad", Range{0.0, pi, true},
             FAIRWAY_MEMBER(mission.delta_heading_rad),
             "path missions: heading within this of the path's counts as along it (Eq. 5)"),
      choice<PathAccept>("mission.accept",
                         {{"follow", PathAccept::follow}, {"touch", PathAccept::touch}},
                         FAIRWAY_MEMBER(mission.accept),
                         "path missions: what is to be proved, that the vehicle joins the path and "
                         "follows it, or only that it touches it"),
  };
}

std::vector<ScenarioKey> plan_keys() {
  return {
      choice<ParameterPreset>(
          "plan.preset", {{"default", ParameterPreset::by_map}, {"paper", ParameterPreset::paper}},
          FAIRWAY_MEMBER(preset),
          "parameters that are not given: `alpha` and `sigma_cells` chosen for the map by flights "
          "under a few plans, or the paper's, 2 and 1; with a contract always the paper's"),
      unless(&OpenParameters::alpha,
             number("plan.alpha", factor, FAIRWAY_MEMBER(plan.alpha),
                    "buffer width / turning radius (Eq. 3; the paper: at least 2); by default as "
                    "`plan.preset` says")),
      number("plan.beta", factor, FAIRWAY_MEMBER(plan.beta),
             "goal radius / turning radius (Eq. 4; the paper: at least 2)"),
      choice<Metric>(
          "plan.metric",
          {{"euclidean", Metric::euclidean}, {"octile", Metric::octile}, {"paper", Metric::paper}},
          FAIRWAY_MEMBER(plan.metric),
          "how distances are measured: exactly, along eight directions, or exactly as in the "
          "paper's Algorithms 1 and 2"),
      unless(&OpenParameters::sigma_cells,
             number("plan.sigma_cells", width, FAIRWAY_MEMBER(plan.sigma_cells),
                    "standard deviation of the Gaussian filter, cells (Eqs. 19-21); 0: no filter; "
                    "by default as `plan.preset` says")),
      number("plan.mu_path", share, FAIRWAY_MEMBER(plan.mu_path),
             "how slowly the field turns parallel to a path near it: the smaller, the sooner "
             "(Eq. 16)"),
      number("plan.sigma_path", width, FAIRWAY_MEMBER(plan.sigma_path),
             "width of the transition at a path / turning radius; 0: none (the paper: 1 to 2)"),
      number(
          "plan.mu_border", share, FAIRWAY_MEMBER(plan.mu_border),
          "the same at a buffer's border, on both of its sides: the field there turns towards the "
          "border's own, mostly along it (Eq. 16)"),
      number(
          "plan.sigma_border", width, FAIRWAY_MEMBER(plan.sigma_border),
          "width of the transition at a buffer's border / turning radius; 0: none (the paper: 1 to "
          "2)"),
      choice<Filter>("plan.filter", {{"free_space", Filter::free_space}, {"paper", Filter::paper}},
                     FAIRWAY_MEMBER(plan.filter),
                     "what the filter averages: never through obstacles, or every cell as printed"),
      choice<Blend>("plan.blend", {{"paper", Blend::paper}, {"continuous", Blend::continuous}},
                    FAIRWAY_MEMBER(plan.blend),
                    "how a transition begins: with a jump as printed (Eq. 16), or without"),
      choice<PathField>("plan.path_field",
                        {{"follow", PathField::follow}, {"paper", PathField::paper}},
                        FAIRWAY_MEMBER(plan.path_field),
                        "path missions: commands that approach the line on circles and run along "
                        "it, or the paper's, which point at the line until next to it"),
      choice<FallbackRule>(
          "plan.fallback", {{"hold", FallbackRule::hold}, {"none", FallbackRule::none}},
          FAIRWAY_MEMBER(plan.fallback),
          "what places get from which the mission is out of reach: commands to a circle on which "
          "the vehicle waits, wherever one fits, or none, as in the paper"),
      number(
          "plan.axis_capture_rad", Range{0.0, 0.1}, FAIRWAY_MEMBER(plan.axis_capture_rad),
          "commands this close to a grid axis are snapped to it, so that vehicles do not weave "
          "along a border in tiny hops between opposing commands; not used with metric \"paper\""),
      unless(&OpenParameters::modes,
             whole("plan.modes", Range{0.0, most_modes - 1.0}, FAIRWAY_MEMBER(modes),
                   "at most so many further fields, for states that the plan alone does not bring; "
                   "not given: up to 16 for a goal, on at most 100,000 open cells, where they "
                   "bring 2 % of all states, but none with preset \"paper\" or a contract")),
      key("plan.improve", "true or false", any_finite, FAIRWAY_MEMBER(improve),
          "change commands cell by cell where verdicts confirm that more states then arrive; takes "
          "much longer than the plan itself"),
  };
}

std::vector<ScenarioKey> simulate_and_verify_keys() {
  return {
      key("simulate.states", "[[x, y, heading], ...]", metres, FAIRWAY_MEMBER(simulate.states),
          "flights to record and draw, metres and radians (from -7 to 7)"),
      key("simulate.states_deg", "[[latitude, longitude, course], ...]", turn_degrees,
          FAIRWAY_MEMBER(simulate.states_deg),
          "further flights on georeferenced maps; the course is in degrees clockwise from north"),
      whole("simulate.random", Range{0.0, 1e5}, FAIRWAY_MEMBER(simulate.random),
            "further flights to record and draw, from random safe starts with a command"),
      whole(
          "simulate.sample", Range{0.0, 1e7}, FAIRWAY_MEMBER(simulate.sample),
          "random flights, from safe starts with a command, behind the shares in the summary; the "
          "first of them are those of `simulate.random`"),
      whole("simulate.seed", Range{0.0, 9.0e15}, FAIRWAY_MEMBER(simulate.seed), "random seed"),
      choice<VerifyMethod>(
          "verify.method",
          {{"certified", VerifyMethod::certified},
           {"bitmap", VerifyMethod::bitmap},
           {"none", VerifyMethod::none}},
          FAIRWAY_MEMBER(verify.method),
          "a proof for every state; the paper's samples of the borders (a picture); or nothing"),
      key("verify.region", "\"goal\", \"obstacle\", [x0, y0, x1, y1] or file", metres,
          FAIRWAY_MEMBER(verify.region),
          "region to be reached: the goal, obstacles, the cells wholly inside a rectangle, or "
          "those of a file (GeoJSON areas, or CSV ix,iy)"),
      whole("verify.border_samples", Range{least_border_samples, most_border_samples},
            FAIRWAY_MEMBER(verify.border_samples),
            "method \"bitmap\": number of places and of headings sampled on each border, a "
            "multiple of four"),
      number("verify.undecided_max", Range{0.0, 1.0}, FAIRWAY_MEMBER(verify.limits.undecided_max),
             "stop refining once at most this share of the volume is undecided"),
      number("verify.time_limit_s", Range{0.0, 1e9}, FAIRWAY_MEMBER(verify.limits.time_limit_s),
             "stop refining after this time, seconds; 0: no limit"),
      number("verify.memory_limit_mb", positive, FAIRWAY_MEMBER(verify.limits.memory_limit_mb),
             "stop refining before using more memory than this, megabytes"),
      key("verify.ceiling", "true or false", any_finite, FAIRWAY_MEMBER(verify.ceiling),
          "method \"certified\": also bound what any control could keep, and tell what share of it "
          "the plan keeps; the limits hold for it, too"),
  };
}

#undef FAIRWAY_MEMBER

}  // namespace

const std::vector<ScenarioKey>& scenario_keys() {
  static const std::vector<ScenarioKey> all = [] {
    std::vector<ScenarioKey> keys;
    for (auto part : {map_keys(), vehicle_keys(), contract_keys(), mission_keys(), plan_keys(),
                      simulate_and_verify_keys()}) {
      for (ScenarioKey& one : part) keys.push_back(std::move(one));
    }
    return keys;
  }();
  return all;
}

std::string scenario_keys_markdown() {
  std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
  Scenario defaults;
  defaults.open = {true, true, true};
  for (const ScenarioKey& k : scenario_keys()) {
    const json value = k.shown(defaults);
    const std::string fallback = k.required        ? "required"
                                 : value.is_null() ? "none"
                                                   : "`" + value.dump() + "`";
    text += fmt::format("| `{}` | {} | {} | {} |\n", k.name, k.kind, fallback, k.meaning);
  }
  return text;
}

json effective_values(const Scenario& scenario, std::string_view table) {
  json values = json::object();
  for (const ScenarioKey& k : scenario_keys()) {
    if (k.table() == table) values[k.leaf()] = k.shown(scenario);
  }
  // Records name what a preset stands for, not the preset.
  if (table == "plan") values.erase("preset");
  // Goals have no path, and their records never named its field.
  if (table == "plan" && scenario.mission.kind == MissionKind::goal) values.erase("path_field");
  // Records name only what they named before there was a choice, and what was chosen.
  if (table == "plan" && scenario.plan.fallback == FallbackRule::hold) values.erase("fallback");
  if (table == "plan" && !scenario.improve) values.erase("improve");
  if (table == "plan" && scenario.modes == 0) values.erase("modes");
  if (table == "mission" && !scenario.mission.hold) {
    values.erase("hold");
    values.erase("hold_radius_m");
  }
  if (table == "mission" && scenario.mission.loiter.center_m)
    values["loiter"] = effective_values(scenario, "mission.loiter");
  if (table == "vehicle" && scenario.contract) {
    values["contract"] = effective_values(scenario, contract_table);
  }
  return values;
}

}  // namespace fairway
