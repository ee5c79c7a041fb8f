// The safetensors layout: an 8-byte little-endian header length, a JSON header, raw arrays.
//
// Properties that always hold for what is written:
//   1. The header is padded with spaces so that the arrays start at a multiple of 8 bytes; wide
//      types come first, so every array is aligned for its type.
//   2. The arrays follow each other in the order given, without gaps, to the end of the file.
// and for what is read, in any order of arrays: the header follows the grammar in docs/formats.md
// ("Header"); names, types, shapes and sizes agree; the arrays fill the file without gaps or
// overlaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"

namespace fairway {

/// One array of a file; `dtype` is "F32", "I8", ... (the format's names).
struct Tensor {
  std::string name;
  std::string dtype;
  std::vector<std::uint64_t> shape;
  std::span<const std::byte> data;
};

struct Safetensors {
  std::map<std::string, std::string> metadata;  ///< `__metadata__`: strings only
  std::vector<Tensor> tensors;                  ///< in file order
};

/// Views into `bytes`, which must outlive the answer. Throws InputError{where, ...}.
[[nodiscard]] Safetensors parse_safetensors(std::span<const std::byte> bytes,
                                            const std::string& where);

/// The header for `content`, preceded by its length: everything before the arrays.
[[nodiscard]] std::string safetensors_header(const Safetensors& content);

/// Header and arrays; the caller commits.
void write_safetensors(AtomicFile& file, const Safetensors& content);

}  // namespace fairway
