#include "fairway/field/eikonal.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thread>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

// Inside the solver, distances are measured in waves: a cell's side is 3/2 waves, so that a wave is
// thinner than the 1/sqrt(2) cell by which values grow, and the side is exact in float.
constexpr float side = 1.5F;
constexpr float diagonal = 2.12132034F;      // 1.5 sqrt(2)
constexpr float largest_drop = 1.06066017F;  // 1.5 / sqrt(2): beyond it the diagonal alone wins
constexpr float cells_per_wave = 1.0F / side;
constexpr float unreached = std::numeric_limits<float>::infinity();
constexpr std::size_t slots = 4;  // a step reaches at most three waves ahead: 1 + 2.13
constexpr std::size_t finished = std::numeric_limits<std::size_t>::max();
constexpr std::size_t shared_wave_cells = 256;
constexpr std::size_t last_wave = std::size_t{1}
                                  << 22;  // whole waves are exact in float up to here

// Threads meet here after every wave they share. Waves are short (microseconds), so they spin
// first; on a busy machine they then sleep, leaving the processor to the thread they wait for.
class WaveBarrier {
 public:
  explicit WaveBarrier(int threads) : threads_(threads) {}
  void wait() {
    const int phase = phase_.load(std::memory_order_acquire);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
      arrived_.store(0, std::memory_order_relaxed);
      phase_.store(phase + 1, std::memory_order_release);
      phase_.notify_all();
      return;
    }
    for (int spins = 0; spins < 4000; ++spins) {
      if (phase_.load(std::memory_order_acquire) != phase) return;
    }
    phase_.wait(phase, std::memory_order_acquire);
  }

 private:
  int threads_;
  std::atomic<int> arrived_{0};
  std::atomic<int> phase_{0};
};

using CellList = std::vector<std::uint32_t>;

class WaveFront {
 public:
  WaveFront(std::vector<float>& u, std::size_t stride, std::vector<CellList> starts, int threads)
      : u_(u.data()),
        stride_(static_cast<std::ptrdiff_t>(stride)),
        starts_(std::move(starts)),
        lists_(static_cast<std::size_t>(threads)),
        barrier_(threads) {
    if (!starts_.empty()) lists_[0].cells[0] = starts_[0];
  }

