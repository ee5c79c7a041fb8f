// Whole input files in memory, lines with their numbers, and strict numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/map/obstacle_map.hpp"

namespace fairway {

/// Larger text files are refused: a map of that size is a mistake.
inline constexpr std::uint64_t max_text_bytes = std::uint64_t{512} << 20;

struct SourceText {
  std::filesystem::path file;
  std::string text;
  InputFile input;
};

/// The whole file as plain text (base/plain_text.hpp); the digest is that of its bytes. Throws
/// InputError when `file` is missing, not a regular file, unreadable or larger than `max_bytes`.
[[nodiscard]] SourceText read_source(const std::filesystem::path& file,
                                     std::uint64_t max_bytes = max_text_bytes);

/// The same, byte for byte.
[[nodiscard]] SourceText read_bytes(const std::filesystem::path& file, std::uint64_t max_bytes);

/// Throws InputError unless `file` is a regular file; names with network schemes are not.
void require_regular_file(const std::filesystem::path& file);

/// "FILE:LINE", the location of an error.
[[nodiscard]] std::string at_line(const std::filesystem::path& file, std::size_t line);

/// The text of an error, without its location.
[[nodiscard]] std::string reason_of(const InputError& error);

/// One line of a plain text without its line ending; numbers start at 1.
struct Line {
  std::size_t number = 0;
  std::string_view text;
};
[[nodiscard]] std::vector<Line> lines_of(std::string_view text);

[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Pieces between `separator`s, trimmed; with ' ', runs of blanks and tabs separate.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// The whole of `text` as a decimal number in the C locale; inf and nan count as numbers, so that
/// the caller can name them. Nothing when it is not a number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Lower-case copy, ASCII only.
[[nodiscard]] std::string lower(std::string_view text);

/// At most 40 printable characters of `text`, for messages.
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace fairway
