// Files of contract certificates: safetensors (docs/formats.md).
//
// Properties that always hold: read_contract_certificate(write_contract_certificate(c)) == c, array
// for array; the bytes depend only on the certificate.
#pragma once

#include <filesystem>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/contract_certificate.hpp"

namespace fairway {

/// Writes it whole or not at all. Throws InputError when the file cannot be written.
void write_contract_certificate(const ContractCertificate& certificate,
                                const std::filesystem::path& path, Existing existing);

/// Throws InputError{path, which field, what is expected} for anything but a whole contract
/// certificate with the digests it claims. It does not prove anything: that is the checker's job.
[[nodiscard]] ContractCertificate read_contract_certificate(const std::filesystem::path& path);

}  // namespace fairway
