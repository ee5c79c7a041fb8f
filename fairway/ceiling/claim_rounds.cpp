#include "fairway/ceiling/claim_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fairway/base/parallel.hpp"

// The claims are whole numbers, so the same on every machine, however many it takes at a time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FAIRWAY_WIDE_WHERE_POSSIBLE [[gnu::target_clones("default", "avx2")]]
#else
#define FAIRWAY_WIDE_WHERE_POSSIBLE
#endif

namespace fairway {
namespace {

/// A claim that falls by less than this falls by this: without it, claims creep for ever.
constexpr int fall = 4;
/// How often a node's claim is widened by those about it, each round.
constexpr int rings = 3;

struct TilePlace {
  int k = 0;
  int y0 = 0;
  int x0 = 0;
};

TilePlace place_of(const BallLattice& l, std::uint32_t tile) {
  const auto across = static_cast<std::uint32_t>(l.tiles_x);
  const auto down = static_cast<std::uint32_t>(l.tiles_y);
  return {static_cast<int>(tile / across / down),
          static_cast<int>(tile / across % down) * tile_rows,
          static_cast<int>(tile % across) * tile_columns};
}

/// Half a row of a tile, which the compiler takes as many claims at a time as the processor can.
using Lanes [[gnu::vector_size(tile_columns)]] = Radius;
constexpr int lanes = tile_columns / 2;

inline void load(Lanes& to, const Radius* from) { std::memcpy(&to, from, sizeof to); }

/// best[i] = the greatest of the claims at the ends, less what they cost.
FAIRWAY_WIDE_WHERE_POSSIBLE void greatest_after(const Radius* from, std::ptrdiff_t stride,
                                                const StepEnd* end, std::size_t ends,
                                                Radius* best) {
  Lanes left{};
  Lanes right{};
  for (std::size_t e = 0; e < ends; ++e, ++end) {
    const Radius* there = from + end->rows * stride + end->columns;
    Lanes a;
    Lanes b;
    load(a, there);
    load(b, there + lanes);
    a -= end->cost;
    b -= end->cost;
    left = a > left ? a : left;
    right = b > right ? b : right;
  }
  std::memcpy(best, &left, sizeof left);
  std::memcpy(best + lanes, &right, sizeof right);
}

/// A tile and what lies about it: one node more than the rings need, for at the window's edge
/// widen_once takes what is no neighbour, or does nothing.
struct Window {
  static constexpr int columns = tile_columns + lanes;
  static constexpr int left = lanes / 2;
  static constexpr int low = rings + 1;
  static constexpr int rows = tile_rows + 2 * low;
  Radius values[rows * columns];
};

/// Claims that cover the squares of a node and of those about it also cover what lies beyond them.
/// Where all reach m, at least to the corners of their squares, the union of their discs holds the
/// disc of m + 0.87 spacings: its border is nearest where the discs of two neighbours cross, at
/// hypot(1 + sqrt(m^2 - 1/4), 1/2), with m >= 1 / sqrt(2).
struct Widening {
  Radius covers = 0;
  Radius gains = 0;

  explicit Widening(const BallLattice& l)
      : covers(static_cast<Radius>(std::ceil(0.70711 * l.spacing * units_per_turn_radius))),
        gains(static_cast<Radius>(std::floor(0.87 * l.spacing * units_per_turn_radius))) {}
};

/// One ring.
FAIRWAY_WIDE_WHERE_POSSIBLE void widen_once(Window& w, Window& scratch, Radius covers,
                                            Radius gains) {
  constexpr int size = Window::rows * Window::columns;
  static_assert(size % lanes == 0);
  // The least of three along rows, then along columns.
  for (int i = lanes; i + lanes <= size - lanes; i += lanes) {
    Lanes a;
    Lanes b;
    Lanes c;
    load(a, w.values + i - 1);
    load(b, w.values + i);
    load(c, w.values + i + 1);
    a = a < b ? a : b;
    a = a < c ? a : c;
    std::memcpy(scratch.values + i, &a, sizeof a);
  }
  for (int i = Window::columns + lanes; i + lanes <= size - Window::columns - lanes; i += lanes) {
    Lanes a;
    Lanes b;
    Lanes c;
    Lanes now;
    load(a, scratch.values + i - Window::columns);
    load(b, scratch.values + i);
    load(c, scratch.values + i + Window::columns);
    load(now, w.values + i);
    a = a < b ? a : b;
    a = a < c ? a : c;
    Lanes wider = a + gains;
    const Lanes widest = Lanes{} + static_cast<Radius>(widest_claim);
    wider = wider < widest ? wider : widest;
    wider = a >= covers ? wider : Lanes{};
    now = now > wider ? now : wider;
    std::memcpy(w.values + i, &now, sizeof now);
  }
}

class Settling {
 public:
  explicit Settling(ClaimRounds& r)
      : r_(r), l_(r.lattice), first_(r.claims), changed_(l_.tiles(), 0), stepped_(l_.tiles(), 0) {
    for (const std::uint32_t tile : r_.open) changed_[tile] = 1;
    work_.assign(r_.open.size(), 1);
  }

  bool settle(const std::function<bool()>& stop) {
    bool begun = false;
    while (choose(begun)) {
      if (stop()) return false;
      begun = true;
      step();
      widen();
    }
    return true;
  }

 private:
  bool choose(bool begun) {
    if (!begun) return !r_.open.empty();
    for_ranges(r_.open.size(), 64, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) work_[i] = reads_change(r_.open[i]) ? 1 : 0;
    });
    return std::find(work_.begin(), work_.end(), 1) != work_.end();
  }

