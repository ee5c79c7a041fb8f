// fairway steer: to a pose, or through a list of poses, ignoring obstacles.
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/run/product_picture.hpp"
#include "fairway/run/steering.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/pose_csv.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Beyond it a path in doubles is not accurate to a millimetre (dubins_words.hpp, property 2).
constexpr double largest_radius_m = 1e9;

struct SteerArguments {
  std::string from;
  std::string to;
  std::string pairs_file;
  std::string waypoints_file;
  std::string law = "shortest";
  double turn_radius_m = 0.0;
  SteeringRequest request;
  std::string repulsion = "overlap-behind";
  fs::path picture;
  fs::path track;

  /// A flight takes a hundred steps per radius.
  double most_radii() const { return request.is_flown() ? farthest_flown_radii : farthest_radii; }
  LegTrack legs_track() const {
    return picture.empty() && track.empty() ? LegTrack::none : LegTrack::all;
  }
};

std::vector<SteeredLeg> steered(const SteerArguments& a) {
  const double r = a.turn_radius_m;
  if (!a.waypoints_file.empty()) {
    std::optional<State> start;
    if (!a.from.empty()) start = state_of_argument(a.from);
    const PosePairs legs = read_waypoints(a.waypoints_file, start, r, a.most_radii());
    return steer_waypoints(legs, r, a.request, a.legs_track());
  }
  const PosePairs pairs = a.pairs_file.empty()
                              ? PosePairs{{state_of_argument(a.from)}, {state_of_argument(a.to)}}
                              : read_pose_pairs(a.pairs_file, r, a.most_radii());
  return steer_pairs(pairs, r, a.request, a.legs_track());
}

json report(const SteerArguments& a, const std::vector<SteeredLeg>& legs) {
  json lines = json::array();
  double length_m = 0.0;
  for (const SteeredLeg& s : legs) {
    lines.push_back({{"length_m", s.length_m},
                     {"word", s.word},
                     {"converged", s.converged},
                     {"end_x_m", s.end.position_m.x},
                     {"end_y_m", s.end.position_m.y},
                     {"end_heading_rad", s.end.heading.rad()}});
    length_m += s.length_m;
  }
  json all = {{"law", a.law}, {"turn_radius_m", a.turn_radius_m}, {"paths", std::move(lines)}};
  if (!a.waypoints_file.empty()) all["length_m"] = length_m;
  return all;
}

void print_csv(const std::vector<SteeredLeg>& legs) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text),
                 "length_m,word,converged,end_x_m,end_y_m,end_heading_rad\n");
  for (const SteeredLeg& s : legs) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", s.length_m, s.word, s.converged,
                   s.end.position_m.x, s.end.position_m.y, s.end.heading.rad());
  }
  print({text.data(), text.size()});
}

int steer_command(const SteerArguments& a, const Session& session) {
  require_places({a.picture, a.track}, {a.pairs_file, a.waypoints_file}, session.existing());
  const std::vector<SteeredLeg> legs = steered(a);
  if (!a.track.empty()) write_whole(a.track, session.existing(), track_csv(legs));
  if (!a.picture.empty()) {
    const Picture picture = steering_picture(legs, a.turn_radius_m, a.request);
    write_picture(picture, a.picture, session.existing());
  }
  if (session.json) {
    session.tell(report(a, legs), "");
  } else {
    print_csv(legs);
  }
  return exit_done;
}

/// Completes the request from the arguments.
void complete_request(SteerArguments& a) {
  a.request.law = a.law == "clf" ? SteeringLaw::clf : SteeringLaw::shortest;
  a.request.clf.repulsion = a.repulsion == "none"      ? Repulsion::none
                            : a.repulsion == "overlap" ? Repulsion::overlap
                                                       : Repulsion::overlap_behind;
}

void check_flight(const SteerArguments& a) {
  const double r = a.turn_radius_m;
  const SteeringRequest& request = a.request;
  if (request.step_m && (*request.step_m > 0.1 * r || *request.step_m < 1e-4 * r)) {
    throw CLI::ValidationError(
        "--step", fmt::format("expected {:g} to {:g} metres for this radius", 1e-4 * r, 0.1 * r));
  }
  const double step_m = request.step_m.value_or(0.01 * r);
  const double place_m = request.tolerance_m.value_or(0.02 * r);
  if (!PoseTolerance{place_m, place_m / r}.covers(step_m, r)) {
    throw CLI::ValidationError(
        "--tolerance",
        fmt::format("a goal within {:g} metres could be missed between two steps of {:g} metres: "
                    "expected more than {:g}",
                    place_m, step_m, step_m * (0.5 + 0.5 * step_m / r)));
  }
}

