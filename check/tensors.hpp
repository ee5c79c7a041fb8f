// Reading a safetensors file: eight bytes with the length of a JSON header, the header, the arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace fairway_check {

/// The file cannot be read, or it is not what it should be: nothing to judge.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Tensor {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::span<const std::byte> bytes;
};

struct TensorFile {
  std::shared_ptr<const std::byte> mapped;  ///< keeps the file in memory
  std::map<std::string, Tensor> tensors;
  nlohmann::json record;  ///< the JSON in __metadata__.fairway

  /// Throws Malformed when it is not there or has another type.
  const Tensor& at(const std::string& name, const char* type) const;
};

/// Strict: names, types, shapes and sizes agree, the arrays fill the file without holes or
/// overlaps, no key stands twice. Throws Malformed("FILE: what is wrong").
TensorFile read_tensors(const std::string& path);

std::string sha256(std::span<const std::byte> bytes);

/// The member `key` of an object; throws Malformed when there is none.
const nlohmann::json& member(const nlohmann::json& object, const char* key);

}  // namespace fairway_check
