#include "fairway/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace fairway {
namespace {

constexpr int centimetres = 2;
constexpr int most_decimals = 15;

/// `decimals` places after the point, without trailing zeros.
std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer;  // the longest double has 309 digits before the point
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string text(buffer.data(), end.ptr);
  if (text.find('.') != std::string::npos) {
    text.resize(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

bool is_within_as_printed(const Grid& g, Vec2 p, int decimals) {
  const auto printed = [&](double value) {
    return std::strtod(fixed_text(value, decimals).c_str(), nullptr);
  };
  return printed(p.x) >= printed(g.x0_m) && printed(p.x) <= printed(g.x0_m + g.width_m()) &&
         printed(p.y) >= printed(g.y0_m) && printed(p.y) <= printed(g.y0_m + g.height_m());
}

}  // namespace

std::string coordinate_text(double x_m) { return fixed_text(x_m, centimetres); }

std::string decimal_text(double value, int decimals) { return fixed_text(value, decimals); }

double rounded_down(double value, int digits) {
  const int unit = static_cast<int>(std::floor(std::log10(value))) - digits + 1;
  double rounded = 0.0;
  // Once more when log10 or the quotient came out a trifle too high.
  for (auto units = std::floor(value / std::pow(10.0, unit) + 1e-9); units > 0.0; units -= 1.0) {
    const std::string text =
        std::to_string(static_cast<long long>(units)) + "e" + std::to_string(unit);
    rounded = std::strtod(text.c_str(), nullptr);
    if (rounded <= value) return rounded;
  }
  return rounded;
}

double rounded_up(double value, int digits) {
  const int unit = static_cast<int>(std::floor(std::log10(value))) - digits + 1;
  double rounded = 0.0;
  // Once more when log10 or the quotient came out a trifle too low.
  for (auto units = std::ceil(value / std::pow(10.0, unit) - 1e-9); rounded < value; units += 1.0) {
    const std::string text =
        std::to_string(static_cast<long long>(units)) + "e" + std::to_string(unit);
    rounded = std::strtod(text.c_str(), nullptr);
  }
  return rounded;
}

std::string whole_percent_text(double share) {
  if (share > 0.0 && share < 0.01) return "under 1 %";
  return std::to_string(static_cast<int>(std::floor(100.0 * share + 1e-9))) + " %";
}

std::string length_text(double length_m) {
  const double size = std::abs(length_m);
  int decimals = centimetres;
  if (size > 0.0 && size < 1.0)
    decimals = std::max(centimetres, 2 - static_cast<int>(std::floor(std::log10(size))));
  return fixed_text(length_m, decimals);
}

std::string place_text(Vec2 p_m) {
  return "(" + coordinate_text(p_m.x) + ", " + coordinate_text(p_m.y) + ")";
}

std::string outside_text(Vec2 p_m, const Grid& g) {
  int decimals = centimetres;
  while (decimals < most_decimals && is_within_as_printed(g, p_m, decimals)) ++decimals;
  const auto text = [&](double value) { return fixed_text(value, decimals); };
  return "(" + text(p_m.x) + ", " + text(p_m.y) + ") is outside the map, expected x in [" +
         text(g.x0_m) + ", " + text(g.x0_m + g.width_m()) + "] and y in [" + text(g.y0_m) + ", " +
         text(g.y0_m + g.height_m()) + "]";
}

bool is_within(const Grid& g, Vec2 p_m) {
  return p_m.x >= g.x0_m && p_m.x <= g.x0_m + g.width_m() && p_m.y >= g.y0_m &&
         p_m.y <= g.y0_m + g.height_m();
}

}  // namespace fairway
