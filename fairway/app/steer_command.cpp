// fairway steer: to a pose, or along poses one by one, where nothing is in the way.
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

struct SteerArguments {
  std::string from;
  std::string to;
  std::string pairs_file;
  std::string waypoints_file;
  std::string law = "shortest";
  double turn_radius_m = 0.0;
  fs::path picture;
  fs::path track;

  SteeringLaw steering_law() const {
    return law == "clf" ? SteeringLaw::clf : SteeringLaw::shortest;
  }
  /// A flight takes a hundred steps for each.
  double most_radii() const { return law == "clf" ? farthest_flown_radii : farthest_radii; }
  LegTrack legs_track() const {
    return picture.empty() && track.empty() ? LegTrack::none : LegTrack::all;
  }
};

std::vector<SteeredLeg> steered(const SteerArguments& a) {
  const double r = a.turn_radius_m;
  const SteeringLaw law = a.steering_law();
  if (!a.waypoints_file.empty()) {
    std::optional<State> start;
    if (!a.from.empty()) start = state_of_argument(a.from);
    const PosePairs legs = read_waypoints(a.waypoints_file, start, r, a.most_radii());
    return steer_waypoints(legs, r, law, a.legs_track());
  }
  const PosePairs pairs = a.pairs_file.empty()
                              ? PosePairs{{state_of_argument(a.from)}, {state_of_argument(a.to)}}
                              : read_pose_pairs(a.pairs_file, r, a.most_radii());
  return steer_pairs(pairs, r, law, a.legs_track());
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
    const Picture picture = steering_picture(legs, a.turn_radius_m, a.steering_law());
    write_picture(picture, a.picture, session.existing());
  }
  if (session.json) {
    session.tell(report(a, legs), "");
  } else {
    print_csv(legs);
  }
  return exit_done;
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

}  // namespace

Action declare_steer(CLI::App& options) {
  auto arguments = std::make_shared<SteerArguments>();
  SteerArguments& a = *arguments;
  for (const auto& [name, place, what] : {std::tuple{"--from", &a.from, "where the vehicle is"},
                                          std::tuple{"--to", &a.to, "the pose to reach"}}) {
    options
        .add_option(name, *place,
                    fmt::format("{}: metres, and radians or degrees with the suffix deg", what))
        ->type_name("X,Y,H")
        ->check(state_argument());
  }
  options
      .add_option("--turn-radius", a.turn_radius_m, "the vehicle's least turning radius, metres")
      ->required()
      ->type_name("R")
      ->check(finite_above(0.0));
  options
      .add_option("--law", a.law,
                  "shortest: a shortest path; clf: the control law of Yong and Barth, simulated")
      ->check(CLI::IsMember({"shortest", "clf"}))
      ->capture_default_str();
  options
      .add_option("--pairs", a.pairs_file,
                  "many at once, from a CSV file x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad; - for "
                  "standard input")
      ->type_name("CSV");
  options
      .add_option("--waypoints", a.waypoints_file,
                  "poses to reach one by one, from a CSV file x_m,y_m,heading_rad; the first is "
                  "the start unless --from is given; - for standard input")
      ->type_name("CSV");
  options
      .add_option("--picture", a.picture,
                  "draw the path, the shortest path and V; as SVG or PNG, by the file's ending")
      ->check(picture_argument())
      ->type_name("FILE");
  options
      .add_option("--track", a.track,
                  "write the path: leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value")
      ->type_name("CSV");
  options.final_callback([&a] { check_arguments(a); });
  options.footer(
      "Prints CSV length_m,word,converged,end_x_m,end_y_m,end_heading_rad, a line for each\n"
      "pair or waypoint. Obstacles are not considered. With the law clf a step is R / 100,\n"
      "and a vehicle has converged within R / 50 and 0.02 rad; its word is what it drove.\n"
      "Example: fairway steer --from 0,0,0 --to 100,50,90deg --turn-radius 20 --picture path.svg");
  return [arguments](const Session& session) { return steer_command(*arguments, session); };
}

}  // namespace fairway
