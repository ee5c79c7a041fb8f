// The PNG half of a Canvas, drawn by Cairo.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fairway/report/canvas.hpp"

typedef struct _cairo cairo_t;                  // NOLINT: Cairo's own names
typedef struct _cairo_surface cairo_surface_t;  // NOLINT

namespace fairway {

class CairoPage {
 public:
  CairoPage(double width_pt, double height_pt, double pixels_per_pt);

  void open_layer(const std::optional<Rect>& clip);
  void close_layer();
  void fill(const DrawingPath& path, const Color& color);
  void stroke(const DrawingPath& path, const Pen& pen);
  void text(const std::string& text, Vec2 at, const TextStyle& style);
  void image(const Raster& raster, const Rect& place);

  [[nodiscard]] double text_width_pt(const std::string& text, const TextStyle& style) const;
  [[nodiscard]] std::string finish() const;

 private:
  struct Free {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

/// The pixels alone as a PNG file.
[[nodiscard]] std::string png_of(const Raster& raster);

}  // namespace fairway
