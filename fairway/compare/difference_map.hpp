// Where plans differ: of each cell, how many headings only one of two plans brings to the mission.
#pragma once

#include <span>
#include <vector>

#include "fairway/compare/comparison.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

/// [k - 1]: of the first plan and plan k. States beside the middles of cells, as in
/// verdict_map.hpp, at evenly spaced headings, at most `across` cells along the longer side.
[[nodiscard]] std::vector<DifferenceMap> difference_maps(std::span<const ComparedPlan> plans,
                                                         const CommonGround& ground, Knowledge of,
                                                         int across, int headings);

/// Three panels: proved by the first alone, by the second alone, by neither.
[[nodiscard]] Picture draw_difference(const Comparison& comparison, const PairDifference& pair);

/// "difference", "difference-3", "difference-contract": names of the pictures' files, without
/// extension; the first for a comparison of two.
[[nodiscard]] std::string picture_name(std::size_t plans, std::size_t second, Knowledge of);

}  // namespace fairway