  [[nodiscard]] bool reads_change(std::uint32_t tile) const {
    const TilePlace p = place_of(l_, tile);
    const auto& reach = r_.steps.reach[static_cast<std::size_t>(p.k)];
    const int left = std::max(0, p.x0 + reach.left) / tile_columns;
    const int right =
        std::min(l_.tiles_x - 1, (p.x0 + tile_columns - 1 + reach.right) / tile_columns);
    const int low = std::max(0, p.y0 + reach.down) / tile_rows;
    const int high = std::min(l_.tiles_y - 1, (p.y0 + tile_rows - 1 + reach.up) / tile_rows);
    for (int d = -l_.turn_bins; d <= l_.turn_bins; ++d) {
      for (int ty = low; ty <= high; ++ty) {
        for (int tx = left; tx <= right; ++tx) {
          if (changed_[l_.tile(l_.bin(p.k + d), ty, tx)] != 0) return true;
        }
      }
    }
    return false;
  }

  void step() {
    for_ranges(r_.open.size(), 4, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        stepped_[r_.open[i]] = work_[i] != 0 && step_tile(i) ? 1 : 0;
      }
    });
  }

  bool step_tile(std::size_t open) {
    const std::uint32_t tile = r_.open[open];
    const TilePlace p = place_of(l_, tile);
    const TileClaims after = claims_after_step(r_, tile);
    bool changed = false;
    for (int row = 0; row < tile_rows; ++row) {
      Radius* now = &first_[l_.at(p.k, p.y0 + row, p.x0)];
      for (int i = 0; i < tile_columns; ++i) {
        const auto q = static_cast<std::size_t>(row * tile_columns + i);
        const int least = r_.least[open][q];
        int next = std::max<int>(least, std::min(r_.most[open][q], after[q]));
        if (r_.every) {
          if (next >= now[i]) continue;
          next = std::max(least, next / fall * fall);
        } else if (next <= now[i]) {
          continue;
        }
        now[i] = static_cast<Radius>(next);
        changed = true;
      }
    }
    return changed;
  }

  void widen() {
    std::fill(changed_.begin(), changed_.end(), 0);
    for_ranges(r_.open.size(), 16, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const TilePlace p = place_of(l_, r_.open[i]);
        if (stepped_nearby(p)) changed_[r_.open[i]] = widen_tile(p) ? 1 : 0;
      }
    });
  }

  [[nodiscard]] bool stepped_nearby(const TilePlace& p) const {
    const int tx = p.x0 / tile_columns;
    const int ty = p.y0 / tile_rows;
    for (int j = std::max(0, ty - 1); j <= std::min(l_.tiles_y - 1, ty + 1); ++j) {
      for (int i = std::max(0, tx - 1); i <= std::min(l_.tiles_x - 1, tx + 1); ++i) {
        if (stepped_[l_.tile(p.k, j, i)] != 0) return true;
      }
    }
    return false;
  }

  bool widen_tile(const TilePlace& p) {
    Window w;
    Window scratch;
    for (int row = 0; row < Window::rows; ++row) {
      std::memcpy(w.values + row * Window::columns,
                  &first_[l_.at(p.k, p.y0 + row - Window::low, p.x0 - Window::left)],
                  Window::columns * sizeof(Radius));
    }
    for (int ring = 0; ring < rings; ++ring)
      widen_once(w, scratch, widening_.covers, widening_.gains);
    bool changed = false;
    for (int row = 0; row < tile_rows; ++row) {
      const Radius* wide = w.values + (row + Window::low) * Window::columns + Window::left;
      Radius* out = &r_.claims[l_.at(p.k, p.y0 + row, p.x0)];
      if (std::memcmp(wide, out, tile_columns * sizeof(Radius)) == 0) continue;
      std::memcpy(out, wide, tile_columns * sizeof(Radius));
      changed = true;
    }
    return changed;
  }

  ClaimRounds& r_;
  const BallLattice& l_;
  const Widening widening_{l_};
  /// The claims that follow from a step, not yet widened: what widened ones are made of, so that
  /// none of these can support itself.
  std::vector<Radius> first_;
  std::vector<std::uint8_t> changed_;  // [tile]: its claims, in the last round
  std::vector<std::uint8_t> stepped_;  // [tile]: its first claims, in this round
  std::vector<std::uint8_t> work_;     // [open]
};

}  // namespace

TileClaims claims_after_step(const ClaimRounds& r, std::uint32_t tile) {
  const BallLattice& l = r.lattice;
  const TilePlace p = place_of(l, tile);
  TileClaims after;
  after.fill(static_cast<Radius>(r.every ? widest_claim : 0));
  Radius best[tile_columns];
  for (int row = 0; row < tile_rows; ++row) {
    Radius* out = after.data() + row * tile_columns;
    for (int d = 0; d <= 2 * l.turn_bins; ++d) {
      const auto& ends = r.steps.ends[static_cast<std::size_t>(p.k)][static_cast<std::size_t>(d)];
      const Radius* from = &r.claims[l.at(l.bin(p.k + d - l.turn_bins), p.y0 + row, p.x0)];
      greatest_after(from, l.stride, ends.data(), ends.size(), best);
      for (int i = 0; i < tile_columns; ++i) {
        out[i] = r.every ? std::min(out[i], best[i]) : std::max(out[i], best[i]);
      }
    }
  }
  return after;
}

bool settle(ClaimRounds& rounds, const std::function<bool()>& stop) {
  return Settling(rounds).settle(stop);
}

}  // namespace fairway
