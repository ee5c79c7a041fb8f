// A comparison as a page: one file of HTML with its maps in it, without scripts, that fetches
// nothing.
#pragma once

#include <span>
#include <string>

#include "fairway/compare/compared_plan.hpp"
#include "fairway/compare/comparison.hpp"

namespace fairway {

/// `command`: what made it, for whoever wants it again.
[[nodiscard]] std::string comparison_page(std::span<const ComparedPlan> plans,
                                          const Comparison& comparison, const std::string& command);

/// The map of a pair: SVG whose colours are those of the page.
[[nodiscard]] std::string difference_svg(const PairDifference& pair, const std::string& label);

}  // namespace fairway
