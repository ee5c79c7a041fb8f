// One value of a TOML file or of an option, asked for by type and range; errors say FILE:LINE or
// the option, key, and both what was expected and what was found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fairway/base/vec2.hpp"

namespace toml {
inline namespace v3 {
class node;
}
}  // namespace toml

namespace fairway {

/// Numbers that are allowed; open ends exclude the bound itself.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool low_open = false;
  [[nodiscard]] bool contains(double x) const;
  /// "> 0", ">= 0", "in (0, 1]", "finite".
  [[nodiscard]] std::string text() const;
};

/// Where values stand: in the lines of a file, or in an option of the command.
struct TomlSource {
  std::string name;
  bool has_lines = true;
  [[nodiscard]] std::string place_of(const toml::node& node) const;
};

class TomlValue {
 public:
  TomlValue(const toml::node& node, TomlSource source, std::string key, Range range)
      : node_(node), source_(std::move(source)), key_(std::move(key)), range_(range) {}

  [[nodiscard]] double number() const;
  [[nodiscard]] std::uint64_t whole_number() const;
  [[nodiscard]] bool flag() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] Vec2 pair() const;
  /// As many numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  [[nodiscard]] bool is_text() const;
  /// Rows of `width` numbers each.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::size_t width) const;

  [[noreturn]] void refuse(const std::string& expected) const;

 private:
  [[nodiscard]] double number_of(const toml::node& node, const Range& range) const;
  [[noreturn]] void refuse(const toml::node& node, const std::string& expected) const;

  const toml::node& node_;
  TomlSource source_;
  std::string key_;
  Range range_;
};

}  // namespace fairway
