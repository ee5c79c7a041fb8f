// fairway contract: a vehicle contract from numbers or from flight logs, and logs held against one.
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/contract_arguments.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/identify/read_flight_log.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/contract_logs.hpp"
#include "fairway/run/explained_contract_toml.hpp"
#include "fairway/run/product_picture.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

LogFormat format_of(const ContractArguments& a) {
  LogFormat format;
  if (!a.columns.empty()) format.columns = log_columns_of(a.columns, "--columns");
  if (a.angles == "math") format.angles = LogAngles::east_ccw_rad;
  if (a.angles == "compass") format.angles = LogAngles::north_cw_rad;
  if (a.angles == "compass-deg") format.angles = LogAngles::north_cw_deg;
  return format;
}

std::vector<FlightLog> logs_of(const ContractArguments& a) {
  std::vector<FlightLog> logs;
  for (const std::string& file : a.logs) logs.push_back(read_flight_log(file, format_of(a)));
  return logs;
}

int give(const ContractArguments& a, const ExplainedContract& explained, const Session& session) {
  const std::string text = explained_contract_toml(explained);
  nlohmann::json report{{"contract", json_of(explained.contract)}};
  if (a.output.empty()) {
    report["toml"] = text;
    if (session.json) {
      session.tell(report, "");
    } else {
      print(text);  // with --quiet, too: it is the answer
    }
    return exit_done;
  }
  write_whole(a.output, session.existing(), text);
  report["file"] = a.output.string();
  session.tell(report, fmt::format("{} holds the contract.", a.output.string()));
  return exit_done;
}

/// A file with its own ranges needs no vehicle, which no number here compares with.
VehicleContract contract_given(const fs::path& file) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return read_contract(file, {unknown, unknown});
}

int hold_logs(const ContractArguments& a, const Session& session) {
  const VehicleContract contract = contract_given(a.contract);
  const std::vector<FlightLog> logs = logs_of(a);
  const double tracking_m =
      a.tracking_m.value_or(usual_tracking_radii * contract.turn_radius_m.least);
  std::vector<HeldLog> held;
  for (const FlightLog& log : logs)
    held.push_back(held_against(log, contract, tracking_m, a.sides()));
  const std::size_t worst = worst_of(held);
  if (!a.picture.empty()) {
    write_picture(picture_of_log(logs[worst], held[worst], tracking_m), a.picture,
                  session.existing());
  }
  std::string text = held_text(held);
  if (!a.picture.empty()) {
    text += fmt::format("{} shows {}.\n", a.picture.string(), held[worst].name);
  }
  session.tell(held_json(held, tracking_m), text.substr(0, text.size() - 1));
  for (const HeldLog& h : held) {
    if (!h.kept) return exit_no;
  }
  return exit_done;
}

int contract_command(const ContractArguments& a, const Session& session) {
  Places inputs{a.contract};
  inputs.insert(inputs.end(), a.logs.begin(), a.logs.end());
  require_places({a.output, a.picture}, inputs, session.existing());
  if (a.logs.empty()) return give(a, contract_of(a.vehicle), session);
  if (!a.contract.empty()) return hold_logs(a, session);
  const FitMargins margins{a.margin, a.vehicle.position_error_m};
  return give(a, contract_of_logs(logs_of(a), a.tracking_m, margins, a.sides()), session);
}

void check_vehicle(ContractArguments& a, const CLI::App& options) {
  KnownVehicle& v = a.vehicle;
  const auto count = [&](const char* name) { return options.count(name); };
  if (count("--airspeed") == 0) throw CLI::RequiredError("--airspeed, or --log");
  const auto sizes = count("--bank-limit") + count("--turn-rate") + count("--turn-radius");
  if (sizes != 1) {
    throw CLI::ValidationError("--bank-limit, --turn-rate, --turn-radius",
                               fmt::format("{} of them given, expected one", sizes));
  }
  if (count("--bank-limit") > 0) v.bank_limit_rad = angle_of_argument_rad(a.bank_limit);
  if (count("--turn-rate") > 0) v.turn_rate_radps = angle_of_argument_rad(a.turn_rate);
  if (count("--heading-error") > 0) v.heading_error_rad = angle_of_argument_rad(a.heading_error);
  if (v.bank_limit_rad && !(*v.bank_limit_rad > 0.0 && *v.bank_limit_rad < 1.5)) {
    throw CLI::ValidationError("--bank-limit", "expected more than 0 and less than 85deg");
  }
  if (v.turn_rate_radps && !(*v.turn_rate_radps > 0.0)) {
    throw CLI::ValidationError("--turn-rate", "expected more than 0 a second");
  }
  const double least_mps = (1.0 - v.speed_spread) * v.airspeed_mps;
  if (v.wind_mps >= least_mps) {
    throw CLI::ValidationError(
        "--wind",
        fmt::format("expected less than the least airspeed, {:.3g} m/s: the wind carries a "
                    "slower vehicle away",
                    least_mps));
  }
  v.holds = a.holds == "heading" ? HeldDirection::heading : HeldDirection::course;
  if (contract_of(v).contract.heading_error_rad >= 0.5 * pi) {
    throw CLI::ValidationError(
        "--heading-error, --wind, --holds",
        "the course may be off by a quarter turn or more: no contract can be "
        "proved with it; a course-hold autopilot needs no allowance for wind");
  }
}

void check_arguments(ContractArguments& a, const CLI::App& options) {
  if (a.logs.empty()) {
    for (const char* name : {"--contract", "--columns", "--angles", "--tracking-m", "--picture",
                             "--margin", "--hold-sides"}) {
      if (options.count(name) > 0) throw CLI::RequiresError(name, "--log");
    }
    check_vehicle(a, options);
    return;
  }
  for (const char* name : {"--airspeed", "--bank-limit", "--turn-rate", "--turn-radius",
                           "--bank-lag", "--wind", "--delay", "--control-period", "--heading-error",
                           "--holds", "--radius-spread", "--speed-spread"}) {
    if (options.count(name) > 0) throw CLI::ExcludesError(name, "--log");
  }
  if (!a.columns.empty()) {
    try {
      static_cast<void>(log_columns_of(a.columns, ""));
    } catch (const InputError& error) {
      throw CLI::ValidationError("--columns", error.what());
    }
  }
  if (a.contract.empty()) {
    if (!a.picture.empty()) throw CLI::RequiresError("--picture", "--contract");
    return;
  }
  for (const char* name : {"--margin", "--position-error", "--output"}) {
    if (options.count(name) > 0) throw CLI::ExcludesError(name, "--contract");
  }
}

}  // namespace

Action declare_contract(CLI::App& options) {
  auto arguments = std::make_shared<ContractArguments>();
  ContractArguments& a = *arguments;
  declare_turn(options, a);
  declare_errors(options, a);
  declare_logs(options, a);
  options.add_option("-o,--output", a.output, "write the contract to a file")
      ->type_name("FILE.toml");
  options.final_callback([&a, &options] { check_arguments(a, options); });
  options.footer(
      "Prints a block [vehicle.contract] with a reason for each number: from --airspeed and what\n"
      "else is known, or the tightest one that all the logs keep. With --contract, exit code 1\n"
      "when a log does not keep it. See docs/contract.md.\n"
      "Example: fairway contract --airspeed 22 --bank-limit 35deg --bank-lag 0.3 --delay 0.1\n"
      "Example: fairway contract --log flight1.csv flight2.csv -o contract.toml");
  return [arguments](const Session& session) { return contract_command(*arguments, session); };
}

}  // namespace fairway
