// Reads a safetensors file: eight bytes with the length of a JSON header, the header, the arrays.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace fairway_check {

/// What is wrong with a file. `code` is the program's exit code: `unreadable` when it is not a
/// certificate that can be judged; 1 when it is, and it is refused.
inline constexpr int unreadable = 65;
struct Defect : std::runtime_error {
  Defect(int code_, std::string_view what) : std::runtime_error(std::string(what)), code(code_) {}
  int code;
};
void require(bool good, std::string_view otherwise, int code = 1);

struct Tensor {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::span<const char> bytes;
};

struct TensorFile {
  std::shared_ptr<void> mapping;  ///< of the file that contains the arrays
  std::map<std::string, Tensor> tensors;
  nlohmann::json record;  ///< the JSON in __metadata__.fairway
};

/// By the grammar of docs/formats.md, "Header": types, shapes and sizes agree, and the arrays fill
/// the file without gaps or overlaps. Nothing after the header is loaded. Throws Defect 65, or
/// nlohmann::json::exception when the header cannot be parsed.
TensorFile read_tensors(const std::string& path);

/// The same for a header and the bytes after it.
TensorFile tensors_of(std::string_view header, std::span<const char> data);

std::string sha256(std::span<const char> bytes);

}  // namespace fairway_check
