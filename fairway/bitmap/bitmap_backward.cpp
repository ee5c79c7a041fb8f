#include "fairway/bitmap/bitmap_backward.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>

#include "fairway/base/parallel.hpp"
#include "fairway/bitmap/bitmap_graph.hpp"

namespace fairway {
namespace {

/// Two bits a state during the computation: whether its answer is known, and the answer. Both lie
/// in one word, so that a reader never sees one without the other. Threads write by a plain load
/// and store: when two write to one word at once, the marks of one can get lost, and those states
/// are computed again with the same answer. That is far cheaper than locking every mark.
class Marks {
 public:
  explicit Marks(const BitmapGraph& graph)
      : states_per_border_(static_cast<std::size_t>(graph.samples().count()) *
                           static_cast<std::size_t>(graph.samples().count())),
        words_per_border_(2 * ((states_per_border_ + 63) / 64)),
        words_(graph.borders().count() * words_per_border_) {}

  /// A place is 32 times the word's index plus the state's index in the word.
  std::size_t place(std::size_t border, std::size_t state) const {
    return 32 * border * words_per_border_ + state;
  }
  BitmapEnd at(std::size_t place) {
    const std::uint64_t word = load(place / 32) >> (2 * (place % 32));
    return static_cast<BitmapEnd>(word & 3);
  }
  /// Adds marks to a word, laid out as the word is.
  void add(std::size_t word, std::uint64_t marks) {
    std::atomic_ref<std::uint64_t> all(words_[word]);
    all.store(all.load(std::memory_order_relaxed) | marks, std::memory_order_relaxed);
  }
  /// The lower bit of each state of a word that is not yet known.
  std::uint64_t unknown_in(std::size_t word) {
    const std::uint64_t w = load(word);
    return ~(w | w >> 1) & 0x5555555555555555U;
  }

  /// One bit a state, in the same memory.
  BitmapWords take_reached() {
    const std::size_t count = words_.size() / 2;
    for (std::size_t i = 0; i < count; ++i)
      words_[i] = reached_bits(words_[2 * i]) | reached_bits(words_[2 * i + 1]) << 32;
    words_.shorten(count);
    return std::move(words_);
  }

 private:
  std::uint64_t load(std::size_t word) {
    return std::atomic_ref<std::uint64_t>(words_[word]).load(std::memory_order_relaxed);
  }
  static_assert(static_cast<int>(BitmapEnd::reached) == 1 &&
                static_cast<int>(BitmapEnd::not_reached) == 2);

  /// Gathers every second bit: the low halves of pairs, quadruples and so on move together.
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

/// Computes answers for whole borders. One per thread.
class Follower {
 public:
  Follower(const BitmapGraph& graph, Marks& marks)
      : graph_(graph), marks_(marks), rows_(kept_rows) {}

  /// Marks every state of a border that is not yet known.
  void decide_border(std::size_t border) {
    const BitmapGraph::Border cells = graph_.border_at(border);
    const int m = graph_.samples().count();
    std::size_t place = marks_.place(border, 0);
    for (int k = 0; k < m; ++k, place += static_cast<std::size_t>(m))
      decide_row(graph_.node_at(cells, k, 0), place);
  }

 private:
  static constexpr std::size_t kept_rows = 512;
  struct KeptRow {
    std::uint64_t key = ~std::uint64_t{0};
    BitmapRow row;
  };

  /// The states of one heading, of which `node` is the first, at `first`. Most are decided by the
  /// next state; marks of one word are written together.
  void decide_row(BitmapGraph::Node node, std::size_t first) {
    const std::size_t end_place = first + static_cast<std::size_t>(graph_.samples().count());
    const BitmapEnd here = graph_.end_of(node);
    bool has_row = false;
    BitmapRow row;
    for (std::size_t place = first; place < end_place;) {
      const std::size_t word = place / 32;
      const std::size_t word_end = std::min(end_place, 32 * word + 32);
      std::uint64_t unknown = marks_.unknown_in(word) & (~std::uint64_t{0} << (2 * (place % 32)));
      if (word_end % 32 != 0) unknown &= (std::uint64_t{1} << (2 * (word_end % 32))) - 1;
      if (unknown != 0 && here == BitmapEnd::none && !has_row) {
        row = graph_.row_of(node);
        has_row = true;
      }
      std::uint64_t found = 0;
      for (; unknown != 0; unknown &= unknown - 1) {
        const int bit = std::countr_zero(unknown);
        node.position = static_cast<int>(32 * word + static_cast<std::size_t>(bit) / 2 - first);
        const BitmapEnd end = here == BitmapEnd::none ? decided(graph_.successor(node, row)) : here;
        found |= static_cast<std::uint64_t>(end) << bit;
      }
      if (found != 0) marks_.add(word, found);
      place = word_end;
    }
  }

  /// The answer for a state; marks what lies on the way to it.
  BitmapEnd decided(const BitmapGraph::Node& node) {
    const BitmapEnd end = graph_.end_of(node);
    if (end != BitmapEnd::none) return end;
    const std::size_t place = place_of(node);
    const BitmapEnd known = marks_.at(place);
    return known != BitmapEnd::none ? known : followed(node, place);
  }

  BitmapEnd followed(BitmapGraph::Node node, std::size_t place) {
    path_.clear();
    std::size_t kept = ~std::size_t{0};  // Brent's cycle detection: compared with each new state
    std::size_t next_keep = 1;
    BitmapEnd end = BitmapEnd::none;
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
      node = graph_.successor(node, row_of(node));
      end = graph_.end_of(node);
      if (end != BitmapEnd::none) break;
      place = place_of(node);
      end = marks_.at(place);
    }
    for (const std::size_t p : path_)
      marks_.add(p / 32, static_cast<std::uint64_t>(end) << (2 * (p % 32)));
    return end;
  }

  std::size_t place_of(const BitmapGraph::Node& node) const {
    return marks_.place(graph_.border_of(node),
                        static_cast<std::size_t>(node.heading) *
                                static_cast<std::size_t>(graph_.samples().count()) +
                            static_cast<std::size_t>(node.position));
  }

  /// Neighbouring states fly through the same rows: recent ones are kept.
  const BitmapRow& row_of(const BitmapGraph::Node& node) {
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

void decide_borders(const BitmapGraph& graph, Marks& marks, std::size_t begin, std::size_t end) {
  Follower follower(graph, marks);
  for (std::size_t border = begin; border < end; ++border) follower.decide_border(border);
}

}  // namespace

BorderBitmap backward_reachable_set(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                                    const BitmapOptions& options) {
  const BitmapGraph graph(plan, target_cells, options.samples);
  Marks marks(graph);
  const std::size_t borders = graph.borders().count();
  for_ranges(borders, 16,
             [&](std::size_t begin, std::size_t end) { decide_borders(graph, marks, begin, end); });
  // Recomputes marks lost between threads; a single thread loses none.
  decide_borders(graph, marks, 0, borders);
  return {plan.grid, options.samples, marks.take_reached()};
}

}  // namespace fairway
