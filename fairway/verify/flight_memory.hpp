// What a flight remembers in order to conclude more than its current place allows: a struct and a
// rule for each lemma of docs/trust.md that needs it. Every state of the set did the same.
#pragma once

#include <cstddef>

#include "fairway/vehicle/side.hpp"

namespace fairway {

inline std::size_t section_of(std::size_t cell, Side side) {
  return 4 * cell + static_cast<std::size_t>(side);
}

namespace flight_memory {

inline constexpr std::size_t nowhere = ~std::size_t{0};

/// Lemma 5, the chord rule: a heading that is a command, or its mirror image in the border.
struct Hop {
  std::size_t came_off = nowhere;  ///< left this section in the previous step, ...
  std::size_t mirrored = nowhere;  ///< ... or came back over the same border on one arc
};

/// Lemma 5, several waves at once.
struct Wave {
  std::size_t began = nowhere;  ///< the border left at its start
  double length_m = 0.0;        ///< flown up to there
  bool half = false;            ///< the border has been crossed back since
};

/// Lemma 6.
struct Circle {
  std::size_t began = nowhere;  ///< the first border met on the current circle
};

/// The mirror image of the command in the border, turned back to the border on one arc, is the
/// command again, exactly there.
inline bool comes_back_as_the_command(const Hop& hop, std::size_t border) {
  return hop.mirrored == border;
}
/// `back`: the border just crossed while turning, named from the cell beyond it.
inline Hop after_turning_over(const Hop& hop, std::size_t back) {
  return {nowhere, hop.came_off == back ? back : nowhere};
}

/// The same border met twice on one circle, in the same direction: the same state again.
inline bool is_closed(const Circle& circle, std::size_t border) { return circle.began == border; }
inline Circle after_turning_over(const Circle& circle, std::size_t border) {
  return {circle.began == nowhere ? border : circle.began};
}

}  // namespace flight_memory

}  // namespace fairway
