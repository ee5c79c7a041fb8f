// The whole comparison: plans read, proved, compared, and written into a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/compare/compare_plans.hpp"
#include "fairway/compare/read_compared_plan.hpp"
#include "fairway/run/progress.hpp"

namespace fairway {

struct CompareRequest {
  std::vector<std::filesystem::path> plans;  ///< folders of runs, plans, scenarios; two or more
  std::filesystem::path folder;              ///< for table, maps, states and page; empty: none
  ProveComparedOptions prove;                ///< its seed is not looked at
  CompareOptions compare;
  bool quick = false;  ///< prove nothing, read no certificate; coarser maps

  /// The command that would do the same.
  [[nodiscard]] std::string command() const;
};

struct Compared {
  std::vector<ComparedPlan> plans;
  Comparison comparison;
};

/// Throws InputError as read_compared_plan(), prove_compared_plan() and compare_plans() do, and
/// when the folder is one of the runs; then no file is written.
[[nodiscard]] Compared compare(CompareRequest request, Existing existing, const Progress& progress);

}  // namespace fairway
