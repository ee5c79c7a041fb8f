#include "fairway/report/share_panels.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/report/map_panels.hpp"
#include "fairway/report/verdict_style.hpp"

namespace fairway {
namespace {

/// None, up to an eighth, a half, seven eighths, less than all, all.
int class_of(std::size_t part, std::size_t of) {
  if (part == 0) return 0;
  if (part >= of) return 5;
  return 8 * part <= of ? 1 : 2 * part <= of ? 2 : 8 * part <= 7 * of ? 3 : 4;
}

/// The three panels' colours of one class side by side.
LegendEntry class_entry(std::string name, int rank) {
  return {std::move(name), [rank](Canvas& canvas, const Rect& box) {
            constexpr int shares = SharePanels::count;
            for (int s = 0; s < shares; ++s) {
              const double width = box.width / shares;
              const Rect part{box.x + s * width, box.y, width, box.height};
              canvas.fill(part.outline(), share_color(s, rank));
              canvas.stroke(part.outline(), {palette::ink, 0.4, {}});
            }
          }};
}

}  // namespace

std::string heading_text(double heading_rad) {
  const double deg = std::round(10.0 * heading_rad * 180.0 / pi) / 10.0;
  return fmt::format("heading {:g}°", deg < 0.0 ? deg + 360.0 : deg);
}

Picture draw_share_panels(const VerdictMap& map, const SharePanels& shares,
                          const VerdictPictureOptions& options) {
  require(shares.each > 0, "shares are of at least one state a cell");
  std::size_t of = 0;
  for (const CellKind kind : map.kind) of += kind == CellKind::ordinary ? shares.each : 0;
  std::vector<PanelCaption> captions;
  for (std::size_t panel = 0; panel < SharePanels::count; ++panel) {
    std::size_t states = 0;
    for (std::size_t i = 0; i < map.samples(); ++i) states += shares.part(i, panel);
    captions.push_back({shares.names[panel], {}, of > 0 ? percent_text(states, of) : ""});
  }
  std::vector<LegendEntry> entries{{shares.of, {}}};
  const std::array<std::string, share_classes> classes{"none",      "up to 1/8",     "up to 1/2",
                                                       "up to 7/8", "not quite all", "all"};
  for (int rank = share_classes; rank-- > 0;) {
    entries.push_back(class_entry(classes[static_cast<std::size_t>(rank)], rank));
  }
  const double panel_pt = options.panel_pt > 0.0 ? options.panel_pt : 200.0;
  MapPanels page(map, {options.title, 3, panel_pt, options.pixels_per_pt}, std::move(captions),
                 std::move(entries));
  for (std::size_t panel = 0; panel < SharePanels::count; ++panel) {
    page.draw_panel(panel, [&](std::size_t i) {
      return share_color(static_cast<int>(panel), class_of(shares.part(i, panel), shares.each));
    });
  }
  return page.finish();
}

}  // namespace fairway
