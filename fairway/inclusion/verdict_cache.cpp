#include "fairway/inclusion/verdict_cache.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "fairway/inclusion/part_pieces.hpp"

namespace fairway {
namespace {

/// States nearer to a part's border belong to no box: they may be in the next part.
constexpr double border = 2.0 * place_slack;

struct BoxSize {
  int per_part;  ///< along a side
  int per_turn;
};
constexpr BoxSize sizes[]{{1, 16}, {4, 64}};
constexpr std::uint64_t most_in_part = 4 * 4 * 64;

constexpr int least_log2 = 12;
constexpr int most_log2 = 20;
constexpr std::uint64_t per_part_usually = 32;

// A word: key, verdict, time.
constexpr unsigned time_bits = 16;
constexpr unsigned answer_bits = time_bits + 4;

/// The upper half of a float that is not less.
std::uint64_t code_of_time(double time_s) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const std::uint32_t bits =
      std::bit_cast<std::uint32_t>(std::nextafter(static_cast<float>(time_s), infinite));
  return (bits + 0xffffU) >> 16U;
}
double time_of_code(std::uint64_t code) {
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(code << 16U)));
}

}  // namespace

struct VerdictCache::Box {
  PartPlace part;
  ::fairway::Box places;
  HeadingArc headings;
  std::uint64_t key = 0;  ///< not 0
};

VerdictCache::VerdictCache(const Parts& parts, const ContractVerdictsView& verdicts,
                           double speed_least_mps)
    : parts_(parts),
      verdicts_(verdicts),
      speed_least_mps_(speed_least_mps),
      size_log2_(std::clamp(static_cast<int>(std::bit_width(per_part_usually * parts.size())),
                            least_log2, most_log2)),
      known_(std::make_unique<std::atomic<std::uint64_t>[]>(std::size_t{1} << size_log2_)) {}

ContractAnswer VerdictCache::answer(Vec2 place, double heading_rad) const {
  const PartPlace part{static_cast<int>(std::floor(place.x)),
                       static_cast<int>(std::floor(place.y))};
  const Vec2 in{place.x - part.ix, place.y - part.iy};
  const bool near_border = std::min(in.x, in.y) < border || std::max(in.x, in.y) > 1.0 - border;
  if (!near_border && parts_.kind(part) == PartKind::ordinary) {
    const double turned = counted_from_zero(heading_rad) / whole_turn_rad;
    for (std::uint64_t level = 0; const BoxSize& size : sizes) {
      const auto number = [](double at, int count) {
        return std::min(static_cast<int>(at * count), count - 1);
      };
      const int kx = number(in.x, size.per_part);
      const int ky = number(in.y, size.per_part);
      const int kh = number(turned, size.per_turn);
      const double side = 1.0 / size.per_part;
      const auto from = [&](int corner, int k) {
        return corner + std::max(k * side - place_slack, border);
      };
      const auto to = [&](int corner, int k) {
        return corner + std::min((k + 1) * side + place_slack, 1.0 - border);
      };
      const double width = whole_turn_rad / size.per_turn;
      Box box{part,
              {{from(part.ix, kx), from(part.iy, ky)}, {to(part.ix, kx), to(part.iy, ky)}},
              HeadingArc{kh * width, width}.widened(heading_slack_rad),
              0};
      const auto in_part =
          static_cast<std::uint64_t>((kh * size.per_part + ky) * size.per_part + kx);
      box.key = 1 + (parts_.index(part) * std::size(sizes) + level++) * most_in_part + in_part;
      const ContractAnswer found = answer_of(box);
      if (found.verdict != Verdict::undecided) return found;
    }
  }
  return contract_answer(parts_, verdicts_, speed_least_mps_, place, heading_rad);
}

ContractAnswer VerdictCache::answer(const Grid& grid, Vec2 position_m, double heading_rad) const {
  const Vec2 place = (1.0 / parts_.part_m()) * (position_m - Vec2{grid.x0_m, grid.y0_m});
  const bool inside =
      place.x >= 0.0 && place.y >= 0.0 && place.x < parts_.nx() && place.y < parts_.ny();
  if (inside) return answer(place, heading_rad);
  return contract_answer(grid, parts_, verdicts_, speed_least_mps_, position_m, heading_rad);
}

ContractAnswer VerdictCache::answer_of(const Box& box) const {
  std::uint64_t mixed = box.key * 0x9e3779b97f4a7c15U;
  mixed ^= mixed >> 29U;
  mixed *= 0xbf58476d1ce4e5b9U;
  auto& known = known_[mixed >> static_cast<unsigned>(64 - size_log2_)];
  std::uint64_t word = known.load(std::memory_order_relaxed);
  if (word >> answer_bits != box.key) {
    const ContractAnswer flown = fly(box);
    word = box.key << answer_bits | static_cast<std::uint64_t>(flown.verdict) << time_bits |
           code_of_time(flown.worst_time_s);
    known.store(word, std::memory_order_relaxed);
  }
  ContractAnswer answer;
  answer.verdict = static_cast<Verdict>(word >> time_bits & 0xfU);
  answer.possible = static_cast<std::uint8_t>(1U << static_cast<unsigned>(answer.verdict));
  answer.worst_time_s = time_of_code(word & 0xffffU);
  return answer;
}

ContractAnswer VerdictCache::fly(const Box& box) const {
  const auto& [low, high] = box.places;
  Vec2 corners[]{low, {high.x, low.y}, {low.x, high.y}, high};
  return contract_answer(parts_, verdicts_, speed_least_mps_, box.part, ConvexSet::hull(corners),
                         box.headings);
}

}  // namespace fairway
