// Small multiples: the samples of a verdict map several times side by side, each panel with its
// own colours and patterns, and one legend for all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct PanelCaption {
  std::string name;
  std::optional<double> heading_rad = {};  ///< an arrow before the name
  std::string note = {};                   ///< at the panel's right end, smaller
};

struct MapPanelsOptions {
  std::string title = {};
  int columns = 4;
  double panel_pt = 150.0;  ///< longer side of a panel, 30..1000
  double pixels_per_pt = 2.0;
};

/// Strokes over the samples of which `covers` is true.
struct SamplePattern {
  Pen pen;
  bool rising = false;
  bool falling = false;
  std::function<bool(std::size_t sample)> covers;
};

class MapPanels {
 public:
  /// Lays the page out: a panel for each caption, row by row. Throws PreconditionViolation when an
  /// option is out of range. `map` must outlive the page. `entries` stand in the legend above
  /// those of obstacles and goal.
  MapPanels(const VerdictMap& map, const MapPanelsOptions& options,
            std::vector<PanelCaption> captions, std::vector<LegendEntry> entries);

  /// The layer "panel-K", K from 1: colours of ordinary cells by `color(sample)`, obstacles and
  /// goal as in every picture, patterns on top.
  void draw_panel(std::size_t k, const std::function<Color(std::size_t sample)>& color,
                  const std::vector<SamplePattern>& patterns = {});

  /// The frame of panel `k`.
  PlotFrame frame(std::size_t k) const;

  /// Legend, scale bar and title on top of everything else.
  [[nodiscard]] Picture finish();

 private:
  Rect place_of(std::size_t k) const;
  void draw_caption(const PanelCaption& caption, const Rect& panel);
  Raster raster_of(const std::function<Color(std::size_t)>& color) const;

  const VerdictMap& map_;
  MapPanelsOptions options_;
  std::vector<PanelCaption> captions_;
  std::vector<LegendEntry> entries_;
  PlotFrame world_;       // only the axes
  Vec2 size_pt_;          // of a panel
  double step_x_pt_ = 0;  // from one panel to the next
  double top_pt_ = 0;
  std::optional<Canvas> canvas_;
};

}  // namespace fairway
