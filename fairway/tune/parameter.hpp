// What may be varied: keys of a scenario with their ranges, or with the few values to try.
#pragma once

#include <string>
#include <vector>

#include "fairway/run/scenario.hpp"

namespace fairway {

struct Parameter {
  std::string key;  ///< "plan.alpha"
  double low = 0.0;
  double high = 0.0;
  std::vector<std::string> choices;  ///< instead of a range, as TOML writes them

  [[nodiscard]] bool is_range() const { return choices.empty(); }
};

/// KEY=LOW:HIGH or KEY=VALUE,VALUE,... Throws InputError when it is neither, the key is unknown or
/// cannot have such a value.
[[nodiscard]] Parameter parameter_of_text(const std::string& text);

/// Those of the field that are not part of what is asked for: alpha, sigma_cells and the transition
/// at borders; near a path also that at the path, where the paper's field is asked for. Not beta:
/// to make the goal larger is another mission.
[[nodiscard]] std::vector<Parameter> usual_parameters(const Scenario& scenario);

/// In four digits, as the tuned scenario will say it, and as it is evaluated.
[[nodiscard]] std::string value_text(double value);

}  // namespace fairway
