#include "fairway/run/new_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/field/goal_advice.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/run/map_survey.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

constexpr int cells_across = 200;

/// A vehicle and a goal that fits.
struct Candidate {
  double cell_m = 0.0;
  double turn_radius_m = 0.0;
  GoalPlace goal;
  Frame frame;
  double share = 0.0;  ///< of the cells that are not obstacles: free, and in the goal's part
};

double two_digits(double value) { return std::stod(fmt::format("{:.2g}", value)); }

std::optional<Candidate> candidate(const NewScenarioRequest& request, double cell_m,
                                   double turn_radius_m) {
  const FieldOptions options;
  MapRequest map = request.map;
  map.cell_m = cell_m;
  map.least_world_margin_m =
      (options.alpha + std::max(options.beta, 2.0)) * turn_radius_m + 2.0 * cell_m;
  const MapSurvey survey = survey_map(map, turn_radius_m);
  const Vehicle vehicle{1.0, turn_radius_m};
  const auto goal = roomiest_goal(survey.map, survey.region, vehicle, options);
  if (!goal) return std::nullopt;
  const auto open = std::count_if(survey.region.begin(), survey.region.end(),
                                  [](Region r) { return r != Region::obstacle; });
  return Candidate{
      cell_m, turn_radius_m, *goal, survey.map.frame,
      goal->serves * static_cast<double>(survey.free_cells) / static_cast<double>(open)};
}

/// The widest turns first.
std::vector<Candidate> candidates(const NewScenarioRequest& request, double cell_m) {
  std::vector<Candidate> found;
  for (const double cells : {12.0, 9.0, 7.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5}) {
    const double radius_m = request.turn_radius_m.value_or(two_digits(cells * cell_m));
    if (radius_m > cell_m) {
      if (const auto one = candidate(request, cell_m, radius_m)) found.push_back(*one);
    }
    if (request.turn_radius_m) break;
  }
  double best = 0.0;
  for (const Candidate& c : found) best = std::max(best, c.share);
  constexpr double nearly = 0.8;
  const auto first = std::find_if(found.begin(), found.end(),
                                  [&](const Candidate& c) { return c.share >= nearly * best; });
  found.erase(found.begin(), first);
  return found;
}

double first_cell_m(const NewScenarioRequest& request) {
  if (request.cell_m) return *request.cell_m;
  const double cell_m = sensible_cell_m(request.map, cells_across);
  constexpr double cells_in_a_radius = 2.5;
  if (!request.turn_radius_m || *request.turn_radius_m >= cells_in_a_radius * cell_m) return cell_m;
  return two_digits(*request.turn_radius_m / cells_in_a_radius);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// Relative to the scenario's folder if possible.
std::string map_name(const NewScenarioRequest& request) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(request.output)).parent_path();
  const fs::path map = fs::weakly_canonical(fs::absolute(request.map.file));
  const fs::path relative = map.lexically_relative(folder);
  return relative.empty() ? map.generic_string() : relative.generic_string();
}

std::string map_table(const NewScenarioRequest& request, const Candidate& chosen) {
  const MapRequest& map = request.map;
  std::string text = fmt::format(
      "[map]\n"
      "file = {}\n"
      "cell_m = {}  # side of a plan cell; smaller cells resolve narrower gaps but take longer\n",
      quoted(map_name(request)), chosen.cell_m);
  if (map.resolution_m)
    text += fmt::format("resolution_m = {}  # metres per pixel\n", *map.resolution_m);
  if (map.altitude_m)
    text += fmt::format("altitude_m = {}  # flight altitude; higher ground is an obstacle\n",
                        *map.altitude_m);
  if (map.inclusion)
    text += fmt::format("inclusion = \"{}\"  # stay in {} of the keep-in fences\n",
                        *map.inclusion == Inclusion::all ? "all" : "any",
                        *map.inclusion == Inclusion::all ? "every one" : "any");
  return text +
         "# footprint_radius_m = 0.5  # obstacles grow by this: half the vehicle's width\n"
         "# outside = \"free\"          # the world beyond the map is an obstacle unless this is "
         "set\n";
}

