// fairway init: a first scenario for a map.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/map_arguments.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/run/new_scenario.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
  MapArguments map;
  std::optional<double> speed_mps;
  fs::path output;
};

int init_command(const InitArguments& a, const Session& session) {
  require_places({a.output}, {a.map.file}, session.existing());
  const NewScenario made =
      new_scenario({a.map.request(), a.output, a.map.cell_m, a.map.turn_radius_m, a.speed_mps});
  write_whole(a.output, session.existing(), made.text);
  const Scenario& s = made.scenario;
  session.tell(
      {{"scenario", a.output.string()},
       {"cell_m", s.map.cell_m},
       {"turn_radius_m", s.vehicle.turn_radius_m},
       {"speed_mps", s.vehicle.speed_mps},
       {"serves", made.serves}},
      fmt::format(
          "{}: cells of {} m, a turning radius of {} m, {} m/s; the goal can be reached from {} "
          "of the free cells.\nNext: fairway run {}",
          a.output.string(), s.map.cell_m, s.vehicle.turn_radius_m, s.vehicle.speed_mps,
          whole_percent_text(made.serves), a.output.string()));
  return exit_done;
}

}  // namespace

Action declare_init(CLI::App& options) {
  auto arguments = std::make_shared<InitArguments>();
  InitArguments& a = *arguments;
  declare_map(options, a.map);
  options.add_option("--speed", a.speed_mps, "the vehicle's speed, metres per second")
      ->type_name("MPS")
      ->check(finite_above(0.0));
  options.add_option("-o,--output", a.output, "the scenario to write")
      ->required()
      ->type_name("SCENARIO.toml");
  options.footer(
      "Options that are not given are chosen so that the goal can be reached from most of the\n"
      "map; comments in the file say what to change. The goal is placed in the largest free part\n"
      "that has room for one.\n"
      "Example: fairway init demo/basin.yaml -o basin.toml");
  return [arguments](const Session& session) { return init_command(*arguments, session); };
}

}  // namespace fairway
