// Work over ranges on all threads. Results must not depend on how a range is split; the command's
// --threads limits the number of threads for the whole process (see app/).
#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#endif

namespace fairway {

/// Calls body(begin, end) over disjoint pieces of [0, count), each at least `grain` long.
template <typename Body>
void for_ranges(std::size_t count, std::size_t grain, const Body& body) {
  const std::size_t least = std::max<std::size_t>(1, grain);
#ifdef __SANITIZE_THREAD__
  // The thread sanitizer cannot see the synchronisation in Debian's TBB, which is not built for
  // it: under the sanitizer the pieces run on plain threads.
  const std::size_t pieces = std::clamp<std::size_t>(count / least, count > 0 ? 1 : 0, 4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < pieces; ++i) {
    threads.emplace_back([&, i] { body(count * i / pieces, count * (i + 1) / pieces); });
  }
  for (std::thread& thread : threads) thread.join();
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least),
                    [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); });
#endif
}

/// The same over rows of a grid, as ints.
template <typename Body>
void for_rows(int rows, const Body& body) {
  for_ranges(static_cast<std::size_t>(std::max(rows, 0)), 16,
             [&](std::size_t a, std::size_t b) { body(static_cast<int>(a), static_cast<int>(b)); });
}

}  // namespace fairway
