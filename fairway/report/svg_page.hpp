// The SVG half of a Canvas: text in, text out, two decimals (a hundredth of a point).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fairway/report/canvas.hpp"

namespace fairway {

class SvgPage {
 public:
  SvgPage(double width_pt, double height_pt, const std::string& title);

  void open_layer(std::string_view name, const std::optional<Rect>& clip);
  void close_layer();
  void fill(const DrawingPath& path, const Color& color);
  void stroke(const DrawingPath& path, const Pen& pen);
  void text(const std::string& text, Vec2 at, const TextStyle& style);
  void image(int width, int height, const std::string& png, const Rect& place);

  [[nodiscard]] std::string finish() const;

 private:
  std::string body_;
  int open_layers_ = 0;
  int clips_ = 0;
};

}  // namespace fairway
