#include "fairway/verify/bitmap_backward.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>

#include "fairway/base/parallel.hpp"
#include "fairway/verify/bitmap_graph.hpp"

namespace fairway {
namespace {

/// Two bits a state while at work: whether its answer is known, and the answer. Both lie in one
/// word, so that a reader never sees one without the other. Threads write by a plain load and
/// store: when two write to one word at once the marks of one can get lost, whose states are then
/// worked out again with the same answer. That is far cheaper than locking every mark.
class Marks {
 public:
  explicit Marks(const BitmapGraph& graph)
      : states_per_border_(static_cast<std::size_t>(graph.samples().count()) *
                           static_cast<std::size_t>(graph.samples().count())),
        words_per_border_(2 * ((states_per_border_ + 63) / 64)),
        words_(graph.borders().count() * words_per_border_) {}

  /// A place is 32 times the word's number plus the state's number in the word.
  std::size_t place(std::size_t border, std::size_t state) const {
    return 32 * border * words_per_border_ + state;
  }
  BitmapEnd at(std::size_t place) {
    const std::uint64_t word = load(place / 32) >> (2 * (place % 32));
    return static_cast<BitmapEnd>(word & 3);
  }
  void mark(std::size_t place, BitmapEnd end) {
    const std::uint64_t bits = static_cast<std::uint64_t>(end) << (2 * (place % 32));
    std::atomic_ref<std::uint64_t> word(words_[place / 32]);
    word.store(word.load(std::memory_order_relaxed) | bits, std::memory_order_relaxed);
  }
  std::uint64_t load(std::size_t word) {
    return std::atomic_ref<std::uint64_t>(words_[word]).load(std::memory_order_relaxed);
  }
  std::size_t states_per_border() const { return states_per_border_; }

  /// One bit a state, in the same memory.
  BitmapWords take_reached() {
    const std::size_t count = words_.size() / 2;
    for (std::size_t i = 0; i < count; ++i)
      words_[i] = reached_bits(words_[2 * i]) | reached_bits(words_[2 * i + 1]) << 32;
    words_.shorten(count);
    return std::move(words_);
  }

 private:
  static_assert(static_cast<int>(BitmapEnd::reached) == 1 &&
                static_cast<int>(BitmapEnd::not_reached) == 2);

  /// Every second bit, gathered: the low halves of pairs, quadruples and so on move together.
  static std::uint64_t reached_bits(std::uint64_t w) {
    w &= 0x5555555555555555U;
    w = (w | w >> 1) & 0x3333333333333333U;
    w = (w | w >> 2) & 0x0f0f0f0f0f0f0f0fU;
    w = (w | w >> 4) & 0x00ff00ff00ff00ffU;
    w = (w | w >> 8) & 0x0000ffff0000ffffU;
    return (w | w >> 16) & 0x00000000ffffffffU;
  }

  std::size_t states_per_border_;
  std::size_t words_per_border_;
  BitmapWords words_;
};

/// Follows states until their answer is known. One per thread.
class Follower {
 public:
  Follower(const BitmapGraph& graph, Marks& marks)
      : graph_(graph), marks_(marks), rows_(kept_rows) {}

  void decide(BitmapGraph::Node node, std::size_t place) {
    path_.clear();
    std::size_t kept = ~std::size_t{0};  // Brent's cycle detection: compared with each new state
    std::size_t next_keep = 1;
    BitmapEnd end = graph_.end_of(node);
    while (end == BitmapEnd::none) {
      if (place == kept) {
        end = BitmapEnd::not_reached;
        break;
      }
      path_.push_back(place);
      if (path_.size() == next_keep) {
        kept = place;
        next_keep *= 2;
      }
      node = graph_.successor(node, row(node));
      end = graph_.end_of(node);
      if (end != BitmapEnd::none) break;
      place = place_of(node);
      end = marks_.at(place);
    }
    if (path_.empty()) path_.push_back(place);
    for (const std::size_t p : path_) marks_.mark(p, end);
  }

  std::size_t place_of(const BitmapGraph::Node& node) const {
    return marks_.place(graph_.border_of(node),
                        static_cast<std::size_t>(node.heading) *
                                static_cast<std::size_t>(graph_.samples().count()) +
                            static_cast<std::size_t>(node.position));
  }

 private:
  static constexpr std::size_t kept_rows = 512;
  struct KeptRow {
    std::uint64_t key = ~std::uint64_t{0};
    BitmapRow row;
  };

  /// Neighbouring states fly through the same rows: those of late are kept.
  const BitmapRow& row(const BitmapGraph::Node& node) {
    const std::uint64_t key =
        (static_cast<std::uint64_t>(node.place) * 4 + static_cast<std::uint64_t>(node.entry)) *
            8192 +
        static_cast<std::uint64_t>(node.heading);
    KeptRow& kept = rows_[(key * 0x9e3779b97f4a7c15U) >> 55];
    if (kept.key != key) {
      kept.key = key;
      kept.row = graph_.row_of(node);
    }
    return kept.row;
  }

  const BitmapGraph& graph_;
  Marks& marks_;
  std::vector<std::size_t> path_;
  std::vector<KeptRow> rows_;
};

/// Decides every state of the borders that is not yet known; answers how many there were.
std::size_t decide_borders(const BitmapGraph& graph, Marks& marks, std::size_t begin,
                           std::size_t end) {
  constexpr std::uint64_t low_bits = 0x5555555555555555U;
  Follower follower(graph, marks);
  const auto m = static_cast<std::size_t>(graph.samples().count());
  std::size_t found = 0;
  for (std::size_t border = begin; border < end; ++border) {
    const std::size_t first = marks.place(border, 0);
    for (std::size_t state = 0; state < marks.states_per_border(); state += 32) {
      const std::size_t here = std::min<std::size_t>(32, marks.states_per_border() - state);
      const std::uint64_t inside = here == 32 ? low_bits : low_bits & ((1ULL << (2 * here)) - 1);
      for (;;) {
        const std::uint64_t word = marks.load((first + state) / 32);
        const std::uint64_t unknown = ~(word | word >> 1) & inside;
        if (unknown == 0) break;
        const std::size_t s = state + static_cast<std::size_t>(std::countr_zero(unknown)) / 2;
        follower.decide(graph.node_at(border, static_cast<int>(s / m), static_cast<int>(s % m)),
                        first + s);
        ++found;
      }
    }
  }
  return found;
}

}  // namespace

BorderBitmap backward_reachable_set(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                                    const BitmapOptions& options) {
  const BitmapGraph graph(plan, target_cells, options.samples);
  Marks marks(graph);
  const std::size_t borders = graph.borders().count();
  for_ranges(borders, 16,
             [&](std::size_t begin, std::size_t end) { decide_borders(graph, marks, begin, end); });
  // Marks that got lost between threads; alone nothing gets lost.
  decide_borders(graph, marks, 0, borders);
  return {plan.grid, options.samples, marks.take_reached()};
}

}  // namespace fairway
