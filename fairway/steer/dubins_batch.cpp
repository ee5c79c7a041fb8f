// Many shortest lengths at once. A block of pairs goes through the four words with a straight part
// without a branch, several pairs to an instruction; those for which RLR or LRL could be shorter
// are gathered and go through these two in the same way. Compiled for AVX-512, AVX2 and the
// baseline machine, chosen when the program starts; no operation is fused, so the bits are the
// same.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/steer/dubins_cases.hpp"
#include "fairway/steer/dubins_words.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FAIRWAY_WIDE [[gnu::target_clones("arch=x86-64-v4", "avx2", "default")]]
#else
#define FAIRWAY_WIDE
#endif

namespace fairway {
namespace {

using namespace dubins;

constexpr std::size_t block = 256;

/// A block's inputs, copied so that the compiler sees arrays that do not overlap.
struct Block {
  std::array<double, block> x0, y0, h0, x1, y1, h1;
  std::array<double, block> length;  ///< of the best word with a straight part, radii
  std::array<double, block> bound;   ///< of RLR and LRL

  [[gnu::always_inline]] Poses poses(std::size_t i, double turn_radius_m) const {
    return {x0[i], y0[i], h0[i], x1[i], y1[i], h1[i], turn_radius_m};
  }
};

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }

[[gnu::always_inline]] inline double lsr_length(const Pair<double>& p) {
  const Plane<double> lr = p.lr();
  const double square = crossing_square(p, lr);
  const double straight = std::sqrt(square < 0.0 ? 0.0 : square);
  const double turn = lsr_turn(p, lr, straight);
  const double length = straight + turn + lsr_last(p, turn);
  return square >= 0.0 ? length : std::numeric_limits<double>::infinity();
}

FAIRWAY_WIDE void straight_words(Block& b, double turn_radius_m) {
  for (std::size_t i = 0; i < block; ++i) {
    const Pair<double> pair = pair_of(b.poses(i, turn_radius_m));
    const Pair<double> mirror = mirrored(pair);
    double length = least(lsl_length(pair), lsl_length(mirror));
    length = least(length, least(lsr_length(pair), lsr_length(mirror)));
    b.bound[i] =
        least(lrl_bound(std::sqrt(norm2(pair.ll()))), lrl_bound(std::sqrt(norm2(mirror.ll()))));
    const bool fits = (std::abs(pair.d.x) <= farthest_radii) &
                      (std::abs(pair.d.y) <= farthest_radii) & (std::abs(b.h0[i]) <= pi) &
                      (std::abs(b.h1[i]) <= pi);
    b.length[i] = fits ? length : std::numeric_limits<double>::quiet_NaN();
  }
}

[[gnu::always_inline]] inline double wide_lrl_length(const Pair<double>& p) {
  const Plane<double> ll = p.ll();
  const double length = std::sqrt(norm2(ll));
  const bool possible = (length < 4.0) & (length > 0.0);
  const double within = possible ? length : 1.0;
  const double parts = lrl_length(p, three_circles_of(ll, within));
  return possible ? parts : std::numeric_limits<double>::infinity();
}

/// Improves `length`; `bound` becomes -1 where more digits are needed.
FAIRWAY_WIDE void three_turns(Block& b, double turn_radius_m) {
  for (std::size_t i = 0; i < block; ++i) {
    const Pair<double> pair = pair_of(b.poses(i, turn_radius_m));
    const Pair<double> mirror = mirrored(pair);
    const bool near = is_nearly_straight(std::sqrt(norm2(pair.ll()))) |
                      is_nearly_straight(std::sqrt(norm2(mirror.ll())));
    const double length = least(wide_lrl_length(pair), wide_lrl_length(mirror));
    b.bound[i] = near ? -1.0 : 0.0;
    b.length[i] = near ? b.length[i] : least(b.length[i], length);
  }
}

double in_more_digits(const Block& b, std::size_t i, double turn_radius_m) {
  const Poses poses = b.poses(i, turn_radius_m);
  const Pair<double> pair = pair_of(poses);
  return least(b.length[i],
               least(lrl_length(mirrored(poses), mirrored(pair)), lrl_length(poses, pair)));
}

/// Collects the pairs for which three turns may be shorter, processes them when the block is full,
/// and stores their lengths in place.
class ThreeTurns {
 public:
  ThreeTurns(double turn_radius_m, std::span<double> length_m)
      : turn_radius_m_(turn_radius_m), length_m_(length_m) {}

  void add(const Block& from, std::size_t i, std::size_t place) {
    const std::size_t k = count_++;
    block_.x0[k] = from.x0[i];
    block_.y0[k] = from.y0[i];
    block_.h0[k] = from.h0[i];
    block_.x1[k] = from.x1[i];
    block_.y1[k] = from.y1[i];
    block_.h1[k] = from.h1[i];
    block_.length[k] = from.length[i];
    place_[k] = place;
    if (count_ == block) finish();
  }
  void finish() {
    if (count_ == 0) return;
    three_turns(block_, turn_radius_m_);
    for (std::size_t k = 0; k < count_; ++k) {
      const double length =
          block_.bound[k] < 0.0 ? in_more_digits(block_, k, turn_radius_m_) : block_.length[k];
      length_m_[place_[k]] = turn_radius_m_ * length;
    }
    count_ = 0;
  }

 private:
  Block block_{};
  std::array<std::size_t, block> place_{};
  std::size_t count_ = 0;
  double turn_radius_m_;
  std::span<double> length_m_;
};

void fill(std::array<double, block>& place, std::span<const double> from, std::size_t begin,
          std::size_t count) {
  std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(begin), count, place.begin());
  std::fill(place.begin() + static_cast<std::ptrdiff_t>(count), place.end(), 0.0);
}

}  // namespace

void shortest_lengths_m(const PoseArrays& from, const PoseArrays& to, double turn_radius_m,
                        std::span<double> length_m) {
  const std::size_t size = length_m.size();
  for (const auto& array : {from.x_m, from.y_m, from.heading_rad, to.x_m, to.y_m, to.heading_rad}) {
    require(array.size() == size, "the arrays are equally long");
  }
  require(can_steer({}, {}, turn_radius_m), "the turning radius is positive and finite");
  const std::size_t blocks = (size + block - 1) / block;
  for_ranges(blocks, 8, [&](std::size_t first, std::size_t last) {
    Block b;
    ThreeTurns three(turn_radius_m, length_m);
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t begin = k * block;
      const std::size_t count = std::min(block, size - begin);
      fill(b.x0, from.x_m, begin, count);
      fill(b.y0, from.y_m, begin, count);
      fill(b.h0, from.heading_rad, begin, count);
      fill(b.x1, to.x_m, begin, count);
      fill(b.y1, to.y_m, begin, count);
      fill(b.h1, to.heading_rad, begin, count);
      straight_words(b, turn_radius_m);
      for (std::size_t i = 0; i < count; ++i) {
        if (b.bound[i] < b.length[i]) {
          three.add(b, i, begin + i);
        } else {
          length_m[begin + i] = turn_radius_m * b.length[i];
        }
      }
    }
    three.finish();
  });
}

}  // namespace fairway
