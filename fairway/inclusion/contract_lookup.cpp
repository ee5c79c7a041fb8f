#include "fairway/inclusion/contract_lookup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace fairway {
namespace {

constexpr double units = 0x1p32;

unsigned bit(std::uint8_t verdict) { return 1U << verdict; }

}  // namespace

ContractAnswer contract_answer(const Parts& parts, const ContractVerdictsView& verdicts,
                               double speed_least_mps, Vec2 place, double heading_rad,
                               const BehaviourOptions& options) {
  const BehaviourImage image = image_of_state(parts, place, heading_rad, options);
  ContractAnswer answer;
  const double seconds = parts.part_m() / speed_least_mps;
  unsigned found = image.ends | (image.gave_up ? bit(0) : 0U);
  answer.worst_time_s = image.flown * seconds;
  for (const Crossing& crossing : image.crossings) {
    const std::size_t section =
        4 * parts.index(crossing.part) + static_cast<std::size_t>(crossing.side);
    const auto first = verdicts.begin.begin() + verdicts.first[section];
    const auto last = verdicts.begin.begin() + verdicts.first[section + 1];
    auto at = std::upper_bound(first, last, crossing.lo * units,
                               [](double lo, std::uint32_t begin) { return lo < begin; });
    if (first == last) found |= bit(0);
    if (at != first) --at;
    // The last that begins at `lo` or before, and those that begin before `hi`.
    for (bool next = true; at != last && next; ++at) {
      next = at + 1 != last && at[1] < crossing.hi * units;
      const auto leaf = static_cast<std::size_t>(at - verdicts.begin.begin());
      found |= bit(verdicts.verdict[leaf]);
      answer.worst_time_s =
          std::max(answer.worst_time_s,
                   crossing.flown * seconds +
                       static_cast<double>(verdicts.group_time_s[verdicts.group[leaf]]));
      if (verdicts.verdict[leaf] == 0 && answer.undecided_section == ContractAnswer::no_section) {
        answer.undecided_section = section;
        answer.undecided_place = std::max(crossing.lo, *at / units);
      }
    }
  }
  answer.possible = static_cast<std::uint8_t>(found);
  if (std::has_single_bit(found)) answer.verdict = static_cast<Verdict>(std::countr_zero(found));
  if (answer.verdict == Verdict::undecided) {
    answer.worst_time_s = std::numeric_limits<double>::infinity();
  }
  return answer;
}

ContractAnswer contract_answer(const Grid& grid, const Parts& parts,
                               const ContractVerdictsView& verdicts, double speed_least_mps,
                               Vec2 position_m, double heading_rad) {
  const Vec2 off_m = position_m - Vec2{grid.x0_m, grid.y0_m};
  const double far_m = 1e6 * grid.cell_m;  // so far outside, numbers of parts no longer fit
  if (std::abs(off_m.x) > far_m || std::abs(off_m.y) > far_m) {
    ContractAnswer left;
    left.verdict = Verdict::leave;
    left.possible = static_cast<std::uint8_t>(bit(static_cast<std::uint8_t>(Verdict::leave)));
    return left;
  }
  const Vec2 place{off_m.x / parts.part_m(), off_m.y / parts.part_m()};
  return contract_answer(parts, verdicts, speed_least_mps, place, heading_rad);
}

}  // namespace fairway
