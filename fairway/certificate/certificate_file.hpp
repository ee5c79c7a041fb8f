// Certificate files: safetensors (docs/formats.md).
//
// Properties that always hold: read_certificate(write_certificate(c)) == c, array for array; the
// bytes depend only on the certificate.
#pragma once

#include <filesystem>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/certificate.hpp"

namespace fairway {

/// Writes it whole or not at all. Throws InputError when the file cannot be written.
void write_certificate(const Certificate& certificate, const std::filesystem::path& path,
                       Existing existing);

/// Throws InputError{path, which field, what is expected} for anything but a whole certificate with
/// the digests it claims. It does not prove anything: that is the checker's job.
[[nodiscard]] Certificate read_certificate(const std::filesystem::path& path);

}  // namespace fairway
