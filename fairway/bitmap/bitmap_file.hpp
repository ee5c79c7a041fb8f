// Bitmap files: safetensors (docs/formats.md).
//
// Properties that always hold: read_bitmap(write_bitmap(b)) == b, array for array; the bytes depend
// only on the bitmap.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "fairway/base/atomic_file.hpp"
#include "fairway/bitmap/bitmap.hpp"

namespace fairway {

/// Writes it whole or not at all. Throws InputError when the place cannot be written.
void write_bitmap(const Bitmap& bitmap, const std::filesystem::path& path, Existing existing);

/// Throws InputError{path, which field, what is expected} for anything but a complete bitmap with
/// the digests it claims. Its samples are not checked: it is a picture.
[[nodiscard]] Bitmap read_bitmap(const std::filesystem::path& path);

/// The same for bytes already in memory; `where` names them in errors.
[[nodiscard]] Bitmap bitmap_of_bytes(std::span<const std::byte> bytes, const std::string& where);

}  // namespace fairway
