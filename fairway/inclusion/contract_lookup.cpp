#include "fairway/inclusion/contract_lookup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace fairway {
namespace {

constexpr double units = 0x1p32;

unsigned bit(std::uint8_t verdict) { return 1U << verdict; }

/// What the image of a state has come to so far.
class Finding {
 public:
  Finding(const Parts& parts, const ContractVerdictsView& verdicts, double part_s)
      : parts_(parts), verdicts_(verdicts), part_s_(part_s) {}

  /// Looks at what is new in the image.
  void look(const BehaviourImage& image) {
    found_ |= image.ends | (image.gave_up ? bit(0) : 0U);
    for (; seen_ < image.crossings.size(); ++seen_) look(image.crossings[seen_]);
    worst_time_s_ = std::max(worst_time_s_, image.flown * part_s_);
  }

  /// For good: whatever is found besides does not make one verdict of it.
  bool is_undecided() const {
    return (found_ & bit(0)) != 0 || (found_ != 0 && !std::has_single_bit(found_));
  }

  ContractAnswer answer() const {
    ContractAnswer answer = answer_;
    answer.possible = static_cast<std::uint8_t>(found_);
    if (std::has_single_bit(found_)) {
      answer.verdict = static_cast<Verdict>(std::countr_zero(found_));
    }
    answer.worst_time_s = answer.verdict == Verdict::undecided
                              ? std::numeric_limits<double>::infinity()
                              : worst_time_s_;
    return answer;
  }

 private:
  void look(const Crossing& crossing) {
    const std::size_t section =
        4 * parts_.index(crossing.part) + static_cast<std::size_t>(crossing.side);
    if (verdicts_.first[section] == verdicts_.first[section + 1]) found_ |= bit(0);
    for_leaves(verdicts_, section, crossing.lo, crossing.hi, [&](std::size_t leaf) {
      found_ |= bit(verdicts_.verdict[leaf]);
      worst_time_s_ = std::max(
          worst_time_s_, crossing.flown * part_s_ +
                             static_cast<double>(verdicts_.group_time_s[verdicts_.group[leaf]]));
      if (verdicts_.verdict[leaf] == 0 && answer_.undecided_section == ContractAnswer::no_section) {
        answer_.undecided_section = section;
        answer_.undecided_place = std::max(crossing.lo, verdicts_.begin[leaf] / units);
      }
    });
  }

  const Parts& parts_;
  const ContractVerdictsView& verdicts_;
  double part_s_;
  std::size_t seen_ = 0;  ///< of the crossings
  unsigned found_ = 0;
  double worst_time_s_ = 0.0;
  ContractAnswer answer_;
};

/// `image(options)`: the image, flown with these options.
template <typename Image>
ContractAnswer answer_of_image(const Parts& parts, const ContractVerdictsView& verdicts,
                               double speed_least_mps, const BehaviourOptions& options,
                               const Image& image) {
  Finding finding(parts, verdicts, parts.part_m() / speed_least_mps);
  const std::function<bool(const BehaviourImage&)> is_undecided =
      [&finding](const BehaviourImage& so_far) {
        finding.look(so_far);
        return finding.is_undecided();
      };
  BehaviourOptions until_undecided = options;
  until_undecided.is_enough = &is_undecided;
  finding.look(image(until_undecided));
  return finding.answer();
}

}  // namespace

ContractAnswer contract_answer(const Parts& parts, const ContractVerdictsView& verdicts,
                               double speed_least_mps, Vec2 place, double heading_rad,
                               const BehaviourOptions& options) {
  return answer_of_image(parts, verdicts, speed_least_mps, options,
                         [&](const BehaviourOptions& until_undecided) {
                           return image_of_state(parts, place, heading_rad, until_undecided);
                         });
}

ContractAnswer contract_answer(const Parts& parts, const ContractVerdictsView& verdicts,
                               double speed_least_mps, PartPlace part, const ConvexSet& set,
                               const HeadingArc& headings) {
  return answer_of_image(parts, verdicts, speed_least_mps, {},
                         [&](const BehaviourOptions& until_undecided) {
                           return image_of_states(parts, part, set, headings, until_undecided);
                         });
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