  void run() {
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < lists_.size(); ++t) others.emplace_back([this, t] { work(t); });
    work(0);
    for (std::thread& other : others) other.join();
  }

 private:
  struct alignas(128) ThreadLists {
    std::array<CellList, slots> cells;
  };

  // Every thread runs the same loop and reads the same counts, so all leave it together. A list is
  // written only by its owner, and read by all in the wave it belongs to, when nobody writes it.
  // Narrow waves (in a corridor) are spread by thread 0 alone while the others wait: meeting after
  // each would take longer than the work.
  void work(std::size_t thread) {
    std::size_t wave = 0;
    while (wave != finished) {
      if (lists_.size() > 1 && wave < last_wave && cells_of(wave) >= shared_wave_cells) {
        if (thread == 0) start_wave(wave + 1);
        spread_share(wave, thread);
        barrier_.wait();
        lists_[thread].cells[wave % slots].clear();
        ++wave;
      } else {
        barrier_.wait();  // every thread has cleared its list of the previous wave
        if (thread == 0) next_wave_ = spread_alone(wave);
        barrier_.wait();
        wave = next_wave_;
      }
    }
  }

  std::size_t cells_of(std::size_t wave) const {
    std::size_t total = 0;
    for (const ThreadLists& l : lists_) total += l.cells[wave % slots].size();
    return total;
  }

  // Sources join the wave they belong to; thread 0 owns them. Called one wave ahead.
  void start_wave(std::size_t wave) {
    if (wave >= starts_.size()) return;
    CellList& list = lists_[0].cells[wave % slots];
    list.insert(list.end(), starts_[wave].begin(), starts_[wave].end());
  }

  // Spreads waves from `wave` on until one is wide enough to share; returns that wave, or finished.
  std::size_t spread_alone(std::size_t wave) {
    std::size_t empty_waves = 0;
    for (; wave < last_wave; ++wave) {
      const std::size_t cells = cells_of(wave);
      if (lists_.size() > 1 && cells >= shared_wave_cells) return wave;
      empty_waves = cells == 0 ? empty_waves + 1 : 0;
      if (empty_waves == slots && wave >= starts_.size()) return finished;
      start_wave(wave + 1);
      for (ThreadLists& l : lists_) {
        CellList& list = l.cells[wave % slots];
        for (const std::uint32_t cell : list) spread(cell, static_cast<float>(wave), lists_[0]);
        list.clear();
      }
    }
    return finished;
  }

  // This thread's share of the cells of the wave: an even split of all threads' lists in sequence.
  void spread_share(std::size_t wave, std::size_t thread) {
    const std::size_t total = cells_of(wave);
    const std::size_t begin = total * thread / lists_.size();
    const std::size_t end = total * (thread + 1) / lists_.size();
    std::size_t offset = 0;
    const auto first = static_cast<float>(wave);
    for (const ThreadLists& l : lists_) {
      const CellList& cells = l.cells[wave % slots];
      const std::size_t from = std::clamp(begin, offset, offset + cells.size()) - offset;
      const std::size_t to = std::clamp(end, offset, offset + cells.size()) - offset;
      for (std::size_t i = from; i < to; ++i) spread(cells[i], first, lists_[thread]);
      offset += cells.size();
    }
  }

  // Blocked cells are NaN: they compare false, so they are neither final nor lowered.
  void spread(std::uint32_t cell, float wave_begin, ThreadLists& mine) {
    const float* at = u_ + cell;
    const float value = load(at);
    if (!(value >= wave_begin)) return;  // it was lowered into an earlier wave and is done
    const float wave_end = wave_begin + 1.0F;
    const std::ptrdiff_t n = stride_;
    const float e = load(at + 1);
    const float w = load(at - 1);
    const float no = load(at + n);
    const float so = load(at - n);
    const float across_x = std::min(final_or_inf(no, wave_end), final_or_inf(so, wave_end));
    const float across_y = std::min(final_or_inf(e, wave_end), final_or_inf(w, wave_end));
    // Values grow by 1.06 waves or more; far out, where floats are coarser, this is enforced.
    const float along_x = std::max(axial_value(value, across_x), wave_end);
    const float along_y = std::max(axial_value(value, across_y), wave_end);
    if (e > along_x) lower(cell + 1, along_x, mine);
    if (w > along_x) lower(cell - 1, along_x, mine);
    if (no > along_y) lower(cell + static_cast<std::uint32_t>(n), along_y, mine);
    if (so > along_y) lower(cell - static_cast<std::uint32_t>(n), along_y, mine);
    const float slanted = std::max(value + diagonal, wave_end);
    for (const std::ptrdiff_t step : {n + 1, n - 1, -n + 1, -n - 1}) {
      if (load(at + step) > slanted) {
        lower(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(cell) + step), slanted, mine);
      }
    }
  }

  static float final_or_inf(float value, float wave_end) {
    return value < wave_end ? value : unreached;
  }

  // The triangle of an axial neighbour of value a and the adjacent diagonal one of value b:
  //   min over 0 <= s <= 1 of a - s (a - b) + side sqrt(1 + s^2)
  //     = a + sqrt(side^2 - (a - b)^2) where 0 <= a - b <= side / sqrt(2), else an end point.
  // The end point b is handled by the diagonal cell itself.
  static float axial_value(float a, float b) {
    const float drop = std::clamp(a - b, 0.0F, largest_drop);
    return a + std::sqrt(side * side - drop * drop);
  }

  static float load(const float* p) {
    return std::atomic_ref<float>(*const_cast<float*>(p)).load(std::memory_order_relaxed);
  }

  // A cell enters the list of a wave when its value enters that wave, once.
  void lower(std::uint32_t cell, float value, ThreadLists& mine) {
    std::atomic_ref<float> shared(u_[cell]);
    float old = shared.load(std::memory_order_relaxed);
    if (lists_.size() == 1) {
      shared.store(value, std::memory_order_relaxed);
    } else {
      while (old > value && !shared.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
      }
      if (!(old > value)) return;
    }
    const auto wave = static_cast<std::size_t>(value);
    if (old == unreached || static_cast<std::size_t>(old) != wave) {
      mine.cells[wave % slots].push_back(cell);
    }
  }

  float* u_;
  std::ptrdiff_t stride_;
  std::vector<CellList> starts_;
  std::vector<ThreadLists> lists_;
  std::size_t next_wave_ = 0;
  WaveBarrier barrier_;
};

