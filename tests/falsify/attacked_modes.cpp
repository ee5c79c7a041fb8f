#include "tests/falsify/attacked_modes.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/vehicle/modes.hpp"

namespace fairway {
namespace {

Flow flow_of(const ContractCertificate& certificate, int mode) {
  Flow flow = certificate.flow();
  flow.holding = nullptr;
  if (mode > 0) {
    flow.heading_rad = certificate.mode_heading_rad.data() +
                       static_cast<std::size_t>(mode - 1) * certificate.grid.size();
  }
  return flow;
}

}  // namespace

AttackedMode::AttackedMode(const ContractCertificate& certificate, int mode,
                           const NearestObstacle& obstacles)
    : flow(flow_of(certificate, mode)),
      parts(mode == 0 ? certificate.parts() : certificate.parts_of_mode(mode)),
      verdicts(mode == 0 ? ContractVerdictsView(certificate.verdicts)
                         : certificate.verdicts_of_mode(mode)),
      lookup(parts, verdicts, certificate.least_speed_mps()),
      choices(flow, certificate.contract),
      guide(choices),
      pilot(choices, guide, obstacles),
      hands_over(4 * parts.size()),
      may_change(parts.size()) {
  if (mode == 0) return;
  find_leaves();
  find_where_it_may_change(EstimateError::of(certificate.contract));
}

void AttackedMode::find_where_it_may_change(const EstimateError& error) {
  const int around = static_cast<int>(std::ceil(2.0 * error.place_m / parts.part_m())) + 1;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    bool any = false;
    for (std::size_t side = 0; side < 4; ++side) any = any || hands_over[4 * p + side];
    if (!any) continue;
    const PartPlace at = parts.place(p);
    for (int iy = std::max(at.iy - around, 0); iy <= std::min(at.iy + around, parts.ny() - 1);
         ++iy) {
      for (int ix = std::max(at.ix - around, 0); ix <= std::min(at.ix + around, parts.nx() - 1);
           ++ix) {
        may_change[parts.index({ix, iy})] = true;
      }
    }
  }
}

void AttackedMode::find_leaves() {
  std::vector<HandedLeaf> inner;
  const auto next_of = [&](std::size_t leaf) {
    return verdicts.group_next_mode[verdicts.group[leaf]];
  };
  for (std::size_t s = 0; s < hands_over.size(); ++s) {
    const std::size_t first = verdicts.first[s];
    const std::size_t last = verdicts.first[s + 1];
    for (std::size_t leaf = first; leaf < last; ++leaf) {
      const std::uint8_t next = next_of(leaf);
      if (next == no_mode) continue;
      hands_over[s] = true;
      const double hi = leaf + 1 < last ? verdicts.begin[leaf + 1] * 0x1p-32 : 1.0;
      const bool beside = (leaf > first && next_of(leaf - 1) != next) ||
                          (leaf + 1 < last && next_of(leaf + 1) != next);
      (beside ? leaves : inner)
          .push_back({parts.place(s / 4), static_cast<PartSide>(s % 4),
                      verdicts.begin[leaf] * 0x1p-32, hi, static_cast<int>(next),
                      static_cast<double>(verdicts.group_time_s[verdicts.group[leaf]])});
    }
  }
  beside_others = leaves.size();
  leaves.insert(leaves.end(), inner.begin(), inner.end());
}

AttackedModes::AttackedModes(const ContractCertificate& certificate_)
    : certificate(certificate_),
      contract(certificate.contract),
      error(EstimateError::of(contract)),
      least_mps(certificate.least_speed_mps()),
      obstacles(certificate.flow()) {
  for (int mode = 0; mode <= certificate.further_modes(); ++mode) {
    modes.emplace_back(certificate, mode, obstacles);
  }
  on_board.look_into(certificate);
  pilot.emplace(on_board);
  usual_most_m = BehaviourPilot(modes.front().choices).default_limit_m();
}

}  // namespace fairway
