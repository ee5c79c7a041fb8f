// The page that every picture of a plan shares: the cells, axes in metres, a scale bar, the
// mission, and a column for the legend on the right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct MapPageOptions {
  std::string title = {};
  bool cost = true;  ///< shading, contour lines and a colour bar
  std::optional<Mission> mission = {};
  double frame_pt = 420.0;
  double pixels_per_pt = 2.0;
};

class MapPage {
 public:
  /// Draws cells, contours and patterns. Throws PreconditionViolation when the plan's arrays have
  /// not grid.size() entries or an option is out of range. `plan` must outlive the page. `entries`
  /// stand in the legend above those of the regions and the mission; the page only leaves room for
  /// them here and draws them in finish().
  MapPage(const Plan& plan, const MapPageOptions& options, std::vector<LegendEntry> entries);

  Canvas& canvas() { return *canvas_; }
  const PlotFrame& frame() const { return frame_; }
  double pt_per_m() const { return frame_.rect.width / (frame_.x.high - frame_.x.low); }

  /// Draws the goal point or the path, above what was drawn before; nothing without a mission.
  void mark_mission();

  /// Axes, scale bar and legend on top of everything else.
  [[nodiscard]] Picture finish();

 private:
  void lay_out();
  void draw_cells();
  void draw_patterns();
  void draw_contours();
  void draw_side_column();
  double draw_color_bar(Vec2 corner);

  const Plan& plan_;
  MapPageOptions options_;
  std::vector<LegendEntry> entries_;
  double largest_cost_m_ = 0.0;
  PlotFrame frame_;
  double side_x_pt_ = 0.0;
  std::optional<Canvas> canvas_;
};

}  // namespace fairway
