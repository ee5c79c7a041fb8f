#include "fairway/run/run_inputs.hpp"

#include "fairway/base/atomic_file.hpp"

namespace fairway {

namespace fs = std::filesystem;

std::vector<fs::path> inputs_of(const Scenario& scenario) {
  std::vector<fs::path> inputs{scenario.file, scenario.map.file};
  if (const auto& path = scenario.mission.path_file) inputs.push_back(*path);
  if (const fs::path& region = scenario.verify.region.file; !region.empty()) {
    inputs.push_back(region);
  }
  return inputs;
}

std::vector<fs::path> inputs_of(const ObstacleMap& map) {
  std::vector<fs::path> inputs;
  for (const InputFile& input : map.inputs) inputs.emplace_back(input.path);
  return inputs;
}

void require_no_inputs(const std::vector<fs::path>& products, const std::vector<fs::path>& inputs) {
  for (const fs::path& product : products) require_no_input(product, inputs);
}

}  // namespace fairway
