#include "fairway/report/draw_modes.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/share_panels.hpp"

namespace fairway {
namespace {

LegendEntry entry_of(const std::string& name, const VerdictStyle& style) {
  return hatched_entry(name, style.ground, style.pen, style.rising, style.falling);
}

}  // namespace

Picture draw_modes(const VerdictMap& map, const std::vector<ModeLook>& looks,
                   const VerdictPictureOptions& options) {
  require(looks.size() == static_cast<std::size_t>(map.modes), "every mode has a look");
  require(map.kind.size() == map.samples() &&
              map.verdict.size() == map.samples() * map.heading_rad.size() &&
              (map.mode.empty() || map.mode.size() == map.verdict.size()),
          "a verdict map's arrays fit its samples and headings");
  const std::size_t headings = map.heading_rad.size();
  std::vector<std::size_t> served(looks.size());
  bool some_by_none = false;
  std::vector<PanelCaption> captions;
  for (std::size_t h = 0; h < headings; ++h) {
    std::size_t of = 0;
    std::size_t by_further = 0;
    for (std::size_t i = 0; i < map.samples(); ++i) {
      if (map.kind[i] != CellKind::ordinary) continue;
      ++of;
      const std::uint8_t mode = map.mode_at(h, i);
      some_by_none = some_by_none || mode == no_mode;
      if (mode == no_mode) continue;
      require(mode < looks.size(), "a state is served by a mode of the plan");
      ++served[mode];
      by_further += mode > 0 ? 1 : 0;
    }
    captions.push_back({heading_text(map.heading_rad[h]), map.heading_rad[h],
                        of > 0 ? percent_text(by_further, of) + " by further modes" : ""});
  }
  std::vector<LegendEntry> legend;
  for (std::size_t mode = 0; mode < looks.size(); ++mode) {
    if (served[mode] > 0) legend.push_back(entry_of(looks[mode].name, looks[mode].style));
  }
  const VerdictStyle none = no_mode_style();
  if (some_by_none) legend.push_back(entry_of("no mode is proved to reach", none));
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 150.0;
  MapPanels page(map, {options.title, 4, panel_pt, options.pixels_per_pt}, std::move(captions),
                 std::move(legend));
  const auto style_at = [&](std::size_t h, std::size_t i) -> const VerdictStyle& {
    const std::uint8_t mode = map.mode_at(h, i);
    return mode == no_mode ? none : looks[mode].style;
  };
  for (std::size_t h = 0; h < headings; ++h) {
    std::vector<SamplePattern> patterns;
    const auto add = [&](const VerdictStyle& style, std::uint8_t mode) {
      if (!style.rising && !style.falling) return;
      patterns.push_back({style.pen, style.rising, style.falling, [&map, h, mode](std::size_t i) {
                            return map.kind[i] == CellKind::ordinary && map.mode_at(h, i) == mode;
                          }});
    };
    for (std::size_t mode = 0; mode < looks.size(); ++mode) {
      if (served[mode] > 0) add(looks[mode].style, static_cast<std::uint8_t>(mode));
    }
    if (some_by_none) add(none, no_mode);
    page.draw_panel(
        h, [&](std::size_t i) { return style_at(h, i).ground; }, patterns);
  }
  return page.finish();
}

}  // namespace fairway