void check_arguments(const SteerArguments& a) {
  const bool one = a.waypoints_file.empty() && (!a.from.empty() || !a.to.empty());
  if (!a.pairs_file.empty()) {
    if (one) throw CLI::ExcludesError("--from and --to", "--pairs");
    if (!a.waypoints_file.empty()) throw CLI::ExcludesError("--waypoints", "--pairs");
    if (!a.picture.empty()) throw CLI::ExcludesError("--picture", "--pairs");
    if (!a.track.empty()) throw CLI::ExcludesError("--track", "--pairs");
  } else if (!a.waypoints_file.empty()) {
    if (!a.to.empty()) throw CLI::ExcludesError("--to", "--waypoints");
  } else {
    if (!one) throw CLI::RequiredError("--from and --to, --waypoints, or --pairs");
    if (a.from.empty() || a.to.empty()) {
      throw CLI::RequiredError(a.from.empty() ? "--from" : "--to");
    }
  }
  if (!can_steer({}, {}, a.turn_radius_m)) {
    throw CLI::ValidationError("--turn-radius", "is too small to divide by");
  }
  if (a.turn_radius_m > largest_radius_m) {
    throw CLI::ValidationError("--turn-radius",
                               fmt::format("expected at most {:g} metres", largest_radius_m));
  }
  if (!a.waypoints_file.empty() && a.request.is_flown() && a.law != "clf") {
    throw CLI::ExcludesError("--step, --tolerance, --goal-speed, --noise",
                             "--waypoints with the law shortest");
  }
  if (!a.waypoints_file.empty() && (a.request.noise_m > 0.0 || a.request.goal_speed > 0.0)) {
    throw CLI::ExcludesError("--goal-speed and --noise", "--waypoints");
  }
  check_flight(a);
  if (one && !is_within_radii(state_of_argument(a.from), state_of_argument(a.to), a.turn_radius_m,
                              a.most_radii())) {
    throw CLI::ValidationError(
        "--turn-radius",
        fmt::format("the poses are more than {:g} turning radii apart", a.most_radii()));
  }
  if (!a.picture.empty() && a.picture == a.track) {
    throw CLI::ValidationError("--picture, --track", "expected two files");
  }
}

void declare_flight(CLI::App& options, SteerArguments& a) {
  options
      .add_option("--n", a.request.clf.n,
                  "law clf: exponent n of its vote (Eq. 8); shapes V, not the path")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  options
      .add_option("--repulsion", a.repulsion,
                  "law clf: which circles repel each other (Eqs. 5 to 7)")
      ->check(CLI::IsMember({"none", "overlap", "overlap-behind"}))
      ->capture_default_str();
  options
      .add_option("--step", a.request.step_m,
                  "distance between two control updates, metres (default: R / 100)")
      ->type_name("M")
      ->check(finite_above(0.0));
  options
      .add_option("--tolerance", a.request.tolerance_m,
                  "a flight has converged when within M metres and M / R radians of the goal "
                  "(default: R / 50)")
      ->type_name("M")
      ->check(finite_above(0.0));
  options
      .add_option("--goal-speed", a.request.goal_speed,
                  "move the goal along its heading at S times the vehicle's speed, 0 to 0.99")
      ->type_name("S")
      ->check(CLI::Range(0.0, 0.99))
      ->capture_default_str();
  options
      .add_option("--noise", a.request.noise_m,
                  "noise added to x and y after each step, metres (standard deviation); M / R "
                  "radians for the heading")
      ->type_name("M")
      ->check(finite_from(0.0))
      ->capture_default_str();
  options.add_option("--seed", a.request.seed, "random seed of the noise")
      ->type_name("S")
      ->capture_default_str();
}

}  // namespace

Action declare_steer(CLI::App& options) {
  auto arguments = std::make_shared<SteerArguments>();
  SteerArguments& a = *arguments;
  for (const auto& [name, place, what] : {std::tuple{"--from", &a.from, "the vehicle's pose"},
                                          std::tuple{"--to", &a.to, "the pose to reach"}}) {
    options
        .add_option(
            name, *place,
            fmt::format("{}: metres, and heading in radians, or degrees with the suffix deg", what))
        ->type_name("X,Y,H")
        ->check(state_argument());
  }
  options
      .add_option("--turn-radius", a.turn_radius_m, "the vehicle's minimum turning radius, metres")
      ->required()
      ->type_name("R")
      ->check(finite_above(0.0));
  options
      .add_option("--law", a.law,
                  "shortest: a shortest path; clf: the control law of Yong and Barth, simulated")
      ->check(CLI::IsMember({"shortest", "clf"}))
      ->capture_default_str();
  declare_flight(options, a);
  options
      .add_option("--pairs", a.pairs_file,
                  "steer many pairs of poses from a CSV file with "
                  "x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad; - for standard input")
      ->type_name("CSV");
  options
      .add_option("--waypoints", a.waypoints_file,
                  "reach poses one after another, from a CSV file with x_m,y_m,heading_rad; the "
                  "first is the start unless --from is given; - for standard input")
      ->type_name("CSV");
  options
      .add_option("--picture", a.picture, "draw the path, the shortest path and V; .svg or .png")
      ->check(picture_argument())
      ->type_name("FILE");
  options
      .add_option("--track", a.track,
                  "write the path: leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value")
      ->type_name("CSV");
  options.final_callback([&a, &options] {
    const bool papers = options.count("--n") + options.count("--repulsion") > 0;
    if (papers && a.law != "clf") {
      throw CLI::ValidationError("--n, --repulsion", "need --law clf");
    }
    complete_request(a);
    check_arguments(a);
  });
  options.footer(
      "Prints CSV length_m,word,converged,end_x_m,end_y_m,end_heading_rad, one line for each\n"
      "pair or waypoint. Obstacles are not considered. The law clf is simulated in steps, and so\n"
      "is the law shortest when --step, --tolerance, --goal-speed or --noise is given; the word\n"
      "then lists the turns as driven.\n"
      "Example: fairway steer --from 0,0,0 --to 100,50,90deg --turn-radius 20 --picture path.svg");
  return [arguments](const Session& session) { return steer_command(*arguments, session); };
}

}  // namespace fairway
