// A page drawn once and written as both SVG and PNG.
//
// Every call draws on both: the SVG is written here (named layers, text that stays text, exact
// arcs), the PNG by Cairo. Cairo's own SVG surface is not used: it numbers its groups by a counter
// of the whole process, so its bytes depend on what was drawn before, and it has no named layers.
// Points (1/72 inch), x to the right, y down.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/report/color.hpp"
#include "fairway/report/drawing_path.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

struct Rect {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
  DrawingPath outline() const { return DrawingPath::rectangle({x, y}, width, height); }
};

struct Pen {
  Color color = palette::ink;
  double width_pt = 0.8;
  std::vector<double> dash_pt;  ///< lengths drawn and skipped in turn; empty: solid
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size_pt = 8.5;
  Anchor anchor = Anchor::start;
  bool bold = false;
  bool upwards = false;  ///< turned by a quarter, to be read from the right
  Color color = palette::ink;
};

/// Opaque colours, row 0 on top; pixels.size() == width * height.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;
};

class SvgPage;
class CairoPage;

class Canvas {
 public:
  /// A white page. `title` is for screen readers of the SVG. Throws PreconditionViolation when
  /// a size is not positive or the PNG would be wider or higher than 20000 pixels.
  Canvas(double width_pt, double height_pt, double pixels_per_pt, std::string_view title);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// A named group during its lifetime; its drawing is clipped to `clip` if given.
  class Layer {
   public:
    ~Layer();
    Layer(const Layer&) = delete;
    Layer& operator=(const Layer&) = delete;

   private:
    friend class Canvas;
    explicit Layer(Canvas& canvas) : canvas_(canvas) {}
    Canvas& canvas_;
  };
  [[nodiscard]] Layer layer(std::string_view name, const std::optional<Rect>& clip = {});

  void fill(const DrawingPath& path, const Color& color);
  void stroke(const DrawingPath& path, const Pen& pen);
  /// `at` is on the base line, at the start, middle or end of the text. Bytes that are not UTF-8
  /// are drawn as question marks.
  void text(std::string_view text, Vec2 at, const TextStyle& style = {});
  /// Pixels become sharp squares, never blurred.
  void image(const Raster& raster, const Rect& place);

  /// The finished page; every layer must be closed.
  [[nodiscard]] Picture finish() const;

 private:
  std::unique_ptr<SvgPage> svg_;
  std::unique_ptr<CairoPage> cairo_;
};

/// How wide a text is drawn, points.
[[nodiscard]] double text_width_pt(std::string_view text, const TextStyle& style = {});

}  // namespace fairway
