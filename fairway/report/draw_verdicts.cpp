#include "fairway/report/draw_verdicts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/share_panels.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

std::size_t ordinary_samples(const VerdictMap& map) {
  return static_cast<std::size_t>(std::count(map.kind.begin(), map.kind.end(), CellKind::ordinary));
}

enum Share : std::size_t { reached, failing, open };

std::size_t states_of(const VerdictMap& map, std::size_t sample, Share share) {
  std::size_t states = 0;
  for (const Verdict verdict : verdicts_in_order) {
    const Share its = fails(verdict) ? failing : verdict == Verdict::reach ? reached : open;
    if (its == share) states += map.count[sample][static_cast<std::size_t>(verdict)];
  }
  return states;
}

}  // namespace

Picture draw_verdicts(const VerdictMap& map, const VerdictPictureOptions& options) {
  const std::size_t of = ordinary_samples(map);
  std::vector<PanelCaption> captions;
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    std::size_t reaching = 0;
    for (std::size_t i = 0; i < map.samples(); ++i) {
      reaching += map.verdict_at(h, i) == Verdict::reach ? 1 : 0;
    }
    captions.push_back({heading_text(map.heading_rad[h]), map.heading_rad[h],
                        of > 0 ? percent_text(reaching, of) + " reach" : ""});
  }
  std::vector<LegendEntry> entries;
  for (const Verdict verdict : verdicts_in_order) {
    entries.push_back(verdict_entry(verdict));
  }
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 150.0;
  MapPanels page(map, {options.title, 4, panel_pt, options.pixels_per_pt}, std::move(captions),
                 std::move(entries));
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    std::vector<SamplePattern> patterns;
    for (const Verdict verdict : verdicts_in_order) {
      const VerdictStyle style = style_of(verdict);
      patterns.push_back(
          {style.pen, style.rising, style.falling, [&map, h, verdict](std::size_t i) {
             return map.kind[i] == CellKind::ordinary && map.verdict_at(h, i) == verdict;
           }});
    }
    page.draw_panel(
        h, [&](std::size_t i) { return style_of(map.verdict_at(h, i)).ground; }, patterns);
  }
  return page.finish();
}

Picture draw_proved_shares(const VerdictMap& map, const VerdictPictureOptions& options) {
  SharePanels shares;
  shares.names = {"proved to reach", "proved to fail", "undecided"};
  shares.each = static_cast<std::size_t>(map.states_per_sample);
  shares.of = fmt::format("of {} states per cell", map.states_per_sample);
  shares.part = [&map](std::size_t i, std::size_t panel) {
    return states_of(map, i, static_cast<Share>(panel));
  };
  return draw_share_panels(map, shares, options);
}

}  // namespace fairway
