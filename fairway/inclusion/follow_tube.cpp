// How near to the path behaviours of the core stay.
#include <algorithm>

#include "fairway/base/parallel.hpp"
#include "fairway/inclusion/follow_prover.hpp"

namespace fairway {
namespace {

constexpr std::size_t most_stretches = 512;
/// Who checks may find a little more.
constexpr double more_m = 1.0 + 1e-5;
constexpr double more_off_rad = 0.05;  // it turns in steps of its own

void widen(TubeStretch& stretch, const TubeStretch& by) {
  stretch.distance_m = std::max(stretch.distance_m, by.distance_m);
  stretch.off_rad = std::max(stretch.off_rad, by.off_rad);
}

}  // namespace

/// By the stations of the parts where behaviours of the core may be.
void FollowProver::measure_tube(Following& found) {
  const auto count = std::clamp<std::size_t>(
      static_cast<std::size_t>(tube_.length_m() / (2.0 * parts_.part_m())), 8, most_stretches);
  std::vector<Id> all;
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (core_.in[id]) all.push_back(id);
  }
  BehaviourOptions options = options_.limits.flight;
  options.tells_visits = true;
  constexpr std::size_t chunk = 256;
  const std::size_t chunks = (all.size() + chunk - 1) / chunk;
  std::vector<std::vector<TubeStretch>> of(chunks);
  for_ranges(chunks, 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t c = a; c < b; ++c) {
      of[c].resize(count);
      for (std::size_t k = c * chunk; k < std::min(all.size(), (c + 1) * chunk); ++k) {
        const Id id = all[k];
        const std::size_t s = graph_.section_of(id);
        const BehaviourImage image =
            image_of_crossing(parts_, parts_.place(s / sections_per_part),
                              static_cast<PartSide>(s % sections_per_part),
                              graph_.leaf(id).begin / static_cast<double>(side_units),
                              graph_.end_of(id, s) / static_cast<double>(side_units), options);
        for (const auto& [part, headings] : image.visits) {
          const auto at = static_cast<std::size_t>(static_cast<double>(tube_.station_m(part)) /
                                                   tube_.length_m() * static_cast<double>(count));
          TubeStretch& stretch = of[c][std::min(at, count - 1)];
          widen(stretch,
                {tube_.distance_m(part), static_cast<float>(tube_.off_rad(part, headings))});
        }
      }
    }
  });
  std::vector<TubeStretch> own(count);
  for (const auto& part : of) {
    for (std::size_t k = 0; k < count; ++k) widen(own[k], part[k]);
  }
  // Who checks may find a part on the other side of where two stretches meet.
  found.tube.assign(count, {});
  for (std::size_t k = 0; k < count; ++k) {
    TubeStretch& s = found.tube[k];
    for (const std::size_t near : {(k + count - 1) % count, k, (k + 1) % count}) {
      widen(s, own[near]);
    }
    s.distance_m = static_cast<float>(more_m * static_cast<double>(s.distance_m));
    s.off_rad = static_cast<float>(static_cast<double>(s.off_rad) + more_off_rad);
    found.tube_m = std::max(found.tube_m, static_cast<double>(s.distance_m));
    found.off_rad = std::max(found.off_rad, static_cast<double>(s.off_rad));
  }
  stretches_ = found.tube;
}

}  // namespace fairway
