#include "check/contract_groups.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "check/contract_rules.hpp"

namespace fairway_check {
namespace {

/// Inside a group every behaviour gains at least cos(astray) of its way along u, so it is among its
/// leaves for no longer than their extent along u takes; then it goes on from one of them.
struct GroupBound {
  double onwards_s = 0.0;
  double astray_rad = -1.0;
  double least_m = HUGE_VAL;
  double most_m = -HUGE_VAL;
};

}  // namespace

std::string defect_of_groups(const ContractCertificate& c, const std::vector<Share>& shares) {
  std::vector<GroupBound> groups(c.group_time_s.size());
  for (std::size_t s = 0; s + 1 < c.first.size(); ++s) {
    for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
      if (c.group[leaf] == 0) continue;
      GroupBound& g = groups[c.group[leaf]];
      g.onwards_s = std::max(g.onwards_s, shares[leaf].onwards_s);
      g.astray_rad = std::max(g.astray_rad, shares[leaf].astray_rad);
      const double u = c.group_heading_rad[c.group[leaf]];
      if (std::isnan(u)) continue;
      const Cell part = c.parts.part_at(s / 4);
      const Shape ends = places_on(static_cast<int>(s % 4), c.begin_of(leaf), c.end_of(s, leaf));
      for (const Point p : ends.corners()) {
        const double along =
            c.parts.side_m * ((part.x + p.x) * std::cos(u) + (part.y + p.y) * std::sin(u));
        g.least_m = std::min(g.least_m, along);
        g.most_m = std::max(g.most_m, along);
      }
    }
  }
  for (std::size_t i = 1; i < groups.size(); ++i) {
    const GroupBound& g = groups[i];
    const bool inside = g.astray_rad >= 0.0;
    const double inside_s = inside ? (g.most_m - g.least_m + touch * c.parts.side_m) /
                                         (c.contract.least_speed * std::cos(g.astray_rad))
                                   : 0.0;
    const double worst_s = (inside_s + g.onwards_s) * time_margin;
    if (worst_s <= static_cast<double>(c.group_time_s[i])) continue;
    return fmt::format("group {} takes up to {:.9g} s, but {:.9g} s is claimed", i, worst_s,
                       c.group_time_s[i]);
  }
  return "";
}

}  // namespace fairway_check
