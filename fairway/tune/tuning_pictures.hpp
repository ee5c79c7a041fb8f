// Pictures of a search: what it found as it went on, and what share costs in time.
#pragma once

#include <filesystem>
#include <vector>

#include "fairway/tune/evaluation.hpp"

namespace fairway {

/// search.svg and pareto.svg, each also as PNG.
void write_tuning_pictures(const std::vector<Evaluation>& all, const Objective& objective,
                           const std::filesystem::path& folder);

}  // namespace fairway
