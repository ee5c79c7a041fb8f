// fairway steer: to a pose where nothing is in the way.
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/pose_csv.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway {
namespace {

using nlohmann::json;

struct SteerArguments {
  std::string from;
  std::string to;
  std::string pairs_file;
  std::string law = "shortest";
  double turn_radius_m = 0.0;
};

/// One line of the answer.
struct Steered {
  double length_m = 0.0;
  std::string word;
  bool converged = false;
  State end;
};

PosePairs read_pairs(const SteerArguments& a) {
  if (a.pairs_file.empty()) return {{state_of_argument(a.from)}, {state_of_argument(a.to)}};
  return read_pose_pairs(a.pairs_file, a.turn_radius_m);
}

Steered steered(const SteerArguments& a, const State& from, const State& to) {
  if (a.law == "shortest") {
    const DubinsPath path = shortest_path(from, to, a.turn_radius_m);
    return {path.length_m(), name_of(path.word), true, end_of(path)};
  }
  ClfLaw law;
  SteeringFlight flight =
      fly(law, from, to, a.turn_radius_m, steering_options(from, to, a.turn_radius_m));
  return {flight.length_m, std::move(flight.word), flight.converged, flight.end};
}

int steer_command(const SteerArguments& a, const Session& session) {
  const PosePairs pairs = read_pairs(a);
  std::vector<Steered> all(pairs.from.size());
  for_ranges(all.size(), a.law == "shortest" ? 1024 : 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i] = steered(a, pairs.from[i], pairs.to[i]);
  });
  if (session.json) {
    json lines = json::array();
    for (const Steered& s : all) {
      lines.push_back({{"length_m", s.length_m},
                       {"word", s.word},
                       {"converged", s.converged},
                       {"end_x_m", s.end.position_m.x},
                       {"end_y_m", s.end.position_m.y},
                       {"end_heading_rad", s.end.heading.rad()}});
    }
    session.tell({{"law", a.law}, {"turn_radius_m", a.turn_radius_m}, {"paths", std::move(lines)}},
                 "");
    return exit_done;
  }
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text),
                 "length_m,word,converged,end_x_m,end_y_m,end_heading_rad\n");
  for (const Steered& s : all) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", s.length_m, s.word, s.converged,
                   s.end.position_m.x, s.end.position_m.y, s.end.heading.rad());
  }
  std::fwrite(text.data(), 1, text.size(), stdout);
  return exit_done;
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
                  "many at once, from a CSV file x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad; - for standard "
                  "input")
      ->type_name("CSV");
  options.final_callback([&a] {
    const bool one = !a.from.empty() || !a.to.empty();
    if (one && !a.pairs_file.empty()) {
      throw CLI::ExcludesError("--from and --to", "--pairs");
    }
    if (!one && a.pairs_file.empty()) throw CLI::RequiredError("--from and --to, or --pairs");
    if (a.pairs_file.empty() && (a.from.empty() || a.to.empty())) {
      throw CLI::RequiredError(a.from.empty() ? "--from" : "--to");
    }
    if (one && !can_steer(state_of_argument(a.from), state_of_argument(a.to), a.turn_radius_m)) {
      throw CLI::ValidationError("--turn-radius",
                                 "the poses are more than 1e100 turning radii apart");
    }
    if (!can_steer({}, {}, a.turn_radius_m)) {
      throw CLI::ValidationError("--turn-radius", "is too small to divide by");
    }
  });
  options.footer(
      "Prints CSV length_m,word,converged,end_x_m,end_y_m,end_heading_rad, a line for each pair.\n"
      "Nothing is in the way. With the law clf a step is R / 100, and a vehicle has converged "
      "within\n"
      "R / 50 and 0.02 rad; its word is what it drove.\n"
      "Example: fairway steer --from 0,0,0 --to 100,50,90deg --turn-radius 20");
  return [arguments](const Session& session) { return steer_command(*arguments, session); };
}

}  // namespace fairway
