#include "bench/machine.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

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

}  // namespace

void print_machine() {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 30);
  double load[1] = {0.0};
  const bool known = getloadavg(load, 1) == 1;
  fmt::print(
      "{}, {} cores, {:.0f} GiB; {}\n", processor_model(), std::thread::hardware_concurrency(),
      memory,
      known ? fmt::format("load average at the start {:.2f}", load[0]) : "load average unknown");
  if (known && load[0] > 0.5) {
    fmt::print(
        "WARNING: the machine is busy (load above 0.5). Times and ratios below are not to be "
        "trusted.\n");
  }
}

}  // namespace fairway::bench
