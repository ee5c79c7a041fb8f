// A comparison as a folder: table, maps, states, page.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/compare/compared_plan.hpp"
#include "fairway/compare/comparison.hpp"

namespace fairway {

/// Every file that a comparison of so many plans may write.
[[nodiscard]] std::vector<std::string> comparison_files(std::size_t plans);

/// The one that is written last: a folder with it is whole.
inline constexpr const char* comparison_file = "comparison.json";

/// Into `place`, a folder. `command`: what made it.
void write_comparison(std::span<const ComparedPlan> plans, const Comparison& comparison,
                      const std::string& command, const std::filesystem::path& place);

}  // namespace fairway
