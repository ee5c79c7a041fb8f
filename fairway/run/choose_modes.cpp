#include "fairway/run/choose_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/field/turning_field.hpp"
#include "fairway/run/stratified_states.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/hand_over.hpp"
#include "fairway/verify/section_flight.hpp"
#include "fairway/verify/state_flight.hpp"

namespace fairway {
namespace {

constexpr std::uint64_t seed_of_a_choice = 1;
constexpr int directions = 16;
/// How far from walls a field bends along them, in turning radii. Between 0.8 and 1.8 the modes of
/// Berlin_1_256 prove the same share to 0.1 %.
constexpr double bend_radii = 1.2;

/// A flight from border to border, of one state under one mode.
class BorderFlight {
 public:
  explicit BorderFlight(const Flow& flow) : flow_(flow) {}

  /// Where the state meets the section first. False: it ends before, or what it does is not clear.
  bool start(const State& s) {
    follow_state(flow_, s.position_m.x, s.position_m.y, s.heading.rad(), usual_most_crossings,
                 *this);
    return take_step();
  }
  bool go_on() {
    follow_to_section(flow_, front_of_section(flow_, now_.section, along_of(now_.range, cell_m())),
                      usual_most_crossings, *this);
    return take_step();
  }
  const LeafPlace& place() const { return now_; }

  void arrive(std::size_t section, Interval along_m, double, bool) {
    ++reports_;
    next_ = {static_cast<std::uint32_t>(section), units_of(along_m, cell_m())};
  }
  void end(Verdict, double) { reports_ = 2; }
  void give_up() { reports_ = 2; }

 private:
  double cell_m() const { return flow_.grid.cell_m; }
  /// Enclosures grow from border to border: only their middle is flown on. This is a sample.
  bool take_step() {
    const bool clear = reports_ == 1;
    reports_ = 0;
    const std::uint32_t middle = next_.range.lo + (next_.range.hi - next_.range.lo) / 2;
    now_ = {next_.section, {middle, middle}};
    return clear;
  }

  const Flow& flow_;
  LeafPlace now_;
  LeafPlace next_;
  int reports_ = 0;
};

/// Whether the state comes to where mode 0 is proved, flying this mode.
bool is_handed_over(const Flow& mode, const State& start, std::span<const ModeView> first) {
  // Ten turning circles: a mode that needs more is hardly ever the one that saves a state.
  const double longest_m = 60.0 * mode.vehicle.turn_radius_m;
  const int most_borders = static_cast<int>(longest_m / mode.grid.cell_m);
  BorderFlight flight(mode);
  if (!flight.start(start)) return false;
  for (int borders = 0; borders < most_borders; ++borders) {
    if (hand_over(mode, flight.place(), first, usual_most_crossings).mode != no_mode) return true;
    if (!flight.go_on()) return false;
  }
  return false;
}

/// A field that may become a mode, and which states it saves.
struct Candidate {
  ModeRecord record;
  std::vector<float> heading_rad;
  std::vector<std::uint8_t> saves;  // [states that mode 0 does not bring]
};

/// Cells from which mode 0 is proved to bring the vehicle whichever way it faces, as far as eight
/// headings in its middle tell.
std::vector<std::uint8_t> turning_places(const ProofView& proof) {
  constexpr int headings = 8;
  constexpr double aside_rad = 0.1;  // off the axes, where flights meet ties
  const Grid& grid = proof.flow.grid;
  std::vector<std::uint8_t> places(grid.size(), 0);
  for_ranges(grid.size(), 64, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i) {
      if (proof.flow.kind[i] != CellKind::ordinary) continue;
      const Vec2 p = grid.center(grid.cell_at(i));
      bool all = true;
      for (int k = 0; all && k < headings; ++k) {
        const double rad = Heading::from_rad(aside_rad + two_pi * k / headings).rad();
        all = ask_mode(proof, 0, p.x, p.y, rad).only() == Verdict::reach;
      }
      places[i] = all ? 1 : 0;
    }
  });
  return places;
}

std::vector<Candidate> candidates(const Plan& plan, const ProofView& proof) {
  const double reach_m = bend_radii * plan.vehicle.turn_radius_m;
  std::vector<Candidate> all{{{"turning_places"},
                              turning_field(plan.grid, plan.region, turning_places(proof), reach_m),
                              {}}};
  for (int k = 0; k < directions; ++k) {
    const double direction_rad = Heading::from_rad(two_pi * k / directions).rad();
    all.push_back({{"direction", direction_rad},
                   direction_field(plan.grid, plan.region, direction_rad, reach_m),
                   {}});
  }
  return all;
}

/// All cells that states are counted in.
std::vector<bool> ground_of(const Plan& plan) {
  std::vector<bool> ground(plan.grid.size());
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ground[i] = plan.region[i] != Region::obstacle && plan.region[i] != Region::goal;
  }
  return ground;
}

/// How many states a candidate saves that are still lost.
std::size_t count_saved(const Candidate& candidate, const std::vector<std::uint8_t>& lost) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lost.size(); ++i) count += candidate.saves[i] & lost[i];
  return count;
}

}  // namespace

ChosenModes choose_modes(const Plan& plan, const std::string& where, const ModeOptions& options) {
  CertifyOptions coarse;
  coarse.undecided_max = 0.02;
  coarse.samples = options.states;
  coarse.last_level = 16;
  Plan first = plan;
  first.mode_heading_rad.clear();
  first.record.modes.clear();
  const Verification proved = verify_plan(first, where, {}, coarse);
  const ProofView view = proved.certificate.view();
  const std::array<ModeView, 1> earlier{{{view.flow, view.sections}}};

  const std::vector<State> states =
      stratified_states(plan.grid, ground_of(plan), options.states / 2, seed_of_a_choice);
  std::vector<State> rest;
  for (const State& s : states) {
    const VerdictSet known = ask_mode(view, 0, s.position_m.x, s.position_m.y, s.heading.rad());
    if (known.only() != Verdict::reach) rest.push_back(s);
  }
  ChosenModes chosen;
  if (states.empty()) return chosen;
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(states.size());
  };
  chosen.alone = share(states.size() - rest.size());

  std::vector<Candidate> all = candidates(plan, view);
  for (Candidate& candidate : all) {
    candidate.saves.assign(rest.size(), 0);
    Flow mode = view.flow;
    mode.heading_rad = candidate.heading_rad.data();
    mode.holding = nullptr;
    for_ranges(rest.size(), 16, [&](std::size_t a, std::size_t b) {
      for (std::size_t i = a; i < b; ++i) {
        candidate.saves[i] = is_handed_over(mode, rest[i], earlier) ? 1 : 0;
      }
    });
  }
  std::vector<std::uint8_t> lost(rest.size(), 1);
  while (chosen.records.size() < options.most) {
    const auto best = std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
      return count_saved(a, lost) < count_saved(b, lost);
    });
    const double gain = share(count_saved(*best, lost));
    if (gain < options.least_gain || gain == 0.0) break;
    chosen.heading_rad.insert(chosen.heading_rad.end(), best->heading_rad.begin(),
                              best->heading_rad.end());
    chosen.records.push_back(best->record);
    chosen.gain.push_back(gain);
    for (std::size_t i = 0; i < lost.size(); ++i) {
      if (best->saves[i] != 0) lost[i] = 0;
    }
  }
  return chosen;
}

bool are_worth_it(const ChosenModes& chosen) {
  constexpr double worth_it = 0.02;
  return std::accumulate(chosen.gain.begin(), chosen.gain.end(), 0.0) > worth_it;
}

}  // namespace fairway
