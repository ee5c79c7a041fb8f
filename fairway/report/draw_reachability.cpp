#include "fairway/report/draw_reachability.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/share_panels.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

/// Hues and patterns of verdicts, but paler: nothing here is proved.
VerdictStyle style_of(Sampled answer) {
  switch (answer) {
    case Sampled::reach:
      return {color_of_oklch(0.90, 0.045, 255.0), {}, false, false};
    case Sampled::other:
      return {color_of_oklch(0.72, 0.11, 40.0), {palette::white, 0.5, {}}, true, false};
    case Sampled::undecided:
      break;
  }
  return style_of(Verdict::undecided);
}

const char* words_of(Sampled answer) {
  switch (answer) {
    case Sampled::reach:
      return "samples reach";
    case Sampled::other:
      return "samples do not reach";
    case Sampled::undecided:
      break;
  }
  return "samples disagree";
}

}  // namespace

Picture draw_reachability_slices(const ReachabilityMap& map, const VerdictPictureOptions& options) {
  const VerdictMap& places = map.places;
  const auto of = static_cast<std::size_t>(
      std::count(places.kind.begin(), places.kind.end(), CellKind::ordinary));
  std::vector<PanelCaption> captions;
  for (std::size_t h = 0; h < places.heading_rad.size(); ++h) {
    std::size_t reaching = 0;
    for (std::size_t i = 0; i < places.samples(); ++i) {
      reaching += map.answer_at(h, i) == Sampled::reach ? 1 : 0;
    }
    captions.push_back({heading_text(places.heading_rad[h]), places.heading_rad[h],
                        of > 0 ? percent_text(reaching, of) + " reach" : ""});
  }
  std::vector<LegendEntry> entries;
  for (const Sampled answer : sampled_in_order) {
    const VerdictStyle style = style_of(answer);
    entries.push_back(
        hatched_entry(words_of(answer), style.ground, style.pen, style.rising, style.falling));
  }
  entries.push_back({"a picture, not a proof", {}});
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 150.0;
  MapPanels page(places, {options.title, 4, panel_pt, options.pixels_per_pt}, std::move(captions),
                 std::move(entries));
  for (std::size_t h = 0; h < places.heading_rad.size(); ++h) {
    std::vector<SamplePattern> patterns;
    for (const Sampled answer : sampled_in_order) {
      const VerdictStyle style = style_of(answer);
      patterns.push_back({style.pen, style.rising, style.falling, [&map, h, answer](std::size_t i) {
                            return map.places.kind[i] == CellKind::ordinary &&
                                   map.answer_at(h, i) == answer;
                          }});
    }
    page.draw_panel(
        h, [&](std::size_t i) { return style_of(map.answer_at(h, i)).ground; }, patterns);
  }
  return page.finish();
}

Picture draw_reachability_shares(const ReachabilityMap& map, const VerdictPictureOptions& options) {
  const auto part = [&map](std::size_t i, std::size_t panel) {
    return std::size_t{map.count[i][static_cast<std::size_t>(sampled_in_order[panel])]};
  };
  SharePanels shares;
  for (std::size_t panel = 0; panel < SharePanels::count; ++panel) {
    shares.names[panel] = words_of(sampled_in_order[panel]);
  }
  shares.each = static_cast<std::size_t>(map.headings_per_sample);
  shares.of = fmt::format("of {} headings per cell", map.headings_per_sample);
  shares.part = part;
  return draw_share_panels(map.places, shares, options);
}

}  // namespace fairway
