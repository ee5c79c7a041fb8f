#include "fairway/report/page_payload.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <utility>

#include <zlib.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");

std::string deflated(std::span<const std::uint8_t> raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string stream(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(stream.data()), &size, raw.data(),
                               static_cast<uLong>(raw.size()), Z_DEFAULT_COMPRESSION);
  require(status == Z_OK, "zlib compresses any bytes");
  stream.resize(size);
  return stream;
}

template <typename Value>
std::vector<std::uint8_t> filtered(std::span<const Value> values, PageFilter filter) {
  std::vector<Value> kept(values.begin(), values.end());
  if constexpr (std::is_integral_v<Value>) {
    if (filter == PageFilter::delta) {
      for (std::size_t i = kept.size(); i-- > 1;) {
        kept[i] = static_cast<Value>(kept[i] - kept[i - 1]);
      }
    }
  }
  std::vector<std::uint8_t> bytes(sizeof(Value) * kept.size());
  const auto* raw = reinterpret_cast<const std::uint8_t*>(kept.data());
  const bool planes = filter != PageFilter::none;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t b = 0; b < sizeof(Value); ++b) {
      const std::size_t to = planes ? b * kept.size() + i : i * sizeof(Value) + b;
      bytes[to] = raw[i * sizeof(Value) + b];
    }
  }
  return bytes;
}

const char* name_of(PageFilter filter) {
  return filter == PageFilter::none ? "none" : filter == PageFilter::planes ? "planes" : "delta";
}

std::size_t product(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace

void PagePayload::add_entry(Entry entry, std::size_t elements) {
  require(product(entry.shape) == elements, "an array of the page has the shape it states");
  const bool taken = std::any_of(entries_.begin(), entries_.end(),
                                 [&](const Entry& other) { return other.name == entry.name; });
  require(!taken, "every array of the page has its own name");
  entries_.push_back(std::move(entry));
}

void PagePayload::add(std::string_view name, std::vector<std::size_t> shape,
                      std::span<const std::uint8_t> values) {
  add_entry({std::string(name), "U8", std::move(shape), PageFilter::none, {deflated(values)}},
            values.size());
}

void PagePayload::add(std::string_view name, std::vector<std::size_t> shape,
                      std::span<const std::uint16_t> values, PageFilter filter) {
  add_entry(
      {std::string(name), "U16", std::move(shape), filter, {deflated(filtered(values, filter))}},
      values.size());
}

void PagePayload::add(std::string_view name, std::vector<std::size_t> shape,
                      std::span<const std::uint32_t> values, PageFilter filter) {
  add_entry(
      {std::string(name), "U32", std::move(shape), filter, {deflated(filtered(values, filter))}},
      values.size());
}

void PagePayload::add(std::string_view name, std::vector<std::size_t> shape,
                      std::span<const float> values) {
  constexpr PageFilter filter = PageFilter::planes;
  add_entry(
      {std::string(name), "F32", std::move(shape), filter, {deflated(filtered(values, filter))}},
      values.size());
}

void PagePayload::add_layers(std::string_view name, std::vector<std::size_t> shape,
                             std::span<const std::uint8_t> values) {
  require(!shape.empty() && product(shape) == values.size(), "layers fill the shape they state");
  const std::size_t each = shape[0] == 0 ? 0 : values.size() / shape[0];
  std::vector<std::string> streams(shape[0]);
  for_ranges(streams.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) streams[i] = deflated(values.subspan(i * each, each));
  });
  add_entry({std::string(name), "U8", std::move(shape), PageFilter::none, std::move(streams)},
            values.size());
}

std::string PagePayload::bytes() const {
  nlohmann::json header = nlohmann::json::object();
  std::size_t at = 0;
  for (const Entry& entry : entries_) {
    nlohmann::json places = {at};
    for (const std::string& stream : entry.streams) places.push_back(at += stream.size());
    header[entry.name] = {{"dtype", entry.dtype},
                          {"shape", entry.shape},
                          {"filter", name_of(entry.filter)},
                          {"at", std::move(places)}};
  }
  const std::string text = header.dump();
  const auto length = static_cast<std::uint64_t>(text.size());
  std::string all(sizeof length, '\0');
  std::memcpy(all.data(), &length, sizeof length);
  all += text;
  for (const Entry& entry : entries_) {
    for (const std::string& stream : entry.streams) all += stream;
  }
  return all;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < n ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace fairway
