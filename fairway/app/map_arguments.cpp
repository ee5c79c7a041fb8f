#include "fairway/app/map_arguments.hpp"

#include "fairway/app/argument_checks.hpp"

namespace fairway {

MapRequest MapArguments::request() const {
  MapRequest request;
  request.file = file;
  request.cell_m = cell_m.value_or(request.cell_m);
  request.resolution_m = resolution_m;
  request.altitude_m = altitude_m;
  if (!inclusion.empty()) request.inclusion = inclusion == "all" ? Inclusion::all : Inclusion::any;
  return request;
}

void declare_map(CLI::App& options, MapArguments& a) {
  options.add_option("map", a.file, "the map file, in any format that a scenario accepts")
      ->required()
      ->type_name("MAP");
  options
      .add_option("--cell", a.cell_m, "side of a cell, metres (default: chosen to suit the map)")
      ->type_name("M")
      ->check(finite_above(0.0));
  options
      .add_option("--turn-radius", a.turn_radius_m, "the vehicle's minimum turning radius, metres")
      ->type_name("R")
      ->check(finite_above(0.0));
  options.add_option("--resolution", a.resolution_m, "metres per pixel, for maps without a scale")
      ->type_name("M")
      ->check(finite_above(0.0));
  options.add_option("--altitude", a.altitude_m, "flight altitude on elevation maps, metres")
      ->type_name("M")
      ->check(finite_number());
  options
      .add_option("--inclusion", a.inclusion,
                  "several keep-in fences: stay in all of them, or in any")
      ->check(CLI::IsMember({"all", "any"}));
}

}  // namespace fairway
