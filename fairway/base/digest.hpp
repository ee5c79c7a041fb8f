// SHA-256, with which a product names exactly what went into it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace fairway {

/// SHA-256 of `bytes`, 64 lower-case hex digits.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

/// SHA-256 of a file's content, read in pieces. Throws InputError{path, reason} when the file
/// cannot be read to its end.
[[nodiscard]] std::string sha256_file(const std::filesystem::path& path);

}  // namespace fairway
