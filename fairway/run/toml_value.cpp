#include "fairway/run/toml_value.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

std::string shown(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  std::string text = out.str();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  constexpr std::size_t longest = 60;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

/// Bounds are written in full, except pi, which has more digits than anybody types.
std::string bound_text(double bound) {
  std::string text = fmt::format("{}", bound);
  constexpr std::size_t longest = 16;
  return text.size() > longest ? fmt::format("{:g}", bound) : text;
}

}  // namespace

bool Range::contains(double x) const {
  return std::isfinite(x) && (low_open ? x > low : x >= low) && x <= high;
}

std::string Range::text() const {
  const Range all;
  const char* at_least = low_open ? "> " : ">= ";
  if (low == all.low && high == all.high) return "finite";
  if (high == all.high) return at_least + bound_text(low);
  return fmt::format("in {}{}, {}]", low_open ? "(" : "[", bound_text(low), bound_text(high));
}

std::string TomlSource::place_of(const toml::node& node) const {
  return has_lines ? fmt::format("{}:{}", name, node.source().begin.line) : name;
}

void TomlValue::refuse(const std::string& expected) const { refuse(node_, expected); }

void TomlValue::refuse(const toml::node& node, const std::string& expected) const {
  throw InputError(source_.place_of(node),
                   fmt::format("{}: expected {}, found {}", key_, expected, shown(node)));
}

double TomlValue::number_of(const toml::node& node, const Range& range) const {
  if (!node.is_number()) refuse(node, "a number");
  const double value =
      node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
  if (!range.contains(value)) refuse(node, "a number " + range.text());
  return value;
}

double TomlValue::number() const { return number_of(node_, range_); }

std::uint64_t TomlValue::whole_number() const {
  if (!node_.is_integer() || !range_.contains(static_cast<double>(**node_.as_integer()))) {
    refuse(fmt::format("a whole number {}", range_.text()));
  }
  return static_cast<std::uint64_t>(**node_.as_integer());
}

bool TomlValue::flag() const {
  if (!node_.is_boolean()) refuse("true or false");
  return **node_.as_boolean();
}

std::string TomlValue::text() const {
  if (!node_.is_string()) refuse("a text in quotes");
  return **node_.as_string();
}

Vec2 TomlValue::pair() const {
  const toml::array* array = node_.as_array();
  if (array == nullptr || array->size() != 2) refuse("an array of two numbers");
  return {number_of((*array)[0], range_), number_of((*array)[1], range_)};
}

std::vector<double> TomlValue::numbers(std::size_t count) const {
  const toml::array* array = node_.as_array();
  if (array == nullptr || array->size() != count) refuse(fmt::format("{} numbers", count));
  std::vector<double> numbers;
  for (const toml::node& number : *array) numbers.push_back(number_of(number, range_));
  return numbers;
}

bool TomlValue::is_text() const { return node_.is_string(); }

std::vector<std::vector<double>> TomlValue::rows(std::size_t width) const {
  const std::string expected = fmt::format("an array of arrays of {} numbers", width);
  const toml::array* array = node_.as_array();
  if (array == nullptr) refuse(expected);
  std::vector<std::vector<double>> rows;
  for (const toml::node& row : *array) {
    const toml::array* numbers = row.as_array();
    if (numbers == nullptr || numbers->size() != width) refuse(row, expected);
    rows.emplace_back();
    for (const toml::node& number : *numbers) rows.back().push_back(number_of(number, range_));
  }
  return rows;
}

}  // namespace fairway
