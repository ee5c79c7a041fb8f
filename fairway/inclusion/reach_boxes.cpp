#include "fairway/inclusion/reach_boxes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/crossing_graph.hpp"
#include "fairway/inclusion/part_pieces.hpp"

namespace fairway {
namespace {

constexpr std::uint64_t bins = 64;
constexpr double bin_rad = whole_turn_rad / bins;
constexpr std::uint64_t hints = 256;
constexpr std::uint64_t keys_in_part = bins + hints;
constexpr unsigned time_bits = 16;
constexpr int least_log2 = 12;
constexpr int most_log2 = 22;

/// The upper half of a float that is not less.
std::uint64_t code_of_time(double time_s) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto bits =
      std::bit_cast<std::uint32_t>(std::nextafter(static_cast<float>(time_s), infinite));
  return (bits + 0xffffU) >> time_bits;
}
double time_of_code(std::uint64_t code) {
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(code << time_bits)));
}

}  // namespace

ReachBoxes::ReachBoxes(const Parts& parts, const ContractVerdictsView& verdicts,
                       double speed_least_mps)
    : parts_(parts),
      verdicts_(verdicts),
      speed_least_mps_(speed_least_mps),
      quick_(parts, verdicts, speed_least_mps / generous),
      size_log2_(std::clamp(static_cast<int>(std::bit_width(bins * parts.size() / 4)), least_log2,
                            most_log2)),
      known_(std::make_unique<std::atomic<std::uint64_t>[]>(std::size_t{1} << size_log2_)) {}

double ReachBoxes::time_s(PartPlace part, const ConvexSet& set, const HeadingArc& headings) const {
  const double from = std::floor(headings.lo_rad / bin_rad);
  const double to = std::floor(headings.hi_rad() / bin_rad);
  double worst_s = 0.0;
  for (double k = from; k <= std::min(to, from + bins - 1.0); ++k) {
    const auto bin = static_cast<std::uint64_t>(static_cast<std::int64_t>(k)) % bins;
    worst_s = std::max(worst_s, box_time_s(part, bin));
    if (worst_s == not_proved) return flown_time_s(part, set, headings);
  }
  return worst_s;
}

/// `key`: not 0. What is known under another key that takes its place is found again when asked.
template <typename Find>
double ReachBoxes::known_or(std::uint64_t key, const Find& find) const {
  std::uint64_t mixed = key * 0x9e3779b97f4a7c15U;
  mixed ^= mixed >> 29U;
  mixed *= 0xbf58476d1ce4e5b9U;
  auto& known = known_[mixed >> static_cast<unsigned>(64 - size_log2_)];
  std::uint64_t word = known.load(std::memory_order_relaxed);
  if (word >> time_bits != key) {
    word = key << time_bits | code_of_time(find());
    known.store(word, std::memory_order_relaxed);
  }
  return time_of_code(word & 0xffffU);
}

double ReachBoxes::box_time_s(PartPlace part, std::uint64_t bin) const {
  return known_or(1 + parts_.index(part) * keys_in_part + bin, [&] {
    const auto [low, high] = grown_box(part);
    Vec2 corners[]{low, {high.x, low.y}, {low.x, high.y}, high};
    const HeadingArc headings{static_cast<double>(bin) * bin_rad, bin_rad};
    return flown_time_s(part, ConvexSet::hull(corners), headings.widened(heading_slack_rad));
  });
}

bool ReachBoxes::may_reach(PartPlace part, double heading_rad) const {
  constexpr double hint_rad = whole_turn_rad / hints;
  const auto bin =
      std::min(static_cast<std::uint64_t>(counted_from_zero(heading_rad) / hint_rad), hints - 1);
  const double time_s = known_or(1 + parts_.index(part) * keys_in_part + bins + bin, [&] {
    const Vec2 middle{part.ix + 0.5, part.iy + 0.5};
    const ContractAnswer answer =
        quick_.answer(middle, (static_cast<double>(bin) + 0.5) * hint_rad);
    return answer.verdict == Verdict::reach ? 0.0 : not_proved;
  });
  return time_s != not_proved;
}

/// In pieces of few headings. A flight of many headings at once may tell less than those of its
/// pieces: where a side is chosen depends on the steps of its clock. Whoever checks flies others,
/// and what is so near to failing is better left alone.
double ReachBoxes::flown_time_s(PartPlace part, const ConvexSet& set,
                                const HeadingArc& headings) const {
  const double pieces = std::max(1.0, std::ceil(headings.width_rad / bin_rad - 1e-3));
  const double width_rad = headings.width_rad / pieces;
  double worst_s = 0.0;
  for (double k = 0.0; k < pieces && worst_s < not_proved; ++k) {
    const HeadingArc piece{headings.lo_rad + k * width_rad, width_rad};
    worst_s = std::max(worst_s, piece_time_s(part, set, piece.widened(heading_slack_rad)));
  }
  return worst_s;
}

double ReachBoxes::piece_time_s(PartPlace part, const ConvexSet& set,
                                const HeadingArc& headings) const {
  // Of what is flown here, as of links: whoever checks may add it up in another way.
  const QuickLookup::SetReach quick = quick_.reach(part, set, headings);
  if (quick.reaches == QuickLookup::Reaches::yes) return quick.time_s;
  if (quick.reaches == QuickLookup::Reaches::no) return not_proved;
  const ContractAnswer answer =
      contract_answer(parts_, verdicts_, speed_least_mps_ / generous, part, set, headings);
  return answer.verdict == Verdict::reach ? answer.worst_time_s : not_proved;
}

}  // namespace fairway
