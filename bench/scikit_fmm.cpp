#include "bench/scikit_fmm.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fairway::bench {

ScikitFmm::ScikitFmm(const std::string& script) {
  try {
    python_ = std::make_unique<ChildProcess>(std::vector<std::string>{"/usr/bin/python3", script});
    const std::string greeting = python_->read_line().value_or("absent: python3 does not run");
    if (greeting.rfind("ready", 0) != 0) absent_ = "scikit-fmm is not installed";
  } catch (const std::runtime_error& error) {
    absent_ = error.what();
  }
  folder_ = std::filesystem::temp_directory_path() / fmt::format("fairway-bench-{}", getpid());
  std::filesystem::create_directories(folder_);
}

ScikitFmm::~ScikitFmm() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void ScikitFmm::pose(const DistanceProblem& problem) {
  const std::filesystem::path mask = folder_ / "blocked";
  std::ofstream file(mask, std::ios::binary);
  file.write(reinterpret_cast<const char*>(problem.blocked.data()),
             static_cast<std::streamsize>(problem.blocked.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + mask.string());
  cells_ = problem.blocked.size();
  request_ = fmt::format("{} {} {} {} {} {}", mask.string(), problem.nx, problem.ny,
                         problem.goal.ix, problem.goal.iy, problem.radius_cells);
}

Took ScikitFmm::solve(int order, std::vector<double>* distance) {
  const std::filesystem::path out = folder_ / "distance";
  python_->write_line(fmt::format("{} {} {}", request_, order, distance ? out.string() : "-"));
  Took took;
  std::istringstream answer(python_->read_line().value_or(""));
  if (!(answer >> took.wall_s >> took.cpu_s)) throw std::runtime_error("scikit-fmm gave no answer");
  if (distance != nullptr) {
    distance->resize(cells_);
    std::ifstream file(out, std::ios::binary);
    file.read(reinterpret_cast<char*>(distance->data()),
              static_cast<std::streamsize>(cells_ * sizeof(double)));
    if (!file) throw std::runtime_error("scikit-fmm's answer is too short");
  }
  return took;
}

}  // namespace fairway::bench
