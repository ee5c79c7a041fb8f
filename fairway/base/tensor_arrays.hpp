// The arrays of a product's file: taken by name, type and shape, and held against their digests.
// Private to the library: nlohmann/json is not part of its interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/safetensors.hpp"

namespace fairway {

/// SHA-256 of the bytes of each array, an object by name, lower-case hex.
[[nodiscard]] nlohmann::json digests_of(const std::vector<Tensor>& tensors);

/// Throws InputError{where.sha256.NAME, ...} unless `record` has under "sha256" what `found` has.
void require_digests(const nlohmann::json& record, const nlohmann::json& found,
                     const std::string& where);

/// The array `name`, of this type and shape (an extent of 0: any up to 2^31 - 1), beginning at a
/// multiple of `element_bytes`. Throws InputError naming the field; one that is missing: "is not
/// PRODUCT: lacks the array".
[[nodiscard]] const Tensor& tensor_of(const Safetensors& file, const char* name, const char* dtype,
                                      const std::vector<std::uint64_t>& shape,
                                      std::size_t element_bytes, const std::string& where,
                                      const char* product);

}  // namespace fairway
