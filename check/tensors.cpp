#include "check/tensors.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <openssl/sha.h>

namespace fairway_check {

static_assert(std::endian::native == std::endian::little, "arrays are read as they lie");

void require(bool good, std::string_view otherwise, int code) {
  if (!good) throw Defect(code, otherwise);
}

TensorFile read_tensors(const std::string& path) {
  using nlohmann::json;
  static const std::map<std::string, std::uint64_t> widths{
      {"F64", 8}, {"F32", 4}, {"U32", 4}, {"I8", 1}, {"U8", 1}};
  TensorFile file;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(in.tellg());
  file.bytes.resize(in && size < std::streamoff{1} << 40 ? static_cast<std::size_t>(size) : 0);
  require(file.bytes.size() >= 8 && in.seekg(0).read(file.bytes.data(), size),
          "cannot be read, or is no safetensors file", unreadable);
  std::uint64_t length = 0;
  std::memcpy(&length, file.bytes.data(), 8);
  const auto all = std::span<const char>(file.bytes).subspan(8);
  require(length <= all.size(), "is cut short, or no safetensors file", unreadable);
  const auto text = all.first(length);
  const auto data = all.subspan(length);
  const json header = json::parse(text.begin(), text.end());
  file.record = json::parse(header.at("__metadata__").at("fairway").get<std::string>());
  std::map<std::uint64_t, std::uint64_t> places;  // begin, end
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") continue;
    Tensor& tensor = file.tensors[name];
    tensor.type = entry.at("dtype");
    tensor.shape = entry.at("shape").get<std::vector<std::uint64_t>>();
    const auto [begin, end] = entry.at("data_offsets").get<std::array<std::uint64_t, 2>>();
    std::uint64_t bytes = widths.contains(tensor.type) ? widths.at(tensor.type) : 0;
    bool fits = bytes > 0 && begin <= end && end <= data.size();
    for (const std::uint64_t extent : tensor.shape)
      fits = fits && !__builtin_mul_overflow(bytes, extent, &bytes);
    require(fits && bytes == end - begin,
            name + ": its type, shape and place do not fit, or the file is cut short", unreadable);
    tensor.bytes = data.subspan(begin, bytes);
    if (bytes > 0)
      require(places.emplace(begin, end).second, "has arrays that overlap", unreadable);
  }
  std::uint64_t filled = 0;
  for (const auto& [begin, end] : places) {
    require(begin == filled, "has arrays that overlap or leave holes", unreadable);
    filled = end;
  }
  require(filled == data.size(), "goes on after its last array", unreadable);
  return file;
}

std::string sha256(std::span<const char> bytes) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace fairway_check
