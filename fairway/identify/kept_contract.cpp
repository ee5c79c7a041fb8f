#include "fairway/identify/kept_contract.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/identify/nearest_motion.hpp"

namespace fairway {
namespace {

std::optional<std::size_t> wrong_speed_of(const FlownTrack& track, SizeRange range) {
  std::optional<std::size_t> worst;
  double worst_factor = 1.0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double v = track.speed_mps[i];
    const double factor = std::max(range.least / v, v / range.most);
    if (factor <= worst_factor) continue;
    worst = i;
    worst_factor = factor;
  }
  return worst;
}

}  // namespace

KeptContract kept_contract(const FlownTrack& track, const VehicleContract& contract,
                           double tracking_m, SideRule sides) {
  constexpr double growth = 1.5;
  constexpr double precise = 1.03;      // needs_m is found to three percent
  constexpr double least_share = 0.02;  // of the tracking distance
  constexpr double never = std::numeric_limits<double>::infinity();
  require(tracking_m > 0.0, "the tracking distance is above 0");
  KeptContract result;
  result.needs_m = never;
  double fails_m = least_share * tracking_m;
  double shown_m = tracking_m;  // the limit of the search whose motion is shown
  const auto try_within = [&](double limit_m) {
    const NearestMotion tried =
        nearest_motion(track, contract, {.limit_m = limit_m, .sides = sides});
    result.worst = tried.stays ? tried.farthest : tried.reached;
    if (tried.stays) {
      result.needs_m = tried.farthest_m;
      shown_m = limit_m;
    } else {
      fails_m = limit_m;
    }
    return tried;
  };
  const NearestMotion first = try_within(tracking_m);
  result.kept = first.stays;
  result.kept_until = first.reached;
  const double farthest_m = growth * (contract.command_error_m + contract.look_ahead_m);
  for (double limit_m = growth * tracking_m; result.needs_m == never && limit_m <= farthest_m;
       limit_m *= growth) {
    static_cast<void>(try_within(limit_m));
  }
  while (result.needs_m != never && result.needs_m > precise * fails_m) {
    static_cast<void>(try_within(std::sqrt(result.needs_m * fails_m)));
  }
  result.wrong_speed = wrong_speed_of(track, contract.speed_mps);
  result.motion_m =
      nearest_motion(track, contract, {.limit_m = shown_m, .sides = sides, .wants_places = true})
          .place_m;
  return result;
}

}  // namespace fairway
