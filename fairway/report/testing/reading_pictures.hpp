// For tests: reads finished pictures again, with parsers that this project did not write.
#pragma once

#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <cairo.h>
#include <expat.h>

#include "fairway/report/color.hpp"

namespace fairway::testing {

struct SvgElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  std::string layer;  ///< id of the innermost named group around it
};

/// All elements in order; throws with expat's reason when the document is not well-formed.
inline std::vector<SvgElement> read_svg(const std::string& svg) {
  struct Reading {
    std::vector<SvgElement> elements;
    std::vector<std::size_t> open;
    std::vector<std::string> layers{""};
  } reading;
  XML_Parser parser = XML_ParserCreate(nullptr);
  XML_SetUserData(parser, &reading);
  XML_SetElementHandler(
      parser,
      [](void* data, const char* name, const char** attributes) {
        auto& r = *static_cast<Reading*>(data);
        SvgElement element{name, {}, "", r.layers.back()};
        for (; *attributes != nullptr; attributes += 2)
          element.attributes[attributes[0]] = attributes[1];
        if (element.name == "g") r.layers.push_back(element.attributes["id"]);
        r.open.push_back(r.elements.size());
        r.elements.push_back(element);
      },
      [](void* data, const char* name) {
        auto& r = *static_cast<Reading*>(data);
        if (std::strcmp(name, "g") == 0) r.layers.pop_back();
        r.open.pop_back();
      });
  XML_SetCharacterDataHandler(parser, [](void* data, const char* text, int length) {
    auto& r = *static_cast<Reading*>(data);
    if (!r.open.empty()) r.elements[r.open.back()].text.append(text, std::size_t(length));
  });
  const auto status = XML_Parse(parser, svg.data(), static_cast<int>(svg.size()), 1);
  const char* reason = XML_ErrorString(XML_GetErrorCode(parser));
  XML_ParserFree(parser);
  if (status != XML_STATUS_OK)
    throw std::runtime_error(std::string("SVG is not well-formed: ") + reason);
  return reading.elements;
}

inline std::vector<SvgElement> elements_of_layer(const std::string& svg, const std::string& layer) {
  std::vector<SvgElement> found;
  for (const auto& element : read_svg(svg))
    if (element.layer == layer) found.push_back(element);
  return found;
}

inline bool has_layer(const std::string& svg, const std::string& layer) {
  for (const auto& element : read_svg(svg))
    if (element.name == "g" && element.attributes.at("id") == layer) return true;
  return false;
}

inline bool has_text(const std::string& svg, const std::string& text) {
  for (const auto& element : read_svg(svg))
    if (element.name == "text" && element.text == text) return true;
  return false;
}

struct PngPicture {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;
  Color at(double x, double y) const {
    return pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x));
  }
};

inline PngPicture read_png(const std::string& png) {
  struct Stream {
    const std::string& bytes;
    std::size_t place;
  } stream{png, 0};
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(
      [](void* from, unsigned char* to, unsigned length) {
        auto& s = *static_cast<Stream*>(from);
        if (s.place + length > s.bytes.size()) return CAIRO_STATUS_READ_ERROR;
        std::memcpy(to, s.bytes.data() + s.place, length);
        s.place += length;
        return CAIRO_STATUS_SUCCESS;
      },
      &stream);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("not a PNG file");
  PngPicture picture{
      cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word, data + std::ptrdiff_t{y} * stride + 4L * x, 4);
      picture.pixels.push_back({static_cast<std::uint8_t>(word >> 16U),
                                static_cast<std::uint8_t>(word >> 8U),
                                static_cast<std::uint8_t>(word)});
    }
  cairo_surface_destroy(surface);
  return picture;
}

}  // namespace fairway::testing
