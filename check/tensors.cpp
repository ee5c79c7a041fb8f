#include "check/tensors.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <utility>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace fairway_check {

static_assert(std::endian::native == std::endian::little, "arrays are read as they lie");

void require_readable(bool good, std::string_view otherwise) {
  if (!good) throw Defect(65, otherwise);
}
void require(bool good, std::string_view otherwise) {
  if (!good) throw Defect(1, otherwise);
}

TensorFile read_tensors(const std::string& path) {
  using nlohmann::json;
  using Place = std::pair<std::uint64_t, std::uint64_t>;
  static const std::map<std::string, std::uint64_t> widths{
      {"F64", 8}, {"F32", 4}, {"U32", 4}, {"I8", 1}, {"U8", 1}};
  TensorFile file;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(in.tellg());
  require_readable(in && size >= 8 && size < std::streamoff{1} << 40,
                   "cannot be read, or is no safetensors file");
  file.bytes.resize(static_cast<std::size_t>(size));
  require_readable(!in.seekg(0).read(file.bytes.data(), size).fail(), "cannot be read");
  std::uint64_t length = 0;
  std::memcpy(&length, file.bytes.data(), 8);
  const auto all = std::span<const char>(file.bytes).subspan(8);
  require_readable(length <= all.size(), "is cut short, or no safetensors file");
  const auto text = all.first(length);
  const auto data = all.subspan(length);
  const json header = json::parse(text.begin(), text.end());
  file.record = json::parse(header.at("__metadata__").at("fairway").get<std::string>());
  std::vector<Place> places;
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") continue;
    Tensor& tensor = file.tensors[name];
    tensor.type = entry.at("dtype");
    tensor.shape = entry.at("shape").get<std::vector<std::uint64_t>>();
    const Place place = entry.at("data_offsets");
    std::uint64_t bytes = widths.contains(tensor.type) ? widths.at(tensor.type) : 0;
    bool fits = bytes > 0;
    for (const std::uint64_t extent : tensor.shape)
      fits = fits && !__builtin_mul_overflow(bytes, extent, &bytes);
    fits = fits && place.first <= data.size() && bytes <= data.size() - place.first;
    require_readable(fits && place.second == place.first + bytes,
                     name + ": its type, shape and place do not fit, or the file is cut short");
    tensor.bytes = data.subspan(place.first, bytes);
    places.push_back(place);
  }
  std::sort(places.begin(), places.end());
  std::uint64_t filled = 0;
  for (const auto& [begin, end] : places) {
    require_readable(begin == filled, "has arrays that overlap or leave holes");
    filled = end;
  }
  require_readable(filled == data.size(), "goes on after its last array");
  return file;
}

std::string sha256(std::span<const char> bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not to be had");
  }
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

}  // namespace fairway_check
