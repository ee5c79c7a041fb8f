#include "tests/falsify/wide_modal_flight.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr std::uint64_t most_crossings = 40000;
constexpr std::uint64_t most_in_further_modes = 4000;

}  // namespace

WideModalFlights::WideModalFlights(const ProofView& proof) : proof_(proof) {
  for (int k = 0; k < proof.modes(); ++k) flows_.push_back(proof.flow_of(k));
  commands_.resize(flows_.size());
}

const WideCommands<Wide>& WideModalFlights::commands(int mode) const {
  const auto k = static_cast<std::size_t>(mode);
  const std::lock_guard lock(mutex_);
  if (!commands_[k]) commands_[k] = std::make_unique<WideCommands<Wide>>(flows_[k]);
  return *commands_[k];
}

int WideModalFlights::next_mode(int mode, const WideMeeting<Wide>& met,
                                const std::function<std::size_t(std::size_t)>& choice) const {
  const SectionView sections = proof_.sections_of(mode);
  const Wide units = met.along_m * Wide(units_per_side) / Wide(proof_.flow.grid.cell_m);
  const double below_units = std::floor(static_cast<double>(units));
  const auto unit = static_cast<std::uint32_t>(
      std::clamp(Wide(below_units) > units ? below_units - 1.0 : below_units, 0.0, 0x1p32 - 1.0));
  std::vector<std::size_t> leaves;
  sections.for_leaves(met.section, {unit, unit}, [&](std::size_t leaf) {
    // A place beyond the start of a leaf belongs to it alone.
    if (leaves.size() == 1 && Wide(sections.begin[leaf]) < units) leaves.clear();
    leaves.push_back(leaf);
  });
  if (leaves.empty()) return mode;
  const std::size_t leaf = leaves[leaves.size() > 1 ? choice(leaves.size()) : 0];
  const std::uint8_t next = sections.next_mode == nullptr ? no_mode : sections.next_mode[leaf];
  return next == no_mode ? mode : static_cast<int>(next);
}

WideMeeting<Wide> WideModalFlights::fly(
    const Start& start, int mode, const std::function<std::size_t(std::size_t)>& choice) const {
  Start here = start;
  long double flown_m = 0;
  std::uint64_t crossings = 0;
  while (mode > 0) {
    WideFlight<Wide> flight(commands(mode), here.ix, here.iy, here.p, here.u, choice);
    int next = mode;
    WideMeeting<Wide> met;
    while (next == mode) {
      met = flight.fly(most_in_further_modes - crossings);
      crossings += met.crossings + 1;
      if (met.section == WideMeeting<Wide>::none) {
        met.length_m += flown_m;
        return met;
      }
      if (crossings >= most_in_further_modes) return {};
      next = next_mode(mode, met, choice);
    }
    flown_m += met.length_m;
    here = {flight.ix(), flight.iy(), flight.position(), flight.heading()};
    mode = next;
  }
  WideFlight<Wide> last(commands(0), here.ix, here.iy, here.p, here.u, choice);
  WideMeeting<Wide> end = last.fly_to_end(most_crossings);
  end.length_m += flown_m;
  return end;
}

WideJudgement WideModalFlights::judge(const ModeClaim& claim) const {
  const Grid& grid = proof_.flow.grid;
  const double d = grid.cell_m;
  const WideVec<Wide> u = wide_unit<Wide>(claim.heading_rad);
  WideJudgement judgement;
  const auto fly_from = [&](int ix, int iy) {
    const WideVec<Wide> p{Wide(claim.x_m) - (Wide(grid.x0_m) + Wide(ix) * Wide(d)),
                          Wide(claim.y_m) - (Wide(grid.y0_m) + Wide(iy) * Wide(d))};
    if (p.x < 0 || p.x > d || p.y < 0 || p.y > d) return;
    const CellKind kind = proof_.flow.kind_at({ix, iy});
    judgement.ends += fmt::format(" [{},{}:{}]", ix, iy, static_cast<int>(kind));
    judgement.contradicted = judgement.contradicted || kind == CellKind::obstacle;
    if ((p.x == 0 && u.x < 0) || (p.x == d && u.x > 0)) return;
    if ((p.y == 0 && u.y < 0) || (p.y == d && u.y > 0)) return;
    if (kind != CellKind::ordinary) {
      judgement.contradicted = judgement.contradicted || kind != CellKind::target;
      return;
    }
    for (std::uint64_t draw = 0; draw < 3; ++draw) {
      Random picks(draw);
      const auto end = fly({ix, iy, p, u}, claim.mode, [&](std::size_t n) {
        return draw == 0 ? std::size_t{0} : static_cast<std::size_t>(picks.below(n));
      });
      const double time_s = static_cast<double>(end.length_m) / proof_.flow.vehicle.speed_mps;
      judgement.ends += fmt::format(" {}@{:.9g}s", name_of(end.end), time_s);
      if (end.end == Verdict::undecided) {
        judgement.unknown = true;
      } else if (end.end != Verdict::reach) {
        judgement.contradicted = true;
      } else if (time_s > claim.bound_s) {
        judgement.late = true;
      }
    }
  };
  const int cx = static_cast<int>(std::floor((claim.x_m - grid.x0_m) / d));
  const int cy = static_cast<int>(std::floor((claim.y_m - grid.y0_m) / d));
  for (int iy = cy - 1; iy <= cy + 1; ++iy) {
    for (int ix = cx - 1; ix <= cx + 1; ++ix) fly_from(ix, iy);
  }
  return judgement;
}

}  // namespace fairway
