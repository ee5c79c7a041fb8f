// The rules for leaves of the core, from which behaviours follow a path for ever (docs/trust.md,
// "The third theorem"): they stay in the core and in the tube, and pass stage after stage.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "check/contract_certificate.hpp"
#include "check/contract_flight.hpp"
#include "check/lap_sums.hpp"
#include "check/path_places.hpp"

namespace fairway_check {

/// What a leaf adds to the bound of its group.
struct Share {
  double onwards_s = 0.0;
  double astray_rad = -1.0;
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

  /// Whether behaviours that go from a part and its stage to others move on along the path as the
  /// stages say they do, and not the other way round it.
  bool moves_as_stages(std::size_t part, std::size_t stage, std::size_t to_part,
                       std::size_t to_stage) const;

 private:
  /// How a part lies beside the path.
  struct Beside {
    double station_m;
    double farthest_m;  ///< of its places
    Arc ways;           ///< of the path at the points nearest to them
  };
  Beside beside(std::size_t part) const;
  /// How far along the path a part lies from where its stage begins, either way.
  double from_stage_m(std::size_t part, std::size_t stage) const;

  const ContractCertificate& c_;
  PathPlaces path_;
  std::vector<double> begins_m_;  ///< [stages + 1]: stations, which ascend over one lap
  double half_m_;                 ///< from the middle of a part to its corners
  mutable tbb::enumerable_thread_specific<std::unordered_map<std::size_t, Beside>> known_;
};

}  // namespace fairway_check
