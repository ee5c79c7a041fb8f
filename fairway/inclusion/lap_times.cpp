// What a lap takes: sums over its stages (docs/trust.md, "The third theorem").
#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/inclusion/stage_finder.hpp"

namespace fairway {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Who checks may find some that head farther from their stage's direction.
constexpr double more = 1.03;

Vec2 unit(double rad) { return {std::cos(rad), std::sin(rad)}; }

/// Least and most of something.
struct Span {
  double least = infinite;
  double most = -infinite;
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

}  // namespace

/// u / (v cos) of each stage.
std::vector<Vec2> StageFinder::slowness() const {
  std::vector<Vec2> slow(made_.size());
  for (std::size_t k = 0; k < slow.size(); ++k) {
    const auto off = static_cast<double>(made_.off_rad[k]);
    if (std::isnan(off)) continue;
    slow[k] =
        (1.0 / (speed_.least * std::cos(off))) * unit(static_cast<double>(made_.heading_rad[k]));
  }
  return slow;
}

/// Calls body(k, place) for the ends of every range over which stage k is left for another.
template <typename Body>
void StageFinder::for_passings(const Body& body) const {
  for_links([&](Id id, const CrossingLink& link) {
    const CrossingGraph::Range range = graph_.leaves_of(link);
    long most = 0;
    for (Id to = range.first; to < range.last; ++to) {
      most = std::max(most, ahead(stage_[id], stage_[to]));
    }
    if (most == 0) return;
    const PartPlace part = parts_.place(link.section / sections_per_part);
    for (const std::uint32_t at : {std::uint32_t{link.lo}, link.hi + 1U}) {
      const double along = at / static_cast<double>(side_units);
      Vec2 place{static_cast<double>(part.ix), static_cast<double>(part.iy)};
      switch (static_cast<PartSide>(link.section % sections_per_part)) {
        case PartSide::east:
          place = place + Vec2{1.0, along};
          break;
        case PartSide::north:
          place = place + Vec2{1.0 - along, 1.0};
          break;
        case PartSide::west:
          place = place + Vec2{0.0, 1.0 - along};
          break;
        case PartSide::south:
          place = place + Vec2{along, 0.0};
          break;
      }
      for (long k = 0; k < most; ++k) body((stage_[id] + k) % count_, parts_.part_m() * place);
    }
  });
}

/// Laps begin where behaviours lie least apart along their way.
void StageFinder::begin_where_all_pass_together() {
  const std::vector<Vec2> slow = slowness();
  const auto n = static_cast<std::size_t>(count_);
  std::vector<Span> spread(n);  // of where the stage begins
  for_passings([&](long k, Vec2 place) {
    const std::size_t next = static_cast<std::size_t>(k + 1) % n;
    spread[next].add(dot(place, slow[next]));
  });
  std::size_t best = 0;
  double least = infinite;
  for (std::size_t k = 0; k < n; ++k) {
    const double wide = spread[k].most - spread[k].least;
    if (std::isnan(made_.off_rad[k]) || !(wide < least)) continue;
    least = wide;
    best = k;
  }
  for (std::vector<float>* of :
       {&made_.heading_rad, &made_.off_rad, &made_.time_s, &made_.station_m}) {
    std::rotate(of->begin(), of->begin() + static_cast<std::ptrdiff_t>(best), of->end());
  }
  std::vector<long> now(n);
  for (std::size_t k = 0; k < n; ++k) now[k] = static_cast<long>((k + n - best) % n);
  renumber(now, count_);
}

bool StageFinder::measure() {
  const std::vector<Vec2> slow = slowness();
  const auto n = static_cast<std::size_t>(count_);
  std::vector<Vec2> along;  // the way on is at least that much
  for (const float rad : made_.heading_rad) along.push_back(unit(static_cast<double>(rad)));
  std::vector<Span> late(n);  // of where the stage ends
  std::vector<Span> way(n);
  Span lap_s;  // of where laps begin
  Span lap_m;
  for_passings([&](long from, Vec2 place) {
    const auto k = static_cast<std::size_t>(from);
    const std::size_t next = (k + 1) % n;
    late[k].add(dot(place, slow[k] - slow[next]));
    way[k].add(dot(place, along[k] - along[next]));
    if (next != 0) return;
    lap_s.add(dot(place, slow[0]));
    lap_m.add(dot(place, along[0]));
  });
  double most_s = lap_s.most - lap_s.least;
  double least_m = lap_m.least - lap_m.most;
  for (std::size_t k = 0; k < n; ++k) {
    most_s += late[k].most + static_cast<double>(made_.time_s[k]);
    least_m += way[k].least;
  }
  if (!(std::isfinite(most_s) && std::isfinite(least_m))) return false;  // some stage is not left
  made_.lap_most_s = more * most_s;
  made_.lap_least_s = std::max(0.0, least_m / speed_.most / more);
  core_.stage.assign(graph_.leaves(), 0);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (core_.in[id]) core_.stage[id] = static_cast<std::uint16_t>(stage_[id] + 1);
  }
  return true;
}

}  // namespace fairway
