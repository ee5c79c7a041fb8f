#include "fairway/inclusion/contract_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/inclusion/set_flight.hpp"
#include "fairway/inclusion/testing/behaviour.hpp"
#include "fairway/vehicle/filled_commands.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr double step_m = 0.02;

/// A goal among some obstacles, and fields that go on in one direction each.
struct Trial {
  Plan plan = empty_plan(18, 15, 1.0, 2.0);
  VehicleContract contract;
  EstimateError error;
  std::vector<std::vector<float>> further;

  explicit Trial(std::uint64_t seed) {
    Random random = Random::stream(0x0de5, seed);
    plan.vehicle.turn_radius_m = random.uniform(1.4, 2.6);
    const Vec2 goal{random.uniform(5.0, 13.0), random.uniform(4.0, 11.0)};
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Vec2 p = plan.grid.center(plan.grid.cell_at(i));
      const Vec2 to = goal - p;
      plan.heading_rad[i] = static_cast<float>(std::atan2(to.y, to.x));
      if (norm2(to) < 4.0) plan.region[i] = Region::goal;
      if (norm2(to) >= 9.0 && random.below(40) == 0) plan.region[i] = Region::obstacle;
      if (plan.region[i] == Region::obstacle) {
        plan.heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
      }
    }
    const double turn_rad = random.uniform(0.0, 0.25 * pi);
    const std::size_t directions = 4 + random.below(3);
    for (std::size_t k = 0; k < directions; ++k) {
      const double at =
          turn_rad + 2.0 * pi * static_cast<double>(k) / static_cast<double>(directions);
      further.emplace_back(plan.grid.size(), static_cast<float>(std::remainder(at, 2.0 * pi)));
    }
    contract = VehicleContract::of(plan.vehicle);
    const double r = plan.vehicle.turn_radius_m;
    contract.turn_radius_m = {0.95 * r, 1.05 * r};
    contract.command_error_m = random.uniform(0.06, 0.3);
    contract.heading_error_rad = random.uniform(0.01, 0.04);
    if (random.below(3) == 0) contract.side_uncertain_rad = random.uniform(0.0, 0.3);
    error = EstimateError::of(contract);
  }
};

struct Proof {
  Proof(const Trial& trial, int per_cell, const EstimateError& error)
      : held(trial.plan), flow(held.flow()), parts(flow, trial.contract, per_cell) {
    InclusionLimits limits;
    limits.last_level = 3;
    speed_mps = trial.contract.speed_mps.least;
    InclusionProver prover(parts, limits);
    prover.run([](const InclusionLevel&) {});
    verdicts = prover.verdicts(speed_mps);
    std::vector<const float*> further;
    for (const auto& field : trial.further) further.push_back(field.data());
    modes.push_back({parts, verdicts});
    proof = prove_contract_modes(flow, further, trial.contract, per_cell, error, modes.front(),
                                 limits, [](int) {});
    for (const auto& mode : proof.further) modes.push_back({mode->parts, mode->verdicts});
  }
  const ContractVerdicts& of(int mode) const {
    return mode == 0 ? verdicts : proof.further[static_cast<std::size_t>(mode) - 1]->verdicts;
  }
  ContractModeAnswer at(Vec2 place_m, double heading_rad) const {
    return answer_of_modes(modes, speed_mps, (1.0 / parts.part_m()) * place_m, heading_rad);
  }

  PlanFlow held;
  Flow flow;
  Parts parts;
  ContractVerdicts verdicts;
  ContractModesProof proof;
  std::vector<ContractMode> modes;
  double speed_mps = 0.0;
};

double off_arc(const HeadingArc& arc, double heading_rad) {
  const double past = counted_from_zero(heading_rad - arc.lo_rad);
  return past <= arc.width_rad ? 0.0 : std::min(past - arc.width_rad, whole_turn_rad - past);
}

