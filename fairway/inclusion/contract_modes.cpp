#include "fairway/inclusion/contract_modes.hpp"

#include <cstddef>
#include <limits>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/vehicle/modes.hpp"

namespace fairway {
namespace {

/// What a further mode is for: where it is not proved to reach, neighbours are one leaf, and
/// nothing is said of them. Groups of which no leaf is left are dropped.
ContractVerdicts reaching_only(const ContractVerdicts& all) {
  constexpr std::uint32_t unused = ~std::uint32_t{0};
  constexpr auto reach = static_cast<std::uint8_t>(Verdict::reach);
  std::vector<std::uint32_t> number(all.group_time_s.size(), unused);
  for (std::size_t leaf = 0; leaf < all.leaves(); ++leaf) {
    if (all.verdict[leaf] == reach) number[all.group[leaf]] = 0;
  }
  ContractVerdicts kept;
  kept.group_heading_rad.push_back(std::numeric_limits<float>::quiet_NaN());
  kept.group_time_s.push_back(std::numeric_limits<float>::infinity());
  kept.group_next_mode.push_back(no_mode);
  for (std::size_t g = 1; g < number.size(); ++g) {
    if (number[g] == unused) continue;
    number[g] = static_cast<std::uint32_t>(kept.group_time_s.size());
    kept.group_heading_rad.push_back(all.group_heading_rad[g]);
    kept.group_time_s.push_back(all.group_time_s[g]);
    kept.group_next_mode.push_back(all.group_next_mode[g]);
  }
  kept.first.push_back(0);
  for (std::size_t s = 0; s + 1 < all.first.size(); ++s) {
    bool after_open = false;
    for (std::size_t leaf = all.first[s]; leaf < all.first[s + 1]; ++leaf) {
      const bool reaches = all.verdict[leaf] == reach;
      if (reaches || !after_open) {
        kept.begin.push_back(all.begin[leaf]);
        kept.verdict.push_back(reaches ? reach : static_cast<std::uint8_t>(Verdict::undecided));
        kept.group.push_back(reaches ? number[all.group[leaf]] : 0);
      }
      after_open = !reaches;
    }
    kept.first.push_back(static_cast<std::uint32_t>(kept.begin.size()));
  }
  return kept;
}

}  // namespace

ContractModeAnswer answer_of_modes(std::span<const ContractMode> modes, double speed_least_mps,
                                   Vec2 place, double heading_rad) {
  ContractModeAnswer first;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const ContractAnswer answer =
        contract_answer(modes[k].parts, modes[k].verdicts, speed_least_mps, place, heading_rad);
    if (answer.verdict == Verdict::reach) return {answer, static_cast<int>(k)};
    if (k == 0) first.answer = answer;
  }
  return first;
}

ContractVerdicts joined(const ProvedContractModes& modes) {
  ContractVerdicts all;
  if (modes.empty()) return all;
  const auto append = [](auto& to, const auto& from, std::ptrdiff_t after) {
    to.insert(to.end(), from.begin() + after, from.end());
  };
  all.first.push_back(0);
  for (const auto& mode : modes) {
    const ContractVerdicts& v = mode->verdicts;
    const auto leaves = static_cast<std::uint32_t>(all.leaves());
    const bool is_first = all.group_time_s.empty();
    const auto groups = static_cast<std::uint32_t>(is_first ? 0 : all.group_time_s.size() - 1);
    require(v.leaves() < ~std::uint32_t{0} - leaves, "a plan has fewer than 2^32 leaves");
    for (std::size_t s = 1; s < v.first.size(); ++s) all.first.push_back(leaves + v.first[s]);
    for (const std::uint32_t group : v.group) all.group.push_back(group == 0 ? 0 : groups + group);
    append(all.begin, v.begin, 0);
    append(all.verdict, v.verdict, 0);
    append(all.group_heading_rad, v.group_heading_rad, is_first ? 0 : 1);
    append(all.group_time_s, v.group_time_s, is_first ? 0 : 1);
    append(all.group_next_mode, v.group_next_mode, is_first ? 0 : 1);
  }
  return all;
}

ContractVerdictsView mode_of_joined(const ContractVerdicts& joined, std::size_t sections,
                                    int mode) {
  ContractVerdictsView of = joined;
  of.first = of.first.subspan(sections * static_cast<std::size_t>(mode - 1), sections + 1);
  return of;
}

ContractModesProof prove_contract_modes(const Flow& flow, std::span<const float* const> further_rad,
                                        const VehicleContract& contract, int per_cell,
                                        const EstimateError& error, const ContractMode& first,
                                        const InclusionLimits& limits,
                                        const std::function<void(int mode)>& progress) {
  require(further_rad.size() < most_modes, "a plan has fewer modes");
  const double speed_mps = contract.speed_mps.least;
  ContractModesProof proof;
  std::vector<std::unique_ptr<const ReachBoxes>> boxes;
  std::vector<const ReachBoxes*> earlier;
  const auto add_boxes = [&](const Parts& parts, const ContractVerdictsView& verdicts) {
    boxes.push_back(std::make_unique<const ReachBoxes>(parts, verdicts, speed_mps));
    earlier.push_back(boxes.back().get());
  };
  add_boxes(first.parts, first.verdicts);
  for (const float* heading_rad : further_rad) {
    progress(static_cast<int>(earlier.size()));
    Flow mode = flow;
    mode.heading_rad = heading_rad;
    mode.holding = nullptr;
    auto made = std::make_unique<ProvedContractMode>(
        ProvedContractMode{Parts(mode, contract, per_cell), {}});
    InclusionProver prover(made->parts, limits);
    prover.hand_over_to(earlier, error, speed_mps);
    if (!prover.run([](const InclusionLevel&) {})) proof.stopped_by_limit = true;
    made->verdicts = reaching_only(prover.verdicts(speed_mps));
    add_boxes(made->parts, made->verdicts);
    proof.further.push_back(std::move(made));
  }
  return proof;
}

}  // namespace fairway
