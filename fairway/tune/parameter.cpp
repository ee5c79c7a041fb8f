#include "fairway/tune/parameter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/run/scenario_overrides.hpp"

namespace fairway {
namespace {

double number_of(const std::string& text, const std::string& whole) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw InputError("--vary", fmt::format("{}: expected KEY=LOW:HIGH, such as plan.alpha=0.3:2, "
                                           "or KEY=VALUE,VALUE, such as map.cell_m=4,8",
                                           whole));
  }
  return value;
}

void require_value(const std::string& key, const std::string& value) {
  Scenario any;
  take_override({key, value, "--vary"}, any);
}

}  // namespace

Parameter parameter_of_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) (void)number_of("", text);
  Parameter made;
  made.key = text.substr(0, equals);
  const std::string values = text.substr(equals + 1);
  if (const std::size_t colon = values.find(':'); colon != std::string::npos) {
    made.low = number_of(values.substr(0, colon), text);
    made.high = number_of(values.substr(colon + 1), text);
    if (!(made.low < made.high)) {
      throw InputError("--vary", fmt::format("{}: expected LOW < HIGH", text));
    }
    for (const double end : {made.low, made.high}) require_value(made.key, value_text(end));
    return made;
  }
  for (std::size_t begin = 0; begin <= values.size();) {
    const std::size_t comma = std::min(values.find(',', begin), values.size());
    made.choices.push_back(values.substr(begin, comma - begin));
    if (made.choices.back().empty()) (void)number_of("", text);
    require_value(made.key, made.choices.back());
    begin = comma + 1;
  }
  return made;
}

std::vector<Parameter> usual_parameters(const Scenario& scenario) {
  // A buffer narrower than a cell is none: there is nothing to find below.
  const double cell_radii = scenario.map.cell_m / scenario.vehicle.turn_radius_m;
  const auto range = [](const char* key, double low, double high) {
    return Parameter{key, low, high, {}};
  };
  std::vector<Parameter> all{
      range("plan.alpha", 0.9 * cell_radii, std::max(2.5, scenario.plan.alpha)),
      range("plan.sigma_cells", 0.0, 3.0), range("plan.sigma_border", 0.0, 1.5),
      range("plan.mu_border", 0.05, 1.0)};
  if (scenario.mission.kind == MissionKind::path && scenario.plan.path_field == PathField::paper) {
    all.push_back(range("plan.sigma_path", 0.0, 2.0));
    all.push_back(range("plan.mu_path", 0.05, 1.0));
  }
  return all;
}

std::string value_text(double value) {
  return fmt::format("{}", std::stod(fmt::format("{:.4g}", value)));
}

}  // namespace fairway
