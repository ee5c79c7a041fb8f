// The benchmark table: ours against peers from Debian packages, medians of alternating runs.
//
//   fairway-bench [--quick] [--only SECTION]... [--repeats N] [--threads N]
//
// Exit code 0 whether or not targets hold; 1 when results disagree or something cannot run.
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "bench/machine.hpp"
#include "bench/sections.hpp"

namespace fairway::bench {
namespace {

struct Section {
  const char* name;
  std::vector<Row> (*rows)(const Settings&);
};
constexpr Section sections[] = {
    {"distance", distance_rows}, {"cost", cost_rows},           {"error", cost_error_rows},
    {"filter", filter_rows},     {"pipeline", pipeline_rows},   {"flight", flight_rows},
    {"bitmap", bitmap_rows},     {"certified", certified_rows}, {"modes", modes_rows},
    {"contract", contract_rows}, {"steer", steer_rows},
};

struct Request {
  Settings settings;
  bool quick = false;
  std::vector<std::string> only;
  int one_field = 0;
  int one_bitmap = 0;
};

[[noreturn]] void usage() {
  fmt::print(stderr,
             "usage: fairway-bench [--quick] [--only SECTION]... [--repeats N] [--threads N]\n"
             "sections: distance cost error filter pipeline flight bitmap certified "
             "modes contract steer\n");
  std::exit(64);
}

Request parsed(int argc, char** argv) {
  Request request;
  request.settings.program = "/proc/self/exe";
  request.settings.fmm_script = FAIRWAY_BENCH_FMM_SCRIPT;
  const auto number = [&](int i) {
    if (i >= argc) usage();
    const int value = std::atoi(argv[i]);
    if (value < 1) usage();
    return value;
  };
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--quick") {  // checks that everything runs, not how fast
      request.quick = true;
      request.settings.side = 256;
      request.settings.error_side = 128;
      request.settings.sides = {128, 256};
      request.settings.repeats = 1;
      request.settings.flights = 32;
      request.settings.bitmap_samples = 40;
    } else if (word == "--repeats") {
      request.settings.repeats = number(++i);
    } else if (word == "--threads") {
      request.settings.threads = number(++i);
    } else if (word == "--one-field") {
      request.one_field = number(++i);
    } else if (word == "--one-bitmap") {
      request.one_bitmap = number(++i);
    } else if (word == "--samples") {
      request.settings.bitmap_samples = number(++i);
    } else if (word == "--only" && i + 1 < argc) {
      request.only.emplace_back(argv[++i]);
    } else {
      usage();
    }
  }
  return request;
}

int run_sections(const Request& request) {
  print_machine(request.settings.threads);
  const Settings& s = request.settings;
  fmt::print("{} x {} cells of which about 20 % are obstacles, {} threads, medians of {}\n\n",
             s.side, s.side, s.threads, s.repeats);
  std::vector<Row> rows;
  std::vector<std::string> failures;
  for (const Section& section : sections) {
    const auto wanted = [&](const std::string& name) { return name == section.name; };
    if (!request.only.empty() && std::none_of(request.only.begin(), request.only.end(), wanted)) {
      continue;
    }
    fmt::print(stderr, "measuring: {}\n", section.name);
    try {
      for (Row& row : section.rows(s)) rows.push_back(std::move(row));
    } catch (const std::exception& error) {
      failures.push_back(fmt::format("{}: {}", section.name, error.what()));
    }
  }
  if (request.quick) {
    for (Row& row : rows) {
      if (!row.verdict.empty()) row.verdict = "too small to judge";
    }
  }
  print_table(rows);
  fmt::print("\nload average at the end {:.2f}, of which {} threads are this program's own\n",
             load_average(), s.threads);
  for (const std::string& failure : failures) fmt::print("FAILED {}\n", failure);
  return failures.empty() ? 0 : 1;
}

}  // namespace
}  // namespace fairway::bench

int main(int argc, char** argv) {
  using namespace fairway::bench;
  const Request request = parsed(argc, argv);
  const auto threads = static_cast<std::size_t>(request.settings.threads);
  const tbb::global_control bound(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(request.settings.threads);
  return arena.execute([&] {
    if (request.one_field == 0 && request.one_bitmap == 0) return run_sections(request);
    try {
      if (request.one_field != 0) run_one_field(request.one_field);
      if (request.one_bitmap != 0) {
        run_one_bitmap(request.one_bitmap, request.settings.bitmap_samples);
      }
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      return 1;
    }
    return 0;
  });
}
