// Which kind of product a safetensors file is.
#pragma once

#include <cstdint>
#include <filesystem>

namespace fairway {

enum class ProductKind : std::uint8_t { plan, certificate, contract_certificate, bitmap };

/// By its metadata alone; whoever reads it then checks the rest. Throws InputError for a file of
/// another kind.
[[nodiscard]] ProductKind product_kind(const std::filesystem::path& file);

}  // namespace fairway
