#include "fairway/report/legend.hpp"

#include <algorithm>
#include <utility>

#include "fairway/report/hatch.hpp"

namespace fairway {
namespace {

constexpr double sample_width_pt = 22.0;
constexpr double sample_height_pt = 9.0;
constexpr double gap_pt = 6.0;

}  // namespace

double legend_width_pt(const std::vector<LegendEntry>& entries) {
  double widest = 0.0;
  for (const auto& entry : entries) widest = std::max(widest, text_width_pt(entry.name));
  return sample_width_pt + gap_pt + widest;
}

void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<LegendEntry>& entries) {
  const auto layer = canvas.layer("legend");
  double y = corner.y;
  for (const auto& entry : entries) {
    if (entry.sample) entry.sample(canvas, {corner.x, y, sample_width_pt, sample_height_pt});
    canvas.text(entry.name, {corner.x + sample_width_pt + gap_pt, y + 7.6});
    y += legend_row_pt;
  }
}

LegendEntry line_entry(std::string name, const Pen& pen) {
  return {std::move(name), [pen](Canvas& canvas, const Rect& box) {
            const double y = box.y + 0.5 * box.height;
            canvas.stroke(DrawingPath::polyline({{box.x, y}, {box.right(), y}}), pen);
          }};
}

LegendEntry area_entry(std::string name, const Color& color) {
  return {std::move(name), [color](Canvas& canvas, const Rect& box) {
            canvas.fill(box.outline(), color);
            canvas.stroke(box.outline(), {palette::ink, 0.5, {}});
          }};
}

LegendEntry hatched_entry(std::string name, const Color& ground, const Pen& pen, bool rising,
                          bool falling) {
  return {std::move(name), [=](Canvas& canvas, const Rect& box) {
            canvas.fill(box.outline(), ground);
            const auto everywhere = [](Vec2) { return true; };
            if (rising) canvas.stroke(hatch(box, 3.0, true, everywhere), pen);
            if (falling) canvas.stroke(hatch(box, 3.0, false, everywhere), pen);
            canvas.stroke(box.outline(), {palette::ink, 0.5, {}});
          }};
}

}  // namespace fairway
