#include "fairway/base/tensor_arrays.hpp"

#include <fmt/format.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {

using nlohmann::json;

json digests_of(const std::vector<Tensor>& tensors) {
  std::vector<std::string> digest(tensors.size());
  for_ranges(tensors.size(), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i) digest[i] = sha256_hex(tensors[i].data);
  });
  json all = json::object();
  for (std::size_t i = 0; i < tensors.size(); ++i) all[tensors[i].name] = digest[i];
  return all;
}

void require_digests(const json& record, const json& found, const std::string& where) {
  const json claimed = member(record, "sha256", where);
  for (const auto& [name, digest] : found.items()) {
    if (!claimed.is_object() || claimed.value(name, json()) != digest) {
      throw InputError(fmt::format("{}.sha256.{}", where, name),
                       "is not the digest of the array: the file was damaged or altered");
    }
  }
}

const Tensor& tensor_of(const Safetensors& file, const char* name, const char* dtype,
                        const std::vector<std::uint64_t>& shape, std::size_t element_bytes,
                        const std::string& where, const char* product) {
  for (const Tensor& tensor : file.tensors) {
    if (tensor.name != name) continue;
    const std::string place = fmt::format("{}: \"{}\"", where, name);
    if (tensor.dtype != dtype) {
      throw InputError(place + ".dtype", fmt::format("is {}, expected {}", tensor.dtype, dtype));
    }
    bool fits = tensor.shape.size() == shape.size();
    for (std::size_t i = 0; fits && i < shape.size(); ++i) {
      fits = shape[i] == 0 ? tensor.shape[i] <= 0x7fffffff : tensor.shape[i] == shape[i];
    }
    if (!fits) throw InputError(place + ".shape", "does not fit the other arrays");
    if (reinterpret_cast<std::uintptr_t>(tensor.data.data()) % element_bytes != 0) {
      throw InputError(place + ".data_offsets",
                       "begin at no multiple of the element's size in the file");
    }
    return tensor;
  }
  throw InputError(where, fmt::format("is not {}: lacks the array \"{}\"", product, name));
}

}  // namespace fairway
