#include "check/contract_hand_over.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "check/contract_rules.hpp"

namespace fairway_check {
namespace {

/// By which ends of arcs may differ from those of the certificate's author.
constexpr double along_slack = 0x1p-20;

/// The eight half-planes around all that is so near a segment along an axis.
Shape octagon_around(const Box& segment, double by) {
  const double tip = by * (std::numbers::sqrt2 - 1.0 + 0x1p-50);
  const auto& [x0, y0, x1, y1] = segment;
  return {{x0 - tip, y0 - by}, {x1 + tip, y0 - by}, {x1 + by, y0 - tip}, {x1 + by, y1 + tip},
          {x1 + tip, y1 + by}, {x0 - tip, y1 + by}, {x0 - by, y1 + tip}, {x0 - by, y0 - tip}};
}

}  // namespace

KnownBoxes::KnownBoxes(std::size_t parts)
    : size_log2_(std::clamp(static_cast<int>(std::bit_width(parts * per_turn / 4)), 12, 22)),
      known_(std::make_unique<std::atomic<std::uint64_t>[]>(std::size_t{1} << size_log2_)) {}

double KnownBoxes::seconds(const StatesOfPart& states,
                           const std::function<double(const StatesOfPart&)>& find) const {
  constexpr double box_rad = 2.0 * std::numbers::pi / per_turn;
  constexpr unsigned time_bits = 24;  // of a float, rounded up
  const auto from = static_cast<std::int64_t>(std::floor(states.least / box_rad));
  const auto to = static_cast<std::int64_t>(std::floor(states.most / box_rad));
  if (to - from >= static_cast<std::int64_t>(per_turn)) return HUGE_VAL;
  double worst = 0.0;
  for (std::int64_t k = from; k <= to && worst < HUGE_VAL; ++k) {
    const std::uint64_t bin = static_cast<std::uint64_t>(k) % per_turn;
    const std::uint64_t key = 1 + states.part * per_turn + bin;
    std::uint64_t mixed = key * 0x9e3779b97f4a7c15U;
    mixed ^= mixed >> 29U;
    mixed *= 0xbf58476d1ce4e5b9U;
    std::atomic<std::uint64_t>& known = known_[mixed >> static_cast<unsigned>(64 - size_log2_)];
    std::uint64_t word = known.load(std::memory_order_relaxed);
    if (word >> time_bits != key) {
      const Box whole = Box{0.0, 0.0, 1.0, 1.0}.grown(touch);
      const double least = box_rad * static_cast<double>(bin);
      const double found = find(
          {states.part,
           {{whole.x0, whole.y0}, {whole.x1, whole.y0}, {whole.x1, whole.y1}, {whole.x0, whole.y1}},
           least - angle_slack,
           least + box_rad + angle_slack});
      const auto rounded = std::nextafter(static_cast<float>(found), HUGE_VALF);
      word = key << time_bits | (std::bit_cast<std::uint32_t>(rounded) + 0xffU) >> 8U;
      known.store(word, std::memory_order_relaxed);
    }
    const auto code = static_cast<std::uint32_t>(word & 0xffffffU);
    worst = std::max(worst, static_cast<double>(std::bit_cast<float>(code << 8U)));
  }
  return worst;
}

bool for_states_around(const ContractCertificate& c, std::size_t section, std::size_t leaf,
                       const std::function<bool(const StatesOfPart&)>& visit) {
  const std::size_t own = section / 4;
  const int side = static_cast<int>(section % 4);
  const Arc arc = c.parts.arc[own];
  if (c.parts.kind[own] != ordinary || is_loose(arc, c.contract)) return false;
  double least = arc.right;
  double most = arc.right + arc.width;
  if (!point_outwards(side, least, most)) {
    // The author's arc may reach a little farther than this one, just over the side.
    least = arc.right - along_slack;
    most = arc.right + arc.width + along_slack;
    if (!point_outwards(side, least, most)) return false;
  }
  const double grown_rad = 2.0 * c.contract.heading_error + 4.0 * angle_slack;
  least -= grown_rad;
  most += grown_rad;
  const double grown = 2.0 * c.contract.estimate_error / c.parts.side_m + 4.0 * touch;
  const Shape ends = places_on(side, c.begin_of(leaf), c.end_of(section, leaf));
  const Shape around = octagon_around(ends.bounds(), grown);
  const Box box = around.bounds();
  const Cell at = c.parts.part_at(own);
  const auto below = [](double v) { return static_cast<int>(std::floor(v - touch)); };
  for (int y = below(box.y0); y <= static_cast<int>(std::floor(box.y1 + touch)); ++y) {
    for (int x = below(box.x0); x <= static_cast<int>(std::floor(box.x1 + touch)); ++x) {
      const Cell part{at.x + x, at.y + y};
      if (c.parts.kind_at(part) != ordinary) continue;  // there a flight has ended
      const Box of_part = Box{x + 0.0, y + 0.0, x + 1.0, y + 1.0}.grown(touch);
      const Shape piece = clipped(around, of_part);
      if (piece.empty()) continue;
      Shape there;
      for (const Point p : piece.corners()) there.add(p - Point{x + 0.0, y + 0.0});
      if (!visit({c.parts.index(part), there, least, most})) return false;
    }
  }
  return true;
}

}  // namespace fairway_check