/// A leaf of `mode` that is handed over, within these distances of a state, and in time; by brute
/// force over the parts around it. Returns its group; 0: none.
std::uint32_t handed_over_near(const Proof& proof, int mode, Vec2 place_m, double heading_rad,
                               double near_m, double near_rad, double in_time_s) {
  const Parts& parts = proof.modes[static_cast<std::size_t>(mode)].parts;
  const ContractVerdicts& v = proof.of(mode);
  const Vec2 at = (1.0 / parts.part_m()) * place_m;
  const double near = near_m / parts.part_m();
  const int reach = static_cast<int>(std::ceil(near)) + 1;
  const int cx = static_cast<int>(std::floor(at.x));
  const int cy = static_cast<int>(std::floor(at.y));
  for (int iy = std::max(cy - reach, 0); iy <= std::min(cy + reach, parts.ny() - 1); ++iy) {
    for (int ix = std::max(cx - reach, 0); ix <= std::min(cx + reach, parts.nx() - 1); ++ix) {
      const PartPlace part{ix, iy};
      if (parts.kind(part) != PartKind::ordinary) continue;
      if (off_arc(parts.arc(part), heading_rad) > near_rad) continue;
      for (std::size_t side = 0; side < 4; ++side) {
        const HeadingArc outward{side_axes[side].heading_rad - 0.5 * pi, pi};
        if (off_arc(outward, heading_rad) > near_rad) continue;
        const std::size_t s = 4 * parts.index(part) + side;
        for (std::size_t leaf = v.first[s]; leaf < v.first[s + 1]; ++leaf) {
          const std::uint32_t group = v.group[leaf];
          if (v.group_next_mode[group] == no_mode) continue;
          if (static_cast<double>(v.group_time_s[group]) > in_time_s) continue;
          const double lo = v.begin[leaf] * 0x1p-32;
          const double hi = leaf + 1 < v.first[s + 1] ? v.begin[leaf + 1] * 0x1p-32 : 1.0;
          const auto box = segment_of_side(part, static_cast<PartSide>(side), lo, hi).box();
          const Vec2 nearest{std::clamp(at.x, box.lowest.x, box.highest.x),
                             std::clamp(at.y, box.lowest.y, box.highest.y)};
          if (norm(at - nearest) <= near) return group;
        }
      }
    }
  }
  return 0;
}

struct Flown {
  Verdict end = Verdict::undecided;
  double way_m = 0.0;
  int changes = 0;
};

/// Flies from mode to mode as docs/modes.md says. `eager`: how soon it changes: 0 only where it
/// has to, 1 as soon as its estimate may allow it.
Flown fly(const Proof& proof, const Trial& trial, Vec2 place_m, double heading_rad, int mode,
          double time_s, double eager, Random& random) {
  Flown flown;
  Flow flow = proof.flow;
  double deadline_m = time_s * proof.speed_mps;
  const double step_rad = step_m / trial.contract.turn_radius_m.least;
  const double near_m = step_m + eager * 2.0 * (trial.error.place_m - step_m);
  const double near_rad = step_rad + eager * 2.0 * (trial.error.heading_rad - step_rad);
  for (;;) {
    if (mode > 0) flow.heading_rad = trial.further[static_cast<std::size_t>(mode) - 1].data();
    if (mode == 0) flow.heading_rad = trial.plan.heading_rad.data();
    const auto commands = filled_commands(flow.grid, flow.heading_rad);
    Behaviour behaviour(flow, commands, trial.contract, place_m, heading_rad, random.bits());
    std::uint32_t changes_by = 0;
    for (; changes_by == 0; flown.way_m += step_m) {
      place_m = behaviour.place();
      heading_rad = behaviour.heading_rad();
      const Cell cell = flow.grid.cell_of(place_m);
      if (!flow.grid.contains(cell)) flown.end = Verdict::leave;
      if (flow.kind_at(cell) == CellKind::obstacle) flown.end = Verdict::collide;
      if (flow.kind_at(cell) == CellKind::target) flown.end = Verdict::reach;
      if (flown.end != Verdict::undecided || flown.way_m > deadline_m + 1.0) return flown;
      const double rest_s = (deadline_m + 2.0 * step_m - flown.way_m) / proof.speed_mps;
      if (mode > 0) {
        changes_by = handed_over_near(proof, mode, place_m, heading_rad, near_m, near_rad, rest_s);
      }
      if (changes_by == 0) behaviour.step(step_m);
    }
    deadline_m = flown.way_m +
                 proof.speed_mps * static_cast<double>(proof.of(mode).group_time_s[changes_by]);
    mode = proof.of(mode).group_next_mode[changes_by];
    ++flown.changes;
  }
}