std::string mission_table(const Candidate& chosen) {
  const GoalPlace& goal = chosen.goal;
  const std::string metres = "goal_m = " + metres_text(goal.place_m, goal.decimals);
  std::string text = fmt::format(
      "\n[mission]\n"
      "kind = \"goal\"\n"
      "# A goal with much room in the largest free part; it can be reached from {} of the free "
      "cells.\n",
      whole_percent_text(goal.serves));
  constexpr int of_a_degree = 5;
  if (const LonLatOf degrees = lon_lat_of(chosen.frame, "the map")) {
    text += fmt::format("goal_deg = {}  # latitude, longitude; in the map's metres:\n# {}\n",
                        lat_lon_text(degrees(goal.place_m), goal.decimals + of_a_degree), metres);
  } else {
    text += metres + "  # metres in the map's frame\n";
  }
  return text +
         "# goal_heading_rad = 1.57  # arrive with this heading, counter-clockwise from east\n";
}

std::string text_of(const NewScenarioRequest& request, const Candidate& chosen) {
  constexpr double sideways_mps2 = 3.0;
  const double speed_mps =
      request.speed_mps.value_or(two_digits(std::sqrt(sideways_mps2 * chosen.turn_radius_m)));
  return "# A first scenario made from its map, ready to run. All keys: fairway "
         "--scenario-keys\n\n" +
         map_table(request, chosen) +
         fmt::format(
             "\n[vehicle]\n"
             "speed_mps = {}\n"
             "turn_radius_m = {}  # smallest; more than cell_m. {}\n",
             speed_mps, chosen.turn_radius_m,
             request.turn_radius_m ? "As requested"
                                   : "Chosen to suit the map: replace it by your vehicle's") +
         mission_table(chosen) +
         "\n[plan]\n"
         "# alpha = 2.0  # buffer width / turning radius; without it, chosen to suit the map\n"
         "beta = 2.0  # goal radius / turning radius\n"
         "\n[simulate]\n"
         "# states = [[0.0, 0.0, 1.57]]  # flights to draw: metres, and radians from east\n"
         "random = 100\n"
         "\n[verify]\n"
         "# time_limit_s = 600.0  # stop refining the proof after this time\n";
}

[[noreturn]] void refuse(const NewScenarioRequest& request, double cell_m) {
  MapRequest map = request.map;
  map.cell_m = cell_m;
  const double radius_m = request.turn_radius_m.value_or(two_digits(1.5 * cell_m));
  if (radius_m <= cell_m) {
    throw InputError("--turn-radius",
                     fmt::format("is {} m, expected more than a cell of {} m", radius_m, cell_m));
  }
  const MapSurvey survey = survey_map(map, radius_m);
  const Grid& g = survey.map.grid;
  const GoalAdvice advice =
      goal_advice(survey.map, survey.region, g.center({g.nx / 2, g.ny / 2}), {1.0, radius_m}, {});
  throw InputError(request.map.file.string(),
                   fmt::format("no plan for a turning radius of {} m on cells of {} m: {}",
                               radius_m, cell_m, words(advice, metres_text)));
}

/// A world without a fence grows a little with its goal, so whether the goal still fits is tried.
bool can_be_planned(Scenario scenario) {
  scenario.open.modes = false;  // do not bear on it
  const Progress silent;
  StageClock clock(silent);
  try {
    return std::holds_alternative<Planned>(plan_scenario(scenario, clock));
  } catch (const WarnedInputError&) {
    return false;
  }
}

}  // namespace

NewScenario new_scenario(const NewScenarioRequest& request) {
  double cell_m = first_cell_m(request);
  for (int halvings = 0;; ++halvings) {
    for (const Candidate& chosen : candidates(request, cell_m)) {
      NewScenario made;
      made.text = text_of(request, chosen);
      made.scenario = scenario_of_text(made.text, request.output);
      made.serves = chosen.goal.serves;
      if (can_be_planned(made.scenario)) return made;
    }
    constexpr int most_halvings = 3;
    if (request.cell_m || halvings == most_halvings) refuse(request, cell_m);
    cell_m = two_digits(cell_m / 2.0);
  }
}

}  // namespace fairway
