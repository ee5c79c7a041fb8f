#include "fairway/identify/kept_contract.hpp"

#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/identify/nearest_motion.hpp"

namespace fairway {

KeptContract kept_contract(const FlownTrack& track, const VehicleContract& contract,
                           double tracking_m) {
  constexpr double growth = 1.5;
  constexpr double precise = 1.03;     // needs_m is found to three percent
  constexpr double least_share = 0.02; // of the tracking distance
  require(tracking_m > 0.0, "the tracking distance is above 0");
  const auto stays_within = [&](double limit_m) {
    return nearest_motion(track, contract, {.limit_m = limit_m});
  };
  const double farthest_m =
      std::max(2.0 * tracking_m, farthest_tried_radii * contract.turn_radius_m.least);
  KeptContract result;
  NearestMotion first = stays_within(tracking_m);
  result.kept = first.stays;
  result.kept_until = result.worst = first.stays ? first.farthest : first.reached;
  double fails_m = first.stays ? least_share * tracking_m : tracking_m;
  double holds_m = first.stays ? first.farthest_m : std::numeric_limits<double>::infinity();
  for (double limit_m = growth * tracking_m; !std::isfinite(holds_m) && limit_m <= farthest_m;
       limit_m *= growth) {
    const NearestMotion tried = stays_within(limit_m);
    if (tried.stays) {
      holds_m = tried.farthest_m;
      result.worst = tried.farthest;
    } else {
      fails_m = limit_m;
      result.worst = tried.reached;
    }
  }
  while (std::isfinite(holds_m) && holds_m > precise * fails_m) {
    const double middle_m = std::sqrt(holds_m * fails_m);
    const NearestMotion tried = stays_within(middle_m);
    if (tried.stays) {
      holds_m = std::min(tried.farthest_m, middle_m);
    } else {
      fails_m = middle_m;
      result.worst = tried.reached;
    }
  }
  result.needs_m = holds_m;
  const double shown_m = std::isfinite(holds_m) ? precise * holds_m : tracking_m;
  result.motion_m =
      nearest_motion(track, contract, {.limit_m = shown_m, .wants_places = true}).place_m;
  return result;
}

}  // namespace fairway
