// What a plan with certain parameters is worth, and the log of what was evaluated.
#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fairway/run/scenario.hpp"

namespace fairway {

/// What is to be large: each share counts with its weight, the mean time to the mission, against
/// that of the scenario as given, with minus its own. By default time only decides between equal
/// shares: a plan ten per cent faster may save a ten-thousandth of the states less.
struct Objective {
  double reach = 1.0;
  double safe = 0.0;  ///< share of safe starts
  double time = 0.001;
};

/// "reach", or weights: "reach=1,safe=0.2,time=0.05"; what is not named weighs nothing. Throws
/// InputError.
[[nodiscard]] Objective objective_of_text(const std::string& text);

struct Evaluation {
  std::vector<std::string> values;  ///< of the parameters, in their order
  bool allowed = false;             ///< the map allows the mission with these
  double share = 0.0;               ///< of all states: they arrive in exact flights; under a
                                    ///< contract: they are proved to, coarsely
  double safe_share = 0.0;          ///< the same of safe starts
  double mean_time_s = 0.0;         ///< of exact flights that arrive
  friend bool operator==(const Evaluation&, const Evaluation&) = default;
};

/// `given`: the evaluation of the scenario as it is.
[[nodiscard]] double value_of(const Evaluation& one, const Evaluation& given,
                              const Objective& objective);

/// Those that no other one beats in both share and time: the largest share first.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<Evaluation>& all);

/// Plans the scenario, and flies it; under a contract proves it as far as a coarse proof goes.
[[nodiscard]] Evaluation evaluate(const Scenario& scenario, std::vector<std::string> values);

/// A CSV file that grows by one whole line with every evaluation.
class EvaluationLog {
 public:
  /// Reads what is there; a last line without an end, which a killed process may leave, is dropped.
  /// Throws InputError when the file cannot be written, or is the log of other parameters.
  EvaluationLog(std::filesystem::path file, const std::vector<std::string>& keys);
  ~EvaluationLog();
  EvaluationLog(const EvaluationLog&) = delete;
  EvaluationLog& operator=(const EvaluationLog&) = delete;

  [[nodiscard]] const std::vector<Evaluation>& all() const { return all_; }
  /// Null: not evaluated yet.
  [[nodiscard]] const Evaluation* find(const std::vector<std::string>& values) const;
  const Evaluation& add(Evaluation one);

 private:
  void take_line(const std::string& line, std::size_t number);

  std::filesystem::path file_;
  std::size_t keys_;
  std::vector<Evaluation> all_;
  std::map<std::vector<std::string>, std::size_t> by_values_;
  std::FILE* out_ = nullptr;
};

}  // namespace fairway