// Sources by the wave they fall into; of two sources in one cell, the nearer counts.
std::vector<CellList> sorted_starts(std::span<const EikonalSource> sources, int nx,
                                    std::size_t stride, std::vector<float>& u) {
  const auto columns = static_cast<std::uint32_t>(nx);
  auto padded = [&](std::uint32_t index) {
    return (index / columns + 1) * stride + index % columns + 1;
  };
  for (const EikonalSource& source : sources) {
    float& value = u[padded(source.index)];
    const float waves = source.distance_cells * side;
    if (value > waves) value = waves;
  }
  std::vector<CellList> starts;
  for (const EikonalSource& source : sources) {
    const std::size_t at = padded(source.index);
    if (u[at] != source.distance_cells * side) continue;
    const auto wave = static_cast<std::size_t>(u[at]);
    if (wave >= starts.size()) starts.resize(wave + 1);
    starts[wave].push_back(static_cast<std::uint32_t>(at));
  }
  return starts;
}

// The arena does not reflect the limit for the whole process (--threads), so both are queried.
int allowed_threads() {
  const std::size_t bound =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(
      std::min(bound, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())));
}

}  // namespace

std::vector<float> eikonal_distance(std::span<const std::uint8_t> inside, int nx, int ny,
                                    std::span<const EikonalSource> sources) {
  require(nx >= 0 && ny >= 0, "eikonal_distance: sides are not negative");
  const auto columns = static_cast<std::size_t>(nx);
  const auto rows = static_cast<std::size_t>(ny);
  require(inside.size() == columns * rows, "eikonal_distance: one entry of `inside` per cell");
  const std::size_t stride = columns + 2;  // a rim of blocked cells saves every bounds check
  require(stride * (rows + 2) < std::numeric_limits<std::uint32_t>::max(),
          "eikonal_distance: fewer than 2^32 cells");
  for (const EikonalSource& source : sources) {
    require(source.index < inside.size() && source.distance_cells >= 0.0F &&
                source.distance_cells < 1.0e6F,
            "eikonal_distance: sources lie on the grid, at 0 to a million cells");
  }

  std::vector<float> u(stride * (rows + 2), std::numeric_limits<float>::quiet_NaN());
  for_rows(ny, [&](int first, int last) {
    for (auto iy = static_cast<std::size_t>(first); iy < static_cast<std::size_t>(last); ++iy) {
      for (std::size_t ix = 0; ix < columns; ++ix) {
        if (inside[iy * columns + ix] != 0) u[(iy + 1) * stride + ix + 1] = unreached;
      }
    }
  });
  std::vector<CellList> starts = sorted_starts(sources, nx, stride, u);
  // Waves in a small grid are too short to share.
  const int threads = inside.size() < 500'000 ? 1 : allowed_threads();
  WaveFront(u, stride, std::move(starts), threads).run();

  // Remove the rim in place: every row moves towards the front of the array.
  for (std::size_t iy = 0; iy < rows; ++iy) {
    for (std::size_t ix = 0; ix < columns; ++ix) {
      const float waves = u[(iy + 1) * stride + ix + 1];
      const bool final = waves >= 0.0F && waves < static_cast<float>(last_wave);
      u[iy * columns + ix] = final ? waves * cells_per_wave : unreached;
    }
  }
  u.resize(columns * rows);
  return u;
}

}  // namespace fairway
