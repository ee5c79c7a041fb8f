#include "fairway/app/contract_arguments.hpp"

#include "fairway/app/argument_checks.hpp"

namespace fairway {

void declare_turn(CLI::App& options, ContractArguments& a) {
  options.add_option("--airspeed", a.vehicle.airspeed_mps, "airspeed, m/s")
      ->check(finite_above(0.0))
      ->type_name("V");
  options
      .add_option("--bank-limit", a.bank_limit,
                  "greatest bank in a turn, radians or with the suffix deg")
      ->check(angle_argument())
      ->type_name("A");
  options
      .add_option("--turn-rate", a.turn_rate, "or the rate of its turns, radians (or deg) a second")
      ->check(angle_argument())
      ->type_name("W");
  options.add_option("--turn-radius", a.vehicle.turn_radius_m, "or the turning radius, metres")
      ->check(finite_above(0.0))
      ->type_name("R");
  options
      .add_option("--radius-spread", a.vehicle.radius_spread,
                  "share by which the radius in still air may be smaller or larger")
      ->check(CLI::Range(0.0, 0.9))
      ->type_name("S")
      ->capture_default_str();
  options.add_option("--speed-spread", a.vehicle.speed_spread, "the same for the airspeed")
      ->check(CLI::Range(0.0, 0.9))
      ->type_name("S")
      ->capture_default_str();
}

void declare_errors(CLI::App& options, ContractArguments& a) {
  options
      .add_option(
          "--bank-lag", a.vehicle.bank_lag_s,
          "time constant of the roll, seconds; leave it out for a vehicle that does not bank")
      ->check(finite_from(0.0))
      ->type_name("S");
  options.add_option("--wind", a.vehicle.wind_mps, "strongest wind, m/s, from any direction")
      ->check(finite_from(0.0))
      ->type_name("W");
  options
      .add_option("--delay", a.vehicle.delay_s,
                  "seconds from being at a place to obeying its command, at worst")
      ->check(finite_from(0.0))
      ->type_name("S");
  options
      .add_option("--control-period", a.vehicle.control_period_s, "seconds between two commands")
      ->check(finite_from(0.0))
      ->type_name("S");
  options
      .add_option("--position-error", a.vehicle.position_error_m,
                  "error of the position, metres, at worst; with logs, of their places")
      ->check(finite_from(0.0))
      ->type_name("M");
  options
      .add_option("--heading-error", a.heading_error,
                  "error of sensor and control about a course held, radians or with the suffix deg "
                  "(default: 1deg)")
      ->check(angle_argument())
      ->type_name("A");
  options
      .add_option("--holds", a.holds,
                  "what the autopilot holds: the course over ground, or the heading")
      ->check(CLI::IsMember({"course", "heading"}))
      ->capture_default_str();
}

void declare_logs(CLI::App& options, ContractArguments& a) {
  options
      .add_option("--log", a.logs,
                  "flight logs: CSV with a header and t_s,x_m,y_m,course_rad,command_rad")
      ->type_name("CSV");
  options
      .add_option("--columns", a.columns,
                  "names of the columns, such as time=T,x=EAST,y=NORTH,course=COG,command=CMD")
      ->type_name("NAMES");
  options
      .add_option("--angles", a.angles,
                  "how courses are counted: math (radians counter-clockwise from east), compass "
                  "(radians clockwise from north), compass-deg (degrees)")
      ->check(CLI::IsMember({"math", "compass", "compass-deg"}));
  options
      .add_option("--tracking-m", a.tracking_m,
                  "how far a flight may be from a motion of the contract, metres (default: a tenth "
                  "of the turning radius)")
      ->check(finite_above(0.0))
      ->type_name("M");
  options
      .add_option("--margin", a.margin,
                  "widen the fitted contract: errors larger, ranges wider by this share")
      ->check(CLI::Range(0.0, 2.0))
      ->type_name("S");
  options
      .add_option("--contract", a.contract,
                  "do not fit: find out whether the logs keep this contract, a file with "
                  "[vehicle.contract]")
      ->type_name("FILE.toml");
  options.add_flag("--hold-sides", a.hold_sides,
                   "for logs flown with the commands of fairway/runtime.hpp: demand the contract's "
                   "rule of sides, too; else each command may be turned to by the shorter side");
  options.add_option("--picture", a.picture, "draw the log that keeps it worst; .svg or .png")
      ->check(picture_argument())
      ->type_name("FILE");
}

}  // namespace fairway
