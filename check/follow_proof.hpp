// The rules for leaves of the core, from which behaviours follow a path for ever (docs/trust.md,
// "The third theorem"): they stay in the core and in the tube, and pass stage after stage.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "check/contract_certificate.hpp"
#include "check/contract_flight.hpp"
#include "check/path_places.hpp"

namespace fairway_check {

/// What a leaf adds to the bound of its group.
struct Share {
  double onwards_s = 0.0;
  double astray_rad = -1.0;
};

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

class CoreProof {
 public:
  /// Of a certificate that claims to follow, which must outlive this.
  explicit CoreProof(const ContractCertificate& c);

  /// "" when stages go round the path, or all ends are at the end of an open one; else why not.
  std::string defect() const;

  /// "" when the rule for one leaf of the core holds, else why not.
  std::string defect_of_leaf(Behaviours& behaviours, std::size_t section, std::size_t leaf,
                             Share& share, LapSums& sums) const;

  /// Whether a part in which headings are in [least, most] lies in the tube.
  bool is_in_tube(std::size_t part, double least, double most) const;

 private:
  /// How a part lies beside the path.
  struct Beside {
    double station_m;
    double farthest_m;  ///< of its places
    Arc ways;           ///< of the path at the points nearest to them
  };
  Beside beside(std::size_t part) const;
  bool is_near_stage(std::size_t part, std::size_t stage) const;

  const ContractCertificate& c_;
  PathPlaces path_;
  double half_m_;  ///< from the middle of a part to its corners
  mutable tbb::enumerable_thread_specific<std::unordered_map<std::size_t, Beside>> known_;
};

}  // namespace fairway_check
