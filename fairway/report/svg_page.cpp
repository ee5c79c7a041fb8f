#include "fairway/report/svg_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/markup_text.hpp"

namespace fairway {
namespace {

std::string number(double value) {
  std::string digits = fmt::format("{:.2f}", value);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

std::string pair_of(Vec2 p) { return number(p.x) + " " + number(p.y); }

/// An arc command cannot distinguish a full circle from nothing, and is exact only with its ends
/// well apart: long arcs are split into parts of at most 120 degrees.
std::string arc_data(const DrawingPath::Piece& arc) {
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep_rad) * 1.5 / pi)));
  const double sagitta = arc.radius * (1.0 - std::cos(std::min(pi, 0.5 * std::abs(arc.sweep_rad))));
  if (sagitta < 0.01) return "L" + pair_of(arc.end);  // a line, to the page's precision
  std::string data;
  for (int i = 1; i <= parts; ++i) {
    const double angle = arc.from_rad + arc.sweep_rad * i / parts;
    const Vec2 end = arc.center + arc.radius * Vec2{std::cos(angle), std::sin(angle)};
    data += fmt::format("A{0} {0} 0 0 {1} {2}", number(arc.radius), arc.sweep_rad > 0.0 ? 1 : 0,
                        pair_of(end));
  }
  return data;
}

std::string path_data(const DrawingPath& path) {
  std::string data;
  for (const auto& piece : path.pieces()) {
    switch (piece.kind) {
      case DrawingPath::Kind::move:
        data += "M" + pair_of(piece.end);
        break;
      case DrawingPath::Kind::line:
        data += "L" + pair_of(piece.end);
        break;
      case DrawingPath::Kind::arc:
        data += arc_data(piece);
        break;
      case DrawingPath::Kind::close:
        data += "Z";
        break;
    }
  }
  return data;
}

std::string paint(const char* property, const Color& color) {
  std::string text =
      fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", property, color.red, color.green, color.blue);
  if (color.opacity < 1.0)
    text += fmt::format(" {}-opacity=\"{}\"", property, number(color.opacity));
  return text;
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned triple = 0;
    for (std::size_t k = 0; k < 3; ++k)
      triple =
          (triple << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[(triple >> (18U - 6U * k)) & 63U] : '=';
  }
  return text;
}

}  // namespace

SvgPage::SvgPage(double width_pt, double height_pt, const std::string& title) {
  body_ = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "version=\"1.1\" width=\"{0}pt\" height=\"{1}pt\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\" stroke-linejoin=\"round\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      number(width_pt), number(height_pt), markup_text(title));
}

void SvgPage::open_layer(std::string_view name, const std::optional<Rect>& clip) {
  std::string clipping;
  if (clip) {
    const std::string id = fmt::format("clip-{}", ++clips_);
    body_ += fmt::format(
        "<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", id,
        number(clip->x), number(clip->y), number(clip->width), number(clip->height));
    clipping = fmt::format(" clip-path=\"url(#{})\"", id);
  }
  body_ += fmt::format("<g id=\"{}\"{}>\n", markup_text(name), clipping);
  ++open_layers_;
}

void SvgPage::close_layer() {
  body_ += "</g>\n";
  --open_layers_;
}

void SvgPage::fill(const DrawingPath& path, const Color& color) {
  body_ += fmt::format("<path d=\"{}\"{}/>\n", path_data(path), paint("fill", color));
}

void SvgPage::stroke(const DrawingPath& path, const Pen& pen) {
  std::string dash;
  for (const double length : pen.dash_pt) dash += (dash.empty() ? "" : " ") + number(length);
  if (!dash.empty()) dash = " stroke-dasharray=\"" + dash + "\"";
  body_ += fmt::format("<path d=\"{}\" fill=\"none\"{} stroke-width=\"{}\"{}/>\n", path_data(path),
                       paint("stroke", pen.color), number(pen.width_pt), dash);
}

void SvgPage::text(const std::string& text, Vec2 at, const TextStyle& style) {
  const char* anchor = style.anchor == Anchor::start    ? ""
                       : style.anchor == Anchor::middle ? " text-anchor=\"middle\""
                                                        : " text-anchor=\"end\"";
  const std::string turn =
      style.upwards ? fmt::format(" transform=\"rotate(-90 {})\"", pair_of(at)) : "";
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}{}{}>{}</text>\n", number(at.x),
                       number(at.y), number(style.size_pt), anchor,
                       style.bold ? " font-weight=\"bold\"" : "", paint("fill", style.color), turn,
                       markup_text(text));
}

void SvgPage::image(int width, int height, const std::string& png, const Rect& place) {
  // The image has the size of its pixels and is then stretched: viewers that ignore `none` for the
  // aspect ratio still show it correctly.
  body_ += fmt::format(
      "<image width=\"{0}\" height=\"{1}\" preserveAspectRatio=\"none\" "
      "transform=\"matrix({2:.6g} 0 0 {3:.6g} {4} {5})\" "
      "style=\"image-rendering:pixelated\" "
      "xlink:href=\"data:image/png;base64,{6}\"/>\n",
      width, height, place.width / width, place.height / height, number(place.x), number(place.y),
      base64(png));
}

std::string SvgPage::finish() const {
  require(open_layers_ == 0, "every layer of a page is closed before it is finished");
  return body_ + "</svg>\n";
}

}  // namespace fairway
