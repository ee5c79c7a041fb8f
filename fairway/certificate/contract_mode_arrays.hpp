// The arrays of a contract certificate that hold a plan's further modes (docs/formats.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fairway/base/safetensors.hpp"
#include "fairway/certificate/contract_certificate.hpp"

namespace fairway {

/// Adds those of eight bits, or of more; none where the certificate has no further modes.
void add_wide_mode_tensors(const ContractCertificate& c, std::vector<Tensor>& tensors);
void add_mode_bytes(const ContractCertificate& c, std::vector<Tensor>& tensors);

/// Takes them, if they are there, once the parts are known; returns how many these are. Throws
/// InputError{where, ...}.
std::size_t take_contract_modes(const Safetensors& file, const std::string& where,
                                ContractCertificate& c);

}  // namespace fairway
