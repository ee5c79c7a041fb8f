// scikit-fmm, a peer in its own Python process that waits while it has nothing to do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/child_process.hpp"
#include "bench/distance_problem.hpp"
#include "bench/stopwatch.hpp"

namespace fairway::bench {

class ScikitFmm {
 public:
  /// Starts Debian's /usr/bin/python3, for which python3-scikit-fmm is packaged.
  explicit ScikitFmm(const std::string& script);
  ~ScikitFmm();
  ScikitFmm(const ScikitFmm&) = delete;
  ScikitFmm& operator=(const ScikitFmm&) = delete;

  bool is_there() const { return absent_.empty(); }
  const std::string& why_absent() const { return absent_; }

  /// Sets the problem that solve() solves from now on.
  void pose(const DistanceProblem& problem);
  /// The time of the solver call alone. `distance`, if given, gets [iy][ix], +inf if not reached.
  Took solve(int order, std::vector<double>* distance = nullptr);

 private:
  std::filesystem::path folder_;
  std::unique_ptr<ChildProcess> python_;
  std::string absent_;
  std::string request_;
  std::size_t cells_ = 0;
};

}  // namespace fairway::bench
