// Describes a plan, a certificate of either kind or a bitmap: what it is, of what, and which shares
// it says are proved.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/run/product_file.hpp"

namespace fairway {

struct ProductInfo {
  std::string words;      ///< lines in two columns
  nlohmann::json report;  ///< "kind", "cells", "vehicle", ...; shares as in summary.json
};

/// Reads the whole file, as whoever uses it does. Throws InputError when it is damaged. Shares are
/// those that the file says; nothing is proved again.
[[nodiscard]] ProductInfo describe_product(const std::filesystem::path& file, ProductKind kind);

}  // namespace fairway