TEST(ContractModes, NoBehaviourContradictsAHandOver) {
  int proved = 0;
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Trial trial(seed);
    const Proof proof(trial, 1 + static_cast<int>(seed % 2), trial.error);
    Random random = Random::stream(0x0de6, seed);
    for (int k = 0; k < 1200; ++k) {
      const Vec2 p{random.uniform(0.0, 18.0), random.uniform(0.0, 15.0)};
      const double heading = random.uniform(-pi, pi);
      const ContractModeAnswer known = proof.at(p, heading);
      if (known.answer.verdict != Verdict::reach || known.mode == 0) continue;
      ++proved;
      for (const double eager : {0.0, 1.0, random.unit()}) {
        const Flown flown =
            fly(proof, trial, p, heading, known.mode, known.answer.worst_time_s, eager, random);
        changed += flown.changes;
        ASSERT_EQ(flown.end, Verdict::reach)
            << "seed " << seed << ", state " << p.x << ", " << p.y << ", " << heading << ", mode "
            << known.mode << ", eager " << eager << ", after " << flown.way_m << " m and "
            << flown.changes << " changes";
        ASSERT_LE(flown.way_m, known.answer.worst_time_s * proof.speed_mps + 1.0);
      }
    }
  }
  EXPECT_GT(proved, 60);
  EXPECT_GT(changed, 150);
}

TEST(ContractModes, FurtherModesOnlyAdd) {
  int more = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Trial trial(seed);
    const Proof proof(trial, 1, trial.error);
    Random random = Random::stream(0x0de7, seed);
    for (int k = 0; k < 1000; ++k) {
      const Vec2 p{random.uniform(0.0, 18.0), random.uniform(0.0, 15.0)};
      const double heading = random.uniform(-pi, pi);
      const ContractAnswer alone =
          contract_answer(proof.parts, proof.verdicts, proof.speed_mps, p, heading);
      const ContractModeAnswer all = proof.at(p, heading);
      more += all.mode > 0 ? 1 : 0;
      if (all.mode == 0) {
        EXPECT_EQ(all.answer.verdict, alone.verdict);
        continue;
      }
      EXPECT_NE(alone.verdict, Verdict::reach);
      EXPECT_EQ(all.answer.verdict, Verdict::reach);
    }
  }
  EXPECT_GT(more, 10);
}

TEST(ContractModes, AWorseEstimateHandsOverLess) {
  std::array<std::size_t, 3> handed{};
  Trial trial(0);
  trial.further.resize(2);
  for (std::size_t k = 0; k < handed.size(); ++k) {
    const auto by = static_cast<double>(2 * k);
    const Proof proof(trial, 1, {by * trial.error.place_m, by * trial.error.heading_rad});
    for (const auto& mode : proof.proof.further) {
      const ContractVerdicts& v = mode->verdicts;
      for (const std::uint32_t group : v.group) {
        handed[k] += v.group_next_mode[group] != no_mode ? 1 : 0;
      }
    }
  }
  EXPECT_GT(handed[0], handed[1]);
  EXPECT_GT(handed[1], handed[2]);
}

TEST(ContractModes, AFieldTwiceIsHandedOverNowhereButToTheFirst) {
  // The same commands once more prove nothing new, and a mode hands over to earlier ones only.
  Trial trial(1);
  trial.further = {trial.plan.heading_rad, trial.further.front()};
  const Proof proof(trial, 1, trial.error);
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    EXPECT_NE(
        proof.at({random.uniform(0.0, 18.0), random.uniform(0.0, 15.0)}, random.uniform(-pi, pi))
            .mode,
        1);
  }
  for (int mode = 1; mode < 3; ++mode) {
    for (const std::uint8_t next : proof.of(mode).group_next_mode) {
      EXPECT_TRUE(next == no_mode || next < mode);
    }
  }
}

TEST(ContractModes, AGrownSegmentHoldsAllPlacesSoNear) {
  Random random(4);
  for (int round = 0; round < 300; ++round) {
    const double lo = random.unit();
    const double hi = random.below(4) == 0 ? lo : random.uniform(lo, 1.0);
    const auto side = static_cast<PartSide>(random.below(4));
    const double by = random.below(5) == 0 ? 0.0 : random.uniform(0.0, 3.0);
    const ConvexSet segment = segment_of_side({3, 5}, side, lo, hi);
    const ConvexSet grown = grown_segment(segment, by);
    const auto box = segment.box();
    for (int k = 0; k < 40; ++k) {
      const double t = random.unit();
      const double angle = 0.125 * pi * static_cast<double>(random.below(16));
      const Vec2 p = box.lowest + t * (box.highest - box.lowest) +
                     by * (1.0 - 1e-9) * Vec2{std::cos(angle), std::sin(angle)};
      const auto corners = grown.corners();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i];
        const Vec2 b = corners[(i + 1) % corners.size()];
        EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), -1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace fairway
