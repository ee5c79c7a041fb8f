// How long something took, and medians of our runs alternating with a peer's, so that other load on
// the machine affects both equally.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace fairway::bench {

struct Took {
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all threads of the process that did the work
};

inline double cpu_s_of(decltype(RUSAGE_SELF) who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}
inline double process_cpu_s() { return cpu_s_of(RUSAGE_SELF); }
inline double ended_children_cpu_s() { return cpu_s_of(RUSAGE_CHILDREN); }

template <typename Work>
Took timed(Work&& work) {
  const double cpu = process_cpu_s();
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  return {wall.count(), process_cpu_s() - cpu};
}

/// The middle value, or the mean of the two middle ones. Not empty.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

inline Took median(const std::vector<Took>& runs) {
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const Took& run : runs) {
    wall.push_back(run.wall_s);
    cpu.push_back(run.cpu_s);
  }
  return {median(wall), median(cpu)};
}

/// `ours` and `peer` each return a Took; they run alternately, `repeats` times.
struct Medians {
  Took ours;
  Took peer;
};
template <typename Ours, typename Peer>
Medians interleaved(int repeats, Ours&& ours, Peer&& peer) {
  std::vector<Took> of_ours;
  std::vector<Took> of_peer;
  for (int i = 0; i < repeats; ++i) {
    of_ours.push_back(ours());
    of_peer.push_back(peer());
  }
  return {median(of_ours), median(of_peer)};
}

}  // namespace fairway::bench
