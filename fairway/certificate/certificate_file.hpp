// Certificate files: safetensors (docs/formats.md).
//
// Properties that always hold: read_certificate(write_certificate(c)) == c, array for array; the
// bytes depend on the certificate alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/certificate.hpp"

namespace fairway {

/// What each cell means for flights to `region_of_interest`.
[[nodiscard]] std::vector<CellKind> cell_kinds(const Grid& grid, const std::vector<Region>& region,
                                               const RegionOfInterest& region_of_interest);

/// Writes it whole or not at all. Throws InputError when the place cannot be written.
void write_certificate(const Certificate& certificate, const std::filesystem::path& path,
                       Existing existing);

/// Throws InputError{path, which field, what is expected} for anything but a whole certificate with
/// the digests it claims. It does not prove anything: that is the checker's.
[[nodiscard]] Certificate read_certificate(const std::filesystem::path& path);

/// The digests of a plan's arrays, as a certificate keeps them: one JSON object.
[[nodiscard]] std::string plan_digests_json(const Plan& plan);

}  // namespace fairway
