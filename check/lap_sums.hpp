// How long laps of a path take (docs/trust.md, "The third theorem").
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "check/contract_certificate.hpp"

namespace fairway_check {

/// Sums over a lap: at the end of each stage, how much later than others a behaviour may be, and
/// how much less way it may have made.
class LapSums {
 public:
  LapSums() = default;
  explicit LapSums(const ContractCertificate& c);

  /// Behaviours at `at` (metres) go on from stage k, from 0, by so many stages.
  void pass(std::size_t k, std::size_t stages, Point at);
  /// In stage k, from 0, behaviours head so far from its direction, more than is claimed.
  void slow_down(std::size_t k, double off_rad);
  void add(const LapSums& other);
  /// "" when the claims about laps follow.
  std::string defect(const ContractCertificate& c) const;

 private:
  double slower_s(std::size_t k, double claimed_rad) const;

  std::vector<Point> slowness_;      ///< [stages]: seconds by metre, as a vector
  std::vector<Point> along_;         ///< [stages], of length 1
  std::vector<double> late_s_;       ///< [stages], at most
  std::vector<double> way_m_;        ///< [stages], at least
  std::vector<double> begin_s_;      ///< [stages], of places where they begin, at least
  std::vector<double> end_s_;        ///< [stages], of places where they end, at most
  std::vector<double> off_rad_;      ///< [stages], from their directions, at most
  double start_least_s_ = HUGE_VAL;  ///< of where laps begin
  double start_most_s_ = -HUGE_VAL;
  double start_least_m_ = HUGE_VAL;
  double start_most_m_ = -HUGE_VAL;
};

}  // namespace fairway_check
