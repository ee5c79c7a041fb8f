#include "fairway/run/design_warnings.hpp"

#include <string_view>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/vehicle/path_troubles.hpp"

namespace fairway {
namespace {

class Warnings {
 public:
  explicit Warnings(const Scenario& scenario) : scenario_(scenario) {}

  bool sets(std::string_view key) const {
    return scenario_.lines.find(key) != scenario_.lines.end();
  }
  void add(std::string_view key, std::string_view words) {
    found_.push_back(fmt::format("{}: {}: {}", scenario_.place_of(key), key, words));
  }
  void add_width(std::string_view key, double sigma) {
    if (!sets(key) || sigma == 0.0 || (sigma >= 1.0 && sigma <= 2.0)) return;
    add(key, fmt::format("is {}; the paper asks for 1 to 2", length_text(sigma)));
  }
  std::vector<std::string> found() && { return std::move(found_); }

 private:
  const Scenario& scenario_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> design_warnings(const Scenario& scenario, const Mission& mission) {
  Warnings warnings(scenario);
  const FieldOptions& plan = scenario.plan;
  const auto* path = std::get_if<PathMission>(&mission);
  if (warnings.sets("plan.alpha") && plan.alpha < 2.0) {
    warnings.add(
        "plan.alpha",
        fmt::format("is {}; the paper asks for at least 2: below that, there may be no room "
                    "for a full turn between an obstacle and the nearest free cells",
                    length_text(plan.alpha)));
  }
  if (path == nullptr && warnings.sets("plan.beta") && plan.beta < 2.0) {
    warnings.add("plan.beta",
                 fmt::format("is {}; the paper asks for at least 2: flights may circle around a "
                             "smaller goal",
                             length_text(plan.beta)));
  }
  warnings.add_width("plan.sigma_border", plan.sigma_border);
  if (path == nullptr) return std::move(warnings).found();
  warnings.add_width("plan.sigma_path", plan.sigma_path);
  for (const PathTrouble& trouble : path_troubles(*path, scenario.vehicle.turn_radius_m)) {
    warnings.add(place_key(scenario), trouble.message);
  }
  return std::move(warnings).found();
}

}  // namespace fairway
