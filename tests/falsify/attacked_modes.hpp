// A plan's modes with what is proved of them under a contract, as attacks need them: look-ups of
// single states, where each mode is handed over, and what flies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/contract_pilot.hpp"
#include "fairway/contract_runtime.hpp"
#include "fairway/inclusion/contract_hand_over.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "tests/falsify/attack_pilot.hpp"

namespace fairway {

/// A leaf that is handed over.
struct HandedLeaf {
  PartPlace part;
  PartSide side = PartSide::east;
  double lo = 0.0;  ///< places along the side, 0 to 1
  double hi = 1.0;
  int next_mode = 0;
  double time_s = 0.0;
};

/// One of the modes. Not moved.
struct AttackedMode {
  /// `certificate` and `obstacles` must outlive this.
  AttackedMode(const ContractCertificate& certificate, int mode, const NearestObstacle& obstacles);
  AttackedMode(const AttackedMode&) = delete;

  Flow flow;
  Parts parts;
  ContractVerdictsView verdicts;
  QuickLookup lookup;
  BehaviourChoices choices;
  FailureGuide guide;
  AttackPilot pilot;
  std::vector<HandedLeaf> leaves;  ///< first those beside one that is not handed over so
  std::size_t beside_others = 0;   ///< the first so many of them
  std::vector<bool> hands_over;    ///< [sections]
  std::vector<bool> may_change;    ///< [parts] some estimate of a state there may hand it over

  /// That all behaviours reach from a state, without a side held, and by when.
  ContractAnswer claim(const State& state) const {
    return lookup.answer(flow.grid, state.position_m, state.heading.rad());
  }
  Vec2 in_parts(Vec2 place_m) const {
    return (1.0 / parts.part_m()) * (place_m - Vec2{flow.grid.x0_m, flow.grid.y0_m});
  }
  /// To which mode a vehicle changes that takes itself to be there; mode no_mode: to none.
  ContractHandOver hand_over(Vec2 place_m, double heading_rad, const EstimateError& error,
                             double in_time_s) const {
    return hand_over_near(parts, verdicts, in_parts(place_m), heading_rad, error, in_time_s);
  }

 private:
  void find_leaves();
  void find_where_it_may_change(const EstimateError& error);
};

/// Of an error that is allowed: what rounding cannot make too much.
inline constexpr double nearly = 1.0 - 1e-6;

struct AttackedModes {
  explicit AttackedModes(const ContractCertificate& certificate);

  const ContractCertificate& certificate;
  VehicleContract contract;
  EstimateError error;
  double least_mps;
  NearestObstacle obstacles;
  std::deque<AttackedMode> modes;
  runtime::ContractCertificate on_board;
  std::optional<runtime::ContractPilot> pilot;  ///< that has not flown yet, to be copied
  double usual_most_m;  ///< who flies so far without a bound counts as trapped

  const AttackedMode& mode(int k) const { return modes[static_cast<std::size_t>(k)]; }
  int count() const { return static_cast<int>(modes.size()); }
};

}  // namespace fairway
