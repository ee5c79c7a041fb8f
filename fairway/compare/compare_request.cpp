#include "fairway/compare/compare_request.hpp"

#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/compare/require_alike.hpp"
#include "fairway/compare/write_comparison.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

/// A run's folder holds what is read; nothing may be written into it.
void require_own_folder(const CompareRequest& request) {
  for (const std::string& name : comparison_files(request.plans.size())) {
    require_no_input(request.folder / name, request.plans);
  }
  for (const fs::path& plan : request.plans) {
    std::error_code error;
    if (fs::equivalent(request.folder, plan, error)) {
      throw InputError(request.folder.string(),
                       "is one of the runs to compare, expected another folder");
    }
  }
}

}  // namespace

std::string CompareRequest::command() const {
  std::string words = "fairway compare";
  for (const fs::path& plan : plans) words += " " + plan.string();
  if (quick) words += " --quick";
  const CompareOptions usual;
  if (compare.states != usual.states) words += fmt::format(" --states {}", compare.states);
  if (compare.seed != usual.seed) words += fmt::format(" --seed {}", compare.seed);
  if (!quick) words += fmt::format(" --time-limit {:g}", prove.time_limit_s);
  return words + " -o " + folder.string();
}

Compared compare(CompareRequest request, Existing existing, const Progress& progress) {
  std::optional<AtomicFolder> folder;
  if (!request.folder.empty()) {
    require_own_folder(request);
    folder.emplace(request.folder, existing, comparison_file,
                   comparison_files(request.plans.size()));
  }
  request.prove.seed = request.compare.seed;
  if (request.quick) {
    request.compare.map_across = 64;
    request.compare.map_headings = 12;
  }
  StageClock clock(progress);
  Compared made;
  for (const fs::path& from : request.plans) {
    made.plans.push_back(read_compared_plan(from, clock));
  }
  name_apart(made.plans);
  (void)require_alike(made.plans);  // told before anything is proved
  for (ComparedPlan& plan : made.plans) {
    if (!request.quick) prove_compared_plan(request.prove, clock, plan);
  }
  made.comparison = compare_plans(made.plans, request.compare, clock);
  if (folder) {
    clock.begin("writing", unknown_time);
    write_comparison(made.plans, made.comparison, request.command(), folder->temporary_path());
    folder->commit();
  }
  clock.end();
  return made;
}

}  // namespace fairway
