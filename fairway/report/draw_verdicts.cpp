#include "fairway/report/draw_verdicts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

/// "97.2 %", never rounded up to all or down to nothing.
std::string percent(std::size_t part, std::size_t of) {
  const double tenths = std::round(1000.0 * static_cast<double>(part) / static_cast<double>(of));
  if (part < of && tenths >= 1000.0) return "> 99.9 %";
  if (part > 0 && tenths < 1.0) return "< 0.1 %";
  return fmt::format("{:.1f} %", 0.1 * tenths);
}

std::string degrees(double heading_rad) {
  const double deg = std::round(10.0 * heading_rad * 180.0 / pi) / 10.0;
  return fmt::format("heading {:g}°", deg < 0.0 ? deg + 360.0 : deg);
}

std::size_t ordinary_samples(const VerdictMap& map) {
  return static_cast<std::size_t>(std::count(map.kind.begin(), map.kind.end(), CellKind::ordinary));
}

enum Share : std::size_t { reached, failing, open };
constexpr int shares = 3;

std::size_t states_of(const VerdictMap& map, std::size_t sample, Share share) {
  std::size_t states = 0;
  for (const Verdict verdict : verdicts_in_order) {
    const Share its = fails(verdict) ? failing : verdict == Verdict::reach ? reached : open;
    if (its == share) states += map.count[sample][static_cast<std::size_t>(verdict)];
  }
  return states;
}

/// None, up to an eighth, a half, seven eighths, less than all, all.
int class_of(std::size_t part, std::size_t of) {
  if (part == 0) return 0;
  if (part >= of) return 5;
  return 8 * part <= of ? 1 : 2 * part <= of ? 2 : 8 * part <= 7 * of ? 3 : 4;
}

/// The three panels' colours of one class side by side.
LegendEntry class_entry(std::string name, int rank) {
  return {std::move(name), [rank](Canvas& canvas, const Rect& box) {
            for (int s = 0; s < shares; ++s) {
              const double width = box.width / shares;
              const Rect part{box.x + s * width, box.y, width, box.height};
              canvas.fill(part.outline(), share_color(s, rank));
              canvas.stroke(part.outline(), {palette::ink, 0.4, {}});
            }
          }};
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
    captions.push_back({degrees(map.heading_rad[h]), map.heading_rad[h],
                        of > 0 ? percent(reaching, of) + " reach" : ""});
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
  const auto each = static_cast<std::size_t>(map.states_per_sample);
  require(each > 0, "shares are of at least one state a cell");
  static constexpr std::array<const char*, shares> names{"proved to reach", "proved to fail",
                                                         "undecided"};
  const std::size_t of = ordinary_samples(map) * each;
  std::vector<PanelCaption> captions;
  for (const Share share : {reached, failing, open}) {
    std::size_t states = 0;
    for (std::size_t i = 0; i < map.samples(); ++i) states += states_of(map, i, share);
    captions.push_back({names[share], {}, of > 0 ? percent(states, of) : ""});
  }
  std::vector<LegendEntry> entries{{fmt::format("of {} states a cell", each), {}}};
  const std::array<std::string, share_classes> classes{"none",      "up to 1/8",     "up to 1/2",
                                                       "up to 7/8", "not quite all", "all"};
  for (int rank = share_classes; rank-- > 0;) {
    entries.push_back(class_entry(classes[static_cast<std::size_t>(rank)], rank));
  }
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 200.0;
  MapPanels page(map, {options.title, 3, panel_pt, options.pixels_per_pt}, std::move(captions),
                 std::move(entries));
  for (const Share share : {reached, failing, open}) {
    page.draw_panel(share, [&](std::size_t i) {
      return share_color(static_cast<int>(share), class_of(states_of(map, i, share), each));
    });
  }
  return page.finish();
}

}  // namespace fairway
