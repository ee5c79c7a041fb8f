#include "fairway/compare/difference_map.hpp"

#include <fmt/format.h>

#include "fairway/compare/measure_plan.hpp"
#include "fairway/compare/state_verdicts.hpp"
#include "fairway/report/share_panels.hpp"

namespace fairway {
namespace {

/// What is known of the states, of a plan proved or else flown.
std::vector<Verdict> known_of(const ComparedPlan& plan, Knowledge of,
                              const std::vector<State>& states) {
  if (of == Knowledge::contract) return verdicts_of(*plan.contract, states);
  if (plan.certificate) return verdicts_of(*plan.certificate, states);
  return seen_from(states, plan.plan);
}

}  // namespace

std::vector<DifferenceMap> difference_maps(std::span<const ComparedPlan> plans,
                                           const CommonGround& ground, Knowledge of, int across,
                                           int headings) {
  DifferenceMap empty;
  empty.places = VerdictMap::over(ground.grid, headings, across);
  empty.each = empty.places.heading_rad.size();
  const std::size_t samples = empty.places.samples();
  for (auto* counts : {&empty.only_first, &empty.only_second, &empty.neither}) {
    counts->assign(samples, 0);
  }
  std::vector<State> states;
  std::vector<std::size_t> sample_of;  // [state]
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec2 place = empty.places.place_m(i);
    bool common = true;
    bool goal = false;
    for (const ComparedPlan& p : plans) {
      common = common && is_on_ground(p.plan, place);
      goal = goal || is_in(p.plan, {place, {}}, Region::goal);
    }
    empty.places.kind[i] = common ? CellKind::ordinary
                           : goal ? CellKind::target
                                  : CellKind::obstacle;
    if (!common) continue;
    for (const double heading_rad : empty.places.heading_rad) {
      states.push_back({place, Heading::from_rad(heading_rad)});
      sample_of.push_back(i);
    }
  }
  std::vector<DifferenceMap> maps;
  const std::vector<Verdict> first = known_of(plans[0], of, states);
  for (std::size_t k = 1; k < plans.size(); ++k) {
    DifferenceMap& map = maps.emplace_back(empty);
    const std::vector<Verdict> second = known_of(plans[k], of, states);
    for (std::size_t s = 0; s < states.size(); ++s) {
      const bool a = is_kept(first[s]);
      const bool b = is_kept(second[s]);
      if (a && b) continue;
      ++(a ? map.only_first : b ? map.only_second : map.neither)[sample_of[s]];
    }
  }
  return maps;
}

Picture draw_difference(const Comparison& c, const PairDifference& pair) {
  const DifferenceMap& map = pair.map;
  const std::string only = "only " + c.names[pair.first];
  const std::string other = "only " + c.names[pair.second];
  SharePanels panels;
  panels.names = {only.c_str(), other.c_str(), "neither"};
  panels.each = map.each;
  panels.of = fmt::format("of {} headings", map.each);
  panels.part = [&](std::size_t sample, std::size_t panel) -> std::size_t {
    return panel == 0   ? map.only_first[sample]
           : panel == 1 ? map.only_second[sample]
                        : map.neither[sample];
  };
  return draw_share_panels(map.places, panels, {.title = c.known_to(pair.of)});
}

std::string picture_name(std::size_t plans, std::size_t second, Knowledge of) {
  return "difference" + (plans > 2 ? fmt::format("-{}", second + 1) : "") +
         (of == Knowledge::contract ? "-contract" : "");
}

}  // namespace fairway
