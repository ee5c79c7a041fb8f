#include "fairway/run/fly_behaviours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/behaviour/proved_ends.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {
namespace {

bool fails(Outcome outcome) { return outcome == Outcome::collide || outcome == Outcome::leave; }

/// One of a start's behaviours, as far as they are compared.
struct Flown {
  BehaviourRun run;
  BehaviourFlight flight;
  bool proved_failure = false;

  /// Worse comes first: a failure that is proved, any other, one without an end, the longest.
  std::pair<int, double> badness() const {
    const int kind = proved_failure                    ? 3
                     : fails(run.outcome)              ? 2
                     : run.outcome == Outcome::trapped ? 1
                                                       : 0;
    return {kind, kind >= 2 ? -run.length_m : run.length_m};
  }
};

Flight flight_of(const Flown& worst, double speed_mps, bool record) {
  Flight flight;
  flight.start = worst.flight.start;
  const bool ends = worst.run.outcome != Outcome::trapped;
  const double infinite = std::numeric_limits<double>::infinity();
  flight.result = {worst.run.outcome, ends ? worst.run.length_m / speed_mps : infinite,
                   ends ? worst.run.length_m : infinite};
  for (FlightSegment& piece : segments_of(worst.flight, speed_mps)) {
    flight.turning.add(piece.length_m * piece.curvature_per_m, piece.length_m);
    if (record) flight.segments.push_back(piece);
  }
  return flight;
}

/// Flies from one start after the other, with memory of its own.
class StartFlier {
 public:
  StartFlier(const BehaviourChoices& choices, const FailureGuide& guide,
             const BehaviourPilot& pilot, const BehaviourRequest& request)
      : choices_(choices), search_(choices, guide), pilot_(pilot), request_(request) {}

  Flown fly(const State& start, std::size_t index, StartOutcomes& outcomes) {
    Random seeds = Random::stream(request_.seed, index);
    std::optional<Flown> worst;
    for (std::size_t k = 0; k < request_.behaviours; ++k) {
      const std::size_t turn = k % request_.adversaries.size();
      Flown one =
          fly_one(start, request_.adversaries[turn], k < request_.adversaries.size(), seeds.bits());
      outcomes.counts.add(one.run.outcome);
      outcomes.proved_failure = outcomes.proved_failure || one.proved_failure;
      if (!worst || one.badness() > worst->badness()) worst = std::move(one);
    }
    return *std::move(worst);
  }

 private:
  Flown fly_one(const State& start, Adversary adversary, bool first, std::uint64_t seed) {
    Flown one;
    one.flight.start = start;
    if (adversary == Adversary::guided && first) {
      if (auto found = search_.find(start, {}, seed)) {
        one.flight = *std::move(found);
        const ProvedEnds ends = judged(one.flight);
        one.run = {ends.may_be(Verdict::collide) ? Outcome::collide : Outcome::leave, ends.length_m,
                   true};
        one.proved_failure = true;
        return one;
      }
    }
    one.run = pilot_.fly(start, adversary, seed, 0.0, &one.flight.steps);
    if (fails(one.run.outcome) && one.run.proved) {
      const ProvedEnds ends = judged(one.flight);
      one.proved_failure = ends.admissible && ends.surely_fails();
    }
    return one;
  }

  ProvedEnds judged(const BehaviourFlight& flight) const {
    return proved_ends(choices_.flow(), choices_.commands(), choices_.contract(), flight);
  }

  const BehaviourChoices& choices_;
  WitnessSearch search_;
  const BehaviourPilot& pilot_;
  const BehaviourRequest& request_;
};

}  // namespace

FlownBehaviours fly_behaviours(const Plan& plan, std::span<const State> starts,
                               const BehaviourRequest& request) {
  require(request.behaviours > 0 && !request.adversaries.empty(),
          "fly_behaviours: expected a behaviour and an adversary");
  const std::vector<CellKind> kinds = cell_kinds(plan.grid, plan.region, {});
  const Flow flow{plan.grid, plan.vehicle, plan.heading_rad.data(), kinds.data()};
  const BehaviourChoices choices(flow, request.contract);
  const FailureGuide guide(choices);
  const BehaviourPilot pilot(choices, &guide);
  FlownBehaviours flown{request.contract, request.adversaries, request.behaviours, {}, {}};
  flown.outcomes.resize(starts.size());
  flown.worst.resize(starts.size());
  std::mutex counting;
  std::size_t done = 0;
  for_ranges(starts.size(), 8, [&](std::size_t begin, std::size_t end) {
    StartFlier flier(choices, guide, pilot, request);
    for (std::size_t i = begin; i < end; ++i) {
      const Flown worst = flier.fly(starts[i], i, flown.outcomes[i]);
      flown.worst[i] = flight_of(worst, plan.vehicle.speed_mps, request.record);
    }
    const std::lock_guard lock(counting);
    done += end - begin;
    if (request.progress) request.progress(done);
  });
  return flown;
}

std::vector<Adversary> adversaries_of(const std::string& name) {
  std::vector<Adversary> found;
  for (const Adversary adversary : adversaries_in_order) {
    if (name == "all" || name == name_of(adversary)) found.push_back(adversary);
  }
  return found;
}

}  // namespace fairway
