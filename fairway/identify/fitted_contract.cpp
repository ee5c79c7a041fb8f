#include "fairway/identify/fitted_contract.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/identify/nearest_motion.hpp"

namespace fairway {
namespace {

/// How far each number is from its ideal: 1 is the widest of the first kind tried.
using Slack = std::array<double, contract_parts>;

/// Mixes to begin with: of one number more, of another less.
constexpr std::array<Slack, 4> mixes{{{1.0, 1.0, 1.0, 1.0, 1.0},
                                      {0.5, 1.0, 1.0, 1.0, 1.0},
                                      {1.0, 0.2, 1.0, 1.0, 1.0},
                                      {1.0, 1.0, 0.4, 0.4, 1.0}}};

constexpr std::size_t most_states = 64;  // of a search: a fit takes hundreds
constexpr double negligible = 0.01;      // of the widest
constexpr double widest_error_radii = 0.8;
constexpr double widest_heading_rad = 0.2;
constexpr double widest_radius = 1.5;  // of the flown one, and its inverse
constexpr double widest_side_rad = 0.8;

class Fit {
 public:
  Fit(const std::vector<FlownTrack>& tracks, const FitOptions& options)
      : tracks_(tracks), options_(options) {
    order_.resize(tracks.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    speed_ = speeds_flown_mps(tracks.front());
    for (const FlownTrack& track : tracks) {
      const SizeRange flown = speeds_flown_mps(track);
      speed_ = {std::min(speed_.least, flown.least), std::max(speed_.most, flown.most)};
    }
  }

  VehicleContract contract(const Slack& slack) const {
    const double r = options_.turn_radius_m;
    VehicleContract c;
    c.command_error_m = widest_error_radii * r * slack[0];
    c.heading_error_rad = widest_heading_rad * slack[1];
    c.turn_radius_m = {r * std::pow(widest_radius, -slack[2]),
                       r * std::pow(widest_radius, slack[3])};
    // The side is chosen when the command is given, and the turn before goes on for that long.
    const double turned_rad = c.command_error_m / c.turn_radius_m.least;
    c.side_uncertain_rad = std::min(std::max(widest_side_rad * slack[4], turned_rad), 0.49 * pi);
    c.speed_mps = {0.99 * speed_.least, 1.01 * speed_.most};
    return c;
  }

  /// Nothing when every log keeps it, else where one does not.
  std::optional<Decider> broken_by(const Slack& slack) const {
    const VehicleContract tried = contract(slack);
    // The log that failed last is likely to fail again.
    for (const std::size_t k : order_) {
      const NearestMotion motion = nearest_motion(
          tracks_[k], tried,
          {.limit_m = options_.tracking_m, .sides = options_.sides, .most_states = most_states});
      if (motion.stays) continue;
      std::rotate(order_.begin(), std::find(order_.begin(), order_.end(), k),
                  std::find(order_.begin(), order_.end(), k) + 1);
      return Decider{k, motion.reached};
    }
    return std::nullopt;
  }

  /// All numbers by one factor, to within a tenth.
  std::optional<Slack> tighten_together(const Slack& mix, Decider& broken) const {
    double holds = 1.0;
    for (int doubled = 0;; ++doubled) {
      const auto breaks = broken_by(times(mix, holds));
      if (!breaks) break;
      broken = *breaks;
      if (doubled == 1) return std::nullopt;
      holds *= 2.0;
    }
    double fails = 0.0;
    while (holds - fails > 0.1 * holds) {
      const double middle = 0.5 * (holds + fails);
      (broken_by(times(mix, middle)) ? fails : holds) = middle;
      if (holds < 1e-3) break;
    }
    return times(mix, holds);
  }

  /// One number after the other, by ever smaller steps; at last those that are not needed at all.
  void tighten_each(Slack& slack, std::initializer_list<double> factors, Deciders& deciders) const {
    for (const double factor : factors) {
      std::array<bool, contract_parts> ended{};
      while (const auto part = next_part(slack, factor, ended)) {
        Slack tried = slack;
        tried[*part] *= factor;
        const auto breaks = broken_by(tried);
        if (breaks) {
          ended[*part] = true;
          if (factor > 0.0 || !deciders[*part]) deciders[*part] = breaks;
        } else {
          slack = tried;
          deciders[*part] = std::nullopt;
        }
      }
    }
  }

  double cost(const Slack& slack) const {
    return contract_cost(contract(slack), options_.turn_radius_m);
  }

 private:
  static Slack times(Slack slack, double factor) {
    for (double& part : slack) part *= factor;
    return slack;
  }

  /// That whose tightening lowers the cost most.
  std::optional<std::size_t> next_part(const Slack& slack, double factor,
                                       const std::array<bool, contract_parts>& ended) const {
    std::optional<std::size_t> best;
    double least_cost = 0.0;
    for (std::size_t part = 0; part < contract_parts; ++part) {
      if (ended[part] || slack[part] <= (factor == 0.0 ? 0.0 : negligible)) continue;
      Slack tried = slack;
      tried[part] *= factor;
      const double now = cost(tried);
      if (!best || now < least_cost) {
        best = part;
        least_cost = now;
      }
    }
    return best;
  }

  const std::vector<FlownTrack>& tracks_;
  const FitOptions& options_;
  SizeRange speed_;
  mutable std::vector<std::size_t> order_;  ///< in which the logs are tried
};

}  // namespace

double contract_cost(const VehicleContract& contract, double turn_radius_m) {
  return (contract.command_error_m + contract.turn_radius_m.most - contract.turn_radius_m.least) /
             turn_radius_m +
         4.0 * contract.heading_error_rad + 0.25 * contract.side_uncertain_rad;
}

std::optional<FittedContract> fitted_contract(const std::vector<FlownTrack>& tracks,
                                              const FitOptions& options, Decider& broken) {
  require(!tracks.empty(), "at least one log");
  require(options.tracking_m > 0.0 && options.turn_radius_m > 0.0, "lengths are above 0");
  // Each mix on its own: the result does not depend on which ends first.
  std::array<std::optional<Slack>, mixes.size()> slacks;
  std::array<Deciders, mixes.size()> mix_deciders;
  std::array<Decider, mixes.size()> mix_broken;
  for_ranges(mixes.size(), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t m = a; m < b; ++m) {
      const Fit fit(tracks, options);
      slacks[m] = fit.tighten_together(mixes[m], mix_broken[m]);
      if (slacks[m]) fit.tighten_each(*slacks[m], {0.6}, mix_deciders[m]);
    }
  });
  const Fit fit(tracks, options);
  std::optional<Slack> best;
  Deciders deciders;
  for (std::size_t m = 0; m < mixes.size(); ++m) {
    if (!slacks[m] || (best && fit.cost(*slacks[m]) >= fit.cost(*best))) continue;
    best = slacks[m];
    deciders = mix_deciders[m];
  }
  broken = mix_broken[0];
  if (!best) return std::nullopt;
  fit.tighten_each(*best, {0.8, 0.9, 0.95, 0.0}, deciders);
  FittedContract result;
  result.deciders = deciders;
  result.contract = fit.contract(*best);
  result.turn_radius_m = options.turn_radius_m;
  result.tracking_m = options.tracking_m;
  return result;
}

}  // namespace fairway
