#include "fairway/view/question.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"

namespace fairway {
namespace {

/// Text of a request for an answer: cut, and without non-printable or non-ASCII characters.
std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string safe;
  for (const char c : text.substr(0, most)) safe += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > most ? safe + "..." : safe;
}

}  // namespace

void require_parameters(const Parameters& parameters, std::initializer_list<const char*> names) {
  for (const auto& [name, value] : parameters) {
    const bool known = std::any_of(names.begin(), names.end(),
                                   [&, wanted = name](const char* n) { return wanted == n; });
    if (!known) {
      std::string expected;
      for (const char* n : names) expected += fmt::format("{}{}", expected.empty() ? "" : ", ", n);
      throw BadQuestion(fmt::format("unknown parameter \"{}\", expected {}", shown(name),
                                    expected.empty() ? "none" : expected));
    }
  }
  for (const char* name : names) {
    const std::size_t count = parameters.count(name);
    if (count != 1) {
      throw BadQuestion(fmt::format("parameter \"{}\" {}, expected once", name,
                                    count == 0 ? "is missing" : "is repeated"));
    }
  }
}

double number_parameter(const Parameters& parameters, const char* name) {
  const auto found = parameters.find(name);
  if (found == parameters.end()) {
    throw BadQuestion(fmt::format("parameter \"{}\" is missing, expected once", name));
  }
  const std::string& text = found->second;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw BadQuestion(fmt::format("{}: \"{}\" is not a finite decimal number", name, shown(text)));
  }
  return value;
}

Vec2 place_parameters(const Parameters& parameters, const char* x, const char* y) {
  return {number_parameter(parameters, x), number_parameter(parameters, y)};
}

State state_parameters(const Parameters& parameters, const char* x, const char* y, const char* h) {
  const Vec2 p = place_parameters(parameters, x, y);
  const double heading_rad = number_parameter(parameters, h);
  if (std::abs(heading_rad) > 1e6) {
    throw BadQuestion(fmt::format("{} = {} is not a heading, expected radians", h, heading_rad));
  }
  return {p, Heading::from_rad(heading_rad)};
}

State state_parameters(const Parameters& parameters, const Grid& grid, const char* x, const char* y,
                       const char* h) {
  const State state = state_parameters(parameters, x, y, h);
  const Vec2 p = state.position_m;
  const bool inside = p.x >= grid.x0_m && p.x < grid.x0_m + grid.width_m() && p.y >= grid.y0_m &&
                      p.y < grid.y0_m + grid.height_m();
  if (!inside || !grid.contains(grid.cell_of(p))) {
    throw BadQuestion(fmt::format(
        "({}, {}) = ({}, {}) is outside the plan, expected {} <= {} < {} and {} <= {} < {}", x, y,
        p.x, p.y, coordinate_text(grid.x0_m), x, coordinate_text(grid.x0_m + grid.width_m()),
        coordinate_text(grid.y0_m), y, coordinate_text(grid.y0_m + grid.height_m())));
  }
  return state;
}

bool is_local_host(std::string_view host, int port) {
  for (const std::string_view name : {"127.0.0.1", "localhost"}) {
    if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name)) return true;
  }
  return false;
}

}  // namespace fairway
