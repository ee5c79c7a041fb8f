#include "fairway/report/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/report/cairo_page.hpp"
#include "fairway/report/svg_page.hpp"

namespace fairway {
namespace {

/// How many bytes the UTF-8 character at the start of `bytes` has; 0 if it is malformed.
std::size_t character_length(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf5   ? 0
                             : first >= 0xf0 ? 4
                             : first >= 0xe0 ? 3
                             : first >= 0xc2 ? 2
                                             : 0;
  if (length == 0 || bytes.size() < length) return 0;
  unsigned code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool no_character =
      code > 0x10ffff || (code >= 0xd800 && code < 0xe000) || (code & 0xfffeU) == 0xfffeU;
  return overlong || no_character ? 0 : length;
}

/// Titles may contain file names, that is, arbitrary bytes: Cairo and XML both reject malformed
/// UTF-8.
std::string printable(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    clean += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return clean;
}

/// Not every viewer honours the request for sharp pixels (librsvg blurs), so each pixel becomes a
/// block, large enough that the blur between neighbours is at most a third of a point wide. PNG
/// compresses the blocks well.
Raster with_blocks(const Raster& raster, const Rect& place) {
  constexpr double pixels_per_pt = 3.0;
  const int kx =
      std::max(1, static_cast<int>(std::ceil(pixels_per_pt * place.width / raster.width)));
  const int ky =
      std::max(1, static_cast<int>(std::ceil(pixels_per_pt * place.height / raster.height)));
  Raster large{raster.width * kx, raster.height * ky, {}};
  large.pixels.reserve(static_cast<std::size_t>(large.width) *
                       static_cast<std::size_t>(large.height));
  for (int row = 0; row < large.height; ++row)
    for (int column = 0; column < large.width; ++column)
      large.pixels.push_back(raster.pixels[static_cast<std::size_t>(row / ky) *
                                               static_cast<std::size_t>(raster.width) +
                                           static_cast<std::size_t>(column / kx)]);
  return large;
}

}  // namespace

Canvas::Canvas(double width_pt, double height_pt, double pixels_per_pt, std::string_view title) {
  require(width_pt > 0.0 && height_pt > 0.0 && pixels_per_pt > 0.0, "a page has a positive size");
  require(width_pt * pixels_per_pt <= 20000.0 && height_pt * pixels_per_pt <= 20000.0,
          "a page has at most 20000 pixels a side");
  svg_ = std::make_unique<SvgPage>(width_pt, height_pt, printable(title));
  cairo_ = std::make_unique<CairoPage>(width_pt, height_pt, pixels_per_pt);
}

Canvas::~Canvas() = default;

Canvas::Layer::~Layer() {
  canvas_.svg_->close_layer();
  canvas_.cairo_->close_layer();
}

Canvas::Layer Canvas::layer(std::string_view name, const std::optional<Rect>& clip) {
  svg_->open_layer(name, clip);
  cairo_->open_layer(clip);
  return Layer(*this);
}

void Canvas::fill(const DrawingPath& path, const Color& color) {
  if (path.empty()) return;
  svg_->fill(path, color);
  cairo_->fill(path, color);
}

void Canvas::stroke(const DrawingPath& path, const Pen& pen) {
  if (path.empty()) return;
  svg_->stroke(path, pen);
  cairo_->stroke(path, pen);
}

void Canvas::text(std::string_view text, Vec2 at, const TextStyle& style) {
  const std::string clean = printable(text);
  svg_->text(clean, at, style);
  cairo_->text(clean, at, style);
}

void Canvas::image(const Raster& raster, const Rect& place) {
  if (raster.pixels.empty()) return;
  require(raster.pixels.size() ==
              static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height),
          "a raster has width * height pixels");
  const Raster blocks = with_blocks(raster, place);
  svg_->image(blocks.width, blocks.height, png_of(blocks), place);
  cairo_->image(raster, place);
}

double text_width_pt(std::string_view text, const TextStyle& style) {
  return CairoPage(1.0, 1.0, 1.0).text_width_pt(printable(text), style);
}

Picture Canvas::finish() const { return {svg_->finish(), cairo_->finish()}; }

}  // namespace fairway
