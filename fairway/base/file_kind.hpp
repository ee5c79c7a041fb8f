// What kind of file was given where another kind is expected.
//
// Detected from the content alone, after a reader has refused the file: the reader's own error,
// about bytes and headers, is then replaced by one that says what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace fairway {

enum class FileKind : std::uint8_t {
  unknown,
  scenario,
  plan,
  certificate,
  contract_certificate,
  bitmap,
  ros_map,
  moving_ai,
  qgc_plan,
  geojson,
  waypoints,
  image
};

[[nodiscard]] FileKind kind_of_bytes(std::span<const std::byte> bytes);

/// "is a scenario: `fairway plan` makes a plan from it"; empty when the kind is unknown or
/// the expected one. Where a map was expected, `wanted` is unknown.
[[nodiscard]] std::string other_kind_words(FileKind found, FileKind wanted);

/// Throws InputError{where, other_kind_words} when these bytes are of another known kind.
void refuse_other_kind(std::span<const std::byte> bytes, FileKind wanted, const std::string& where);

}  // namespace fairway
