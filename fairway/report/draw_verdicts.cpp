#include "fairway/report/draw_verdicts.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/share_panels.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

std::size_t ordinary_samples(const VerdictMap& map) {
  return static_cast<std::size_t>(std::count(map.kind.begin(), map.kind.end(), CellKind::ordinary));
}

/// Whether a state of the picture has this verdict: one of those shown, or of those counted.
bool has(const VerdictMap& map, Verdict verdict) {
  const auto code = static_cast<std::size_t>(verdict);
  return std::count(map.verdict.begin(), map.verdict.end(), verdict) > 0 ||
         std::any_of(map.count.begin(), map.count.end(),
                     [code](const auto& count) { return count[code] > 0; });
}

enum Share : std::size_t { safe, failing, open };

std::size_t states_of(const VerdictMap& map, std::size_t sample, Share share) {
  std::size_t states = 0;
  for (const Verdict verdict : verdicts_in_order) {
    const Share its = fails(verdict) ? failing : verdict == Verdict::undecided ? open : safe;
    if (its == share) states += map.count[sample][static_cast<std::size_t>(verdict)];
  }
  return states;
}

/// What a picture shows of a state: its verdict, or that it is at risk.
class Shown {
 public:
  Shown(const VerdictMap& map, const std::vector<std::uint8_t>* at_risk)
      : map_(map), at_risk_(at_risk) {
    require(at_risk == nullptr || at_risk->size() == map.verdict.size(),
            "states at risk are those of the verdict map");
  }

  bool at_risk(std::size_t heading, std::size_t sample) const {
    return at_risk_ != nullptr && (*at_risk_)[heading * map_.samples() + sample] != 0;
  }
  Color ground(std::size_t heading, std::size_t sample) const {
    return at_risk(heading, sample) ? at_risk_style().ground
                                    : style_of(map_.verdict_at(heading, sample)).ground;
  }

  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (const Verdict verdict : verdicts_in_order) {
      if (at_risk_ != nullptr && verdict == Verdict::undecided) entries.push_back(at_risk_entry());
      if (!is_listed(verdict, has(map_, verdict))) continue;
      entries.push_back(verdict_entry(verdict));
    }
    return entries;
  }

  std::vector<SamplePattern> patterns(std::size_t heading) const {
    std::vector<SamplePattern> patterns;
    const auto add = [&](const VerdictStyle& style, const auto& covers) {
      patterns.push_back({style.pen, style.rising, style.falling, [this, covers](std::size_t i) {
                            return map_.kind[i] == CellKind::ordinary && covers(i);
                          }});
    };
    for (const Verdict verdict : verdicts_in_order) {
      add(style_of(verdict), [this, heading, verdict](std::size_t i) {
        return map_.verdict_at(heading, i) == verdict && !at_risk(heading, i);
      });
    }
    if (at_risk_ != nullptr) {
      add(at_risk_style(), [this, heading](std::size_t i) { return at_risk(heading, i); });
    }
    return patterns;
  }

 private:
  const VerdictMap& map_;
  const std::vector<std::uint8_t>* at_risk_;
};

}  // namespace

Picture draw_verdicts(const VerdictMap& map, const VerdictPictureOptions& options) {
  const Shown shown(map, options.at_risk);
  const std::size_t of = ordinary_samples(map);
  std::vector<PanelCaption> captions;
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    std::size_t reaching = 0;
    for (std::size_t i = 0; i < map.samples(); ++i) {
      const Verdict verdict = map.verdict_at(h, i);
      reaching += verdict == Verdict::reach || verdict == Verdict::follow ? 1 : 0;
    }
    captions.push_back({heading_text(map.heading_rad[h]), map.heading_rad[h],
                        of > 0 ? percent_text(reaching, of) + " reach" : ""});
  }
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 150.0;
  MapPanels page(map, {options.title, 4, panel_pt, options.pixels_per_pt}, std::move(captions),
                 shown.legend());
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    page.draw_panel(
        h, [&](std::size_t i) { return shown.ground(h, i); }, shown.patterns(h));
  }
  return page.finish();
}

Picture draw_proved_shares(const VerdictMap& map, const VerdictPictureOptions& options) {
  SharePanels shares;
  shares.names = {has(map, Verdict::hold) ? "proved to reach or hold" : "proved to reach",
                  "proved to fail", "undecided"};
  shares.each = static_cast<std::size_t>(map.states_per_sample);
  shares.of = fmt::format("of {} states per cell", map.states_per_sample);
  shares.part = [&map](std::size_t i, std::size_t panel) {
    return states_of(map, i, static_cast<Share>(panel));
  };
  return draw_share_panels(map, shares, options);
}

}  // namespace fairway
