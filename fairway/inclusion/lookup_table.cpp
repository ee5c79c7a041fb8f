#include "fairway/inclusion/lookup_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/parallel.hpp"
#include "fairway/inclusion/set_flight.hpp"

namespace fairway {
namespace {

constexpr unsigned undecided = 1U << static_cast<unsigned>(Verdict::undecided);

void set_arc(PartRecord& record, const HeadingArc& arc) {
  record.lo = units_of_angle(counted_from_zero(arc.lo_rad));
  record.width = units_of_angle(arc.width_rad);
  record.cos_lo = static_cast<float>(std::cos(arc.lo_rad));
  record.sin_lo = static_cast<float>(std::sin(arc.lo_rad));
  record.cos_hi = static_cast<float>(std::cos(arc.hi_rad()));
  record.sin_hi = static_cast<float>(std::sin(arc.hi_rad()));
  record.longest_way =
      std::nextafter(static_cast<float>(longest_way(arc)), std::numeric_limits<float>::infinity());
}

}  // namespace

LookupTable::LookupTable(const Parts& parts, const ContractVerdictsView& verdicts)
    : nx_(parts.nx()),
      ny_(parts.ny()),
      verdicts_(verdicts),
      record_(static_cast<std::size_t>(nx_ + 2) * static_cast<std::size_t>(ny_ + 2)),
      time_s_(record_.size()) {
  for_ranges(static_cast<std::size_t>(ny_ + 2), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t k = a * static_cast<std::size_t>(nx_ + 2);
         k < b * static_cast<std::size_t>(nx_ + 2); ++k) {
      PartRecord& record = record_[k];
      const PartPlace place{static_cast<int>(k % static_cast<std::size_t>(nx_ + 2)) - 1,
                            static_cast<int>(k / static_cast<std::size_t>(nx_ + 2)) - 1};
      const PartKind kind = parts.kind(place);
      record.bits = static_cast<std::uint32_t>(kind);
      if (kind != PartKind::ordinary) continue;
      const HeadingArc& arc = parts.arc(place);
      set_arc(record, arc);
      for (std::size_t side = 0; side < sections_per_part; ++side) {
        if (!is_crossed(arc, static_cast<PartSide>(side))) continue;
        record.bits |= 1U << (PartRecord::sides_at + side);
        const std::size_t section = sections_per_part * parts.index(place) + side;
        unsigned found = verdicts.first[section] == verdicts.first[section + 1] ? undecided : 0U;
        float time_s = 0.0F;
        for (auto leaf = verdicts.first[section]; leaf < verdicts.first[section + 1]; ++leaf) {
          found |= 1U << verdicts.verdict[leaf];
          time_s = std::max(time_s, verdicts.group_time_s[verdicts.group[leaf]]);
        }
        record.bits |= found << (PartRecord::verdicts_at + stored_verdict_count * side);
        record.bits |=
            found << (PartRecord::verdicts_at + stored_verdict_count * sections_per_part);
        time_s_[k][side] = time_s;
      }
    }
  });
}

LookupTable::Found LookupTable::find(PartPlace p, std::size_t side, double lo, double hi) const {
  const unsigned all = ringed(p).verdicts(side);
  if ((all & (all - 1)) == 0) return {all, static_cast<double>(time_s_[number(p)][side])};
  const std::size_t part = static_cast<std::size_t>(p.iy) * static_cast<std::size_t>(nx_) +
                           static_cast<std::size_t>(p.ix);
  Found found;
  for_leaves(verdicts_, sections_per_part * part + side, lo, hi, [&](std::size_t leaf) {
    found.verdicts |= 1U << verdicts_.verdict[leaf];
    found.time_s =
        std::max(found.time_s, static_cast<double>(verdicts_.group_time_s[verdicts_.group[leaf]]));
  });
  if (found.verdicts == 0) found.verdicts = undecided;
  return found;
}

}  // namespace fairway
