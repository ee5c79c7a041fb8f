// Work over ranges on all threads. Results must not depend on how a range is cut; the command's
// --threads bounds the number of threads for the whole process (see app/).
#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace fairway {

#ifdef __SANITIZE_THREAD__
/// Tells the thread sanitizer what the TBB library, which is not built for it, does unseen: a piece
/// begins after the call of the loop, and the loop returns after every piece.
class LoopOrder {
 public:
  LoopOrder() { __tsan_release(&begin_); }
  ~LoopOrder() { __tsan_acquire(&end_); }
  void piece_begins() const { __tsan_acquire(const_cast<char*>(&begin_)); }
  void piece_ends() const { __tsan_release(const_cast<char*>(&end_)); }

 private:
  char begin_ = 0;
  char end_ = 0;
};
#else
struct LoopOrder {
  void piece_begins() const {}
  void piece_ends() const {}
};
#endif

/// Calls body(begin, end) over disjoint pieces of [0, count), each at least `grain` long.
template <typename Body>
void for_ranges(std::size_t count, std::size_t grain, const Body& body) {
  const LoopOrder order;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(1, grain)),
                    [&](const tbb::blocked_range<std::size_t>& r) {
                      order.piece_begins();
                      body(r.begin(), r.end());
                      order.piece_ends();
                    });
}

/// The same over rows of a grid, as ints.
template <typename Body>
void for_rows(int rows, const Body& body) {
  for_ranges(static_cast<std::size_t>(std::max(rows, 0)), 16,
             [&](std::size_t a, std::size_t b) { body(static_cast<int>(a), static_cast<int>(b)); });
}

}  // namespace fairway
