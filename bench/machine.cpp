#include "bench/machine.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "bench/stopwatch.hpp"

namespace fairway::bench {
namespace {

std::string processor_model() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) {
      return line.substr(line.find(": ") + 2);
    }
  }
  return "unknown processor";
}

// How many cores this many threads got while they only counted, for a fifth of a second.
double cores_had(int threads) {
  const Took took = timed([threads] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    std::vector<std::thread> all;
    for (int i = 0; i < threads; ++i) {
      all.emplace_back([end] {
        while (std::chrono::steady_clock::now() < end) {
        }
      });
    }
    for (std::thread& thread : all) thread.join();
  });
  return took.cpu_s / took.wall_s;
}

}  // namespace

double load_average() {
  double load[1] = {0.0};
  return getloadavg(load, 1) == 1 ? load[0] : -1.0;
}

void print_machine(int threads) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 30);
  const double load = load_average();
  const double cores = cores_had(threads);
  fmt::print(
      "{}, {} cores, {:.0f} GiB; load average at the start {:.2f}; {} threads get {:.2f} cores\n",
      processor_model(), std::thread::hardware_concurrency(), memory, load, threads, cores);
  if (load > 0.5 || cores < 0.95 * threads) {
    fmt::print(
        "WARNING: the machine is busy, or does not give this process enough cores. Times and "
        "ratios below are unreliable.\n");
  }
}

}  // namespace fairway::bench
