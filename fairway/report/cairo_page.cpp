#include "fairway/report/cairo_page.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>

#include <cairo.h>

#include "fairway/base/heading.hpp"

namespace fairway {
namespace {

void ensure(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("drawing a picture failed: ") +
                             cairo_status_to_string(status));
}

cairo_status_t append(void* sink, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(sink)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::string png_of(cairo_surface_t* surface) {
  std::string bytes;
  ensure(cairo_surface_write_to_png_stream(surface, append, &bytes));
  return bytes;
}

void colour_with(cairo_t* context, const Color& color) {
  cairo_set_source_rgba(context, color.red / 255.0, color.green / 255.0, color.blue / 255.0,
                        color.opacity);
}

void trace(cairo_t* context, const DrawingPath& path) {
  cairo_new_path(context);
  for (const auto& piece : path.pieces()) {
    switch (piece.kind) {
      case DrawingPath::Kind::move:
        cairo_move_to(context, piece.end.x, piece.end.y);
        break;
      case DrawingPath::Kind::line:
        cairo_line_to(context, piece.end.x, piece.end.y);
        break;
      case DrawingPath::Kind::close:
        cairo_close_path(context);
        break;
      case DrawingPath::Kind::arc: {
        const auto arc = piece.sweep_rad >= 0.0 ? cairo_arc : cairo_arc_negative;
        arc(context, piece.center.x, piece.center.y, piece.radius, piece.from_rad,
            piece.from_rad + piece.sweep_rad);
        break;
      }
    }
  }
}

void choose_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size_pt);
  // A desktop's hinting settings must not affect the picture.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

cairo_surface_t* surface_of(const Raster& raster) {
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, raster.width, raster.height);
  ensure(cairo_surface_status(surface));
  unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int row = 0; row < raster.height; ++row) {
    for (int column = 0; column < raster.width; ++column) {
      const Color& c =
          raster.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(raster.width) +
                        static_cast<std::size_t>(column)];
      const std::uint32_t word = (static_cast<std::uint32_t>(c.red) << 16U) |
                                 (static_cast<std::uint32_t>(c.green) << 8U) | c.blue;
      std::memcpy(data + static_cast<std::ptrdiff_t>(row) * stride + 4L * column, &word, 4);
    }
  }
  cairo_surface_mark_dirty(surface);
  return surface;
}

}  // namespace

std::string png_of(const Raster& raster) {
  cairo_surface_t* surface = surface_of(raster);
  std::string bytes = png_of(surface);
  cairo_surface_destroy(surface);
  return bytes;
}

void CairoPage::Free::operator()(cairo_t* context) const { cairo_destroy(context); }
void CairoPage::Free::operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }

CairoPage::CairoPage(double width_pt, double height_pt, double pixels_per_pt) {
  surface_.reset(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width_pt * pixels_per_pt)),
      static_cast<int>(std::ceil(height_pt * pixels_per_pt))));
  ensure(cairo_surface_status(surface_.get()));
  context_.reset(cairo_create(surface_.get()));
  cairo_t* context = context_.get();
  cairo_set_source_rgb(context, 1.0, 1.0, 1.0);
  cairo_paint(context);
  cairo_scale(context, pixels_per_pt, pixels_per_pt);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
}

void CairoPage::open_layer(const std::optional<Rect>& clip) {
  cairo_save(context_.get());
  if (!clip) return;
  cairo_rectangle(context_.get(), clip->x, clip->y, clip->width, clip->height);
  cairo_clip(context_.get());
}

void CairoPage::close_layer() { cairo_restore(context_.get()); }

void CairoPage::fill(const DrawingPath& path, const Color& color) {
  trace(context_.get(), path);
  colour_with(context_.get(), color);
  cairo_fill(context_.get());
}

void CairoPage::stroke(const DrawingPath& path, const Pen& pen) {
  trace(context_.get(), path);
  colour_with(context_.get(), pen.color);
  cairo_set_line_width(context_.get(), pen.width_pt);
  cairo_set_dash(context_.get(), pen.dash_pt.data(), static_cast<int>(pen.dash_pt.size()), 0.0);
  cairo_stroke(context_.get());
}

void CairoPage::text(const std::string& text, Vec2 at, const TextStyle& style) {
  cairo_t* context = context_.get();
  const double width = text_width_pt(text, style);
  const double back = style.anchor == Anchor::start    ? 0.0
                      : style.anchor == Anchor::middle ? 0.5 * width
                                                       : width;
  cairo_save(context);
  cairo_translate(context, at.x, at.y);
  if (style.upwards) cairo_rotate(context, -pi / 2.0);
  choose_font(context, style);
  colour_with(context, style.color);
  cairo_move_to(context, -back, 0.0);
  cairo_show_text(context, text.c_str());
  cairo_restore(context);
}

void CairoPage::image(const Raster& raster, const Rect& place) {
  cairo_t* context = context_.get();
  cairo_surface_t* surface = surface_of(raster);
  cairo_save(context);
  cairo_rectangle(context, place.x, place.y, place.width, place.height);
  cairo_clip(context);
  cairo_translate(context, place.x, place.y);
  cairo_scale(context, place.width / raster.width, place.height / raster.height);
  cairo_set_source_surface(context, surface, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
  cairo_surface_destroy(surface);
}

double CairoPage::text_width_pt(const std::string& text, const TextStyle& style) const {
  cairo_text_extents_t extents;
  cairo_save(context_.get());
  choose_font(context_.get(), style);
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  cairo_restore(context_.get());
  return extents.x_advance;
}

std::string CairoPage::finish() const {
  ensure(cairo_status(context_.get()));
  cairo_surface_flush(surface_.get());
  return png_of(surface_.get());
}

}  // namespace fairway
