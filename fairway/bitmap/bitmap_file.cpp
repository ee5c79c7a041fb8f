#include "fairway/bitmap/bitmap_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/frame_json.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/base/tensor_arrays.hpp"
#include "fairway/bitmap/bitmap_samples.hpp"
#include "fairway/plan/plan_digests_json.hpp"
#include "fairway/vehicle/size_range.hpp"
#include "fairway/vehicle/vehicle_json.hpp"
#include "fairway/verify/region_of_interest_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* format_name = "fairway-bitmap";
constexpr int format_version = 2;  // 1 had neither grid nor commands, so nothing could read it
constexpr const char* own_keys[] = {"format",
                                    "format_version",
                                    "method",
                                    "origin_m",
                                    "cell_m",
                                    "vehicle",
                                    "region_of_interest",
                                    "samples_per_border",
                                    "plan_sha256",
                                    "frame",
                                    "sha256"};

std::vector<std::uint64_t> cells_shape(const Grid& grid) {
  return {static_cast<std::uint64_t>(grid.ny), static_cast<std::uint64_t>(grid.nx)};
}

/// Wide types first, so that every array is aligned.
std::vector<Tensor> tensors_of(const Bitmap& b) {
  const std::vector<std::uint64_t> cells = cells_shape(b.grid());
  const std::span words(b.set.words.data(), b.set.words.size());
  return {{"border_words",
           "U64",
           {b.set.borders().count(), b.set.words_per_border()},
           std::as_bytes(words)},
          {"heading_rad", "F32", cells, std::as_bytes(std::span(b.heading_rad))},
          {"region", "I8", cells, std::as_bytes(std::span(b.region))},
          {"cell_kind", "U8", cells, std::as_bytes(std::span(b.kind))}};
}

json record_of(const Bitmap& b) {
  json record = json::parse(b.evidence_json, nullptr, false);
  require(record.is_object(), "evidence_json is one JSON object");
  record["plan_sha256"] = json::parse(json_text(b.plan));
  record["frame"] = b.frame ? json_of(*b.frame) : json();
  record["region_of_interest"] = json_of(b.region_of_interest);
  record["samples_per_border"] = b.set.samples;
  return record;
}

template <typename T>
std::vector<T> array_of(const Safetensors& file, const char* name, const char* dtype,
                        const Grid& grid, const std::string& where) {
  const Tensor& tensor =
      tensor_of(file, name, dtype, cells_shape(grid), sizeof(T), where, "a bitmap");
  std::vector<T> values(tensor.data.size() / sizeof(T));
  std::memcpy(values.data(), tensor.data.data(), tensor.data.size());
  return values;
}

void take_geometry(const Safetensors& file, const json& record, const std::string& where,
                   const std::string& place, Bitmap& b) {
  const Tensor& cells = tensor_of(file, "heading_rad", "F32", {0, 0}, 4, where, "a bitmap");
  Grid& grid = b.set.grid;
  grid.ny = static_cast<int>(cells.shape[0]);
  grid.nx = static_cast<int>(cells.shape[1]);
  const json& origin = member(record, "origin_m", place);
  if (!origin.is_array() || origin.size() != 2 || !origin[0].is_number() ||
      !origin[1].is_number()) {
    throw InputError(place + ".origin_m", "expected [x0, y0], found " + shown(origin));
  }
  grid.x0_m = origin[0].get<double>();
  grid.y0_m = origin[1].get<double>();
  grid.cell_m = finite_number(record, "cell_m", place);
  b.vehicle = vehicle_of(member(record, "vehicle", place), place + ".vehicle");
  if (grid.nx < 1 || grid.ny < 1) throw InputError(where, "has no cells");
  if (!size_range::holds(grid, b.vehicle)) {
    throw InputError(place,
                     "expected sizes in the range of docs/formats.md, and cells smaller than the "
                     "turning radius");
  }
}

void take_words(const Safetensors& file, const json& record, const std::string& where,
                const std::string& place, Bitmap& b) {
  const json& samples = member(record, "samples_per_border", place);
  if (!samples.is_number_unsigned() || samples < BitmapSamples::least ||
      samples > BitmapSamples::most || samples.get<int>() % 4 != 0) {
    throw InputError(place + ".samples_per_border",
                     fmt::format("is {}, expected a multiple of four, {} to {}", shown(samples),
                                 BitmapSamples::least, BitmapSamples::most));
  }
  b.set.samples = samples.get<int>();
  const Tensor& words = tensor_of(file, "border_words", "U64", {0, 0}, 8, where, "a bitmap");
  const std::size_t each = b.set.words_per_border();
  if (words.shape[0] != b.set.borders().count() || words.shape[1] != each) {
    throw InputError(where + ": \"border_words\".shape",
                     fmt::format("expected [{}, {}]: a row of bits for each inner border",
                                 b.set.borders().count(), each));
  }
  b.set.words = BitmapWords(words.data.size() / 8);
  if (!words.data.empty()) std::memcpy(b.set.words.data(), words.data.data(), words.data.size());
  const std::size_t used = b.set.states_per_border() % 64;
  for (std::size_t last = each - 1; used != 0 && last < b.set.words.size(); last += each) {
    if (b.set.words[last] >> used != 0) {
      throw InputError(where + ": \"border_words\"", "has bits after the last sample of a border");
    }
  }
}

void require_cells(const Bitmap& b, const std::string& where) {
  for (std::size_t i = 0; i < b.grid().size(); ++i) {
    const double heading_rad = b.heading_rad[i];
    if (!std::isnan(heading_rad) && !(heading_rad > -pi && heading_rad <= pi)) {
      throw InputError(where + ": \"heading_rad\"", "expected headings in (-pi, pi], or NaN");
    }
    const int region = static_cast<int>(b.region[i]);
    if (region < -1 || region > 2) {
      throw InputError(where + ": \"region\"", "expected -1, 0, 1 or 2");
    }
  }
  if (cell_kinds(b.grid(), b.region, b.region_of_interest) != b.kind) {
    throw InputError(where + ": \"cell_kind\"", "does not follow from region");
  }
}

json record_in(const Safetensors& file, const std::string& where, const std::string& place) {
  const auto text = file.metadata.find("fairway");
  if (text == file.metadata.end()) {
    throw InputError(where, "is not a bitmap: __metadata__ has no string \"fairway\"");
  }
  json record = parse_strict_json(text->second, place);
  if (!record.is_object() || record.value("format", json()) != json(format_name)) {
    throw InputError(place + ".format", fmt::format("is not \"{}\": not a bitmap", format_name));
  }
  if (record.value("format_version", json()) != json(format_version)) {
    throw InputError(place + ".format_version",
                     fmt::format("expected {}: draw the bitmap again", format_version));
  }
  return record;
}

}  // namespace

std::string record_text(const Bitmap& bitmap) {
  return record_of(bitmap).dump(-1, ' ', true, json::error_handler_t::replace);
}

void write_bitmap(const Bitmap& b, const std::filesystem::path& path, Existing existing) {
  AtomicFile file(path, existing);
  const std::vector<Tensor> tensors = tensors_of(b);
  json record = record_of(b);
  record["format"] = format_name;
  record["format_version"] = format_version;
  record["method"] = "bitmap";
  record["origin_m"] = {b.grid().x0_m, b.grid().y0_m};
  record["cell_m"] = b.grid().cell_m;
  record["vehicle"] = json_of(b.vehicle);
  record["sha256"] = digests_of(tensors);
  write_safetensors(
      file, {{{"fairway", record.dump(-1, ' ', true, json::error_handler_t::replace)}}, tensors});
  file.commit();
}

Bitmap bitmap_of_bytes(std::span<const std::byte> bytes, const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  const std::string place = where + ": fairway";
  json record = record_in(file, where, place);
  Bitmap b;
  take_geometry(file, record, where, place, b);
  b.heading_rad = array_of<float>(file, "heading_rad", "F32", b.grid(), where);
  b.region = array_of<Region>(file, "region", "I8", b.grid(), where);
  b.kind = array_of<CellKind>(file, "cell_kind", "U8", b.grid(), where);
  b.region_of_interest = region_of_interest_of(member(record, "region_of_interest", place), b.kind,
                                               place + ".region_of_interest");
  take_words(file, record, where, place, b);
  if (file.tensors.size() != 4)
    throw InputError(where, "has arrays that do not belong in a bitmap");
  const json found = digests_of(file.tensors);
  require_digests(record, found, place);
  require_cells(b, where);
  b.plan = plan_digests_of_json(member(record, "plan_sha256", place), place + ".plan_sha256");
  if (b.plan.heading_rad != found["heading_rad"] || b.plan.region != found["region"]) {
    throw InputError(place + ".plan_sha256", "heading_rad and region are not those of that plan");
  }
  if (const auto frame = record.find("frame"); frame != record.end() && !frame->is_null()) {
    b.frame = frame_of(*frame, place + ".frame");
  }
  for (const char* key : own_keys) record.erase(key);
  b.evidence_json = record.dump();
  return b;
}

Bitmap read_bitmap(const std::filesystem::path& path) {
  const MappedFile mapped(path);
  try {
    return bitmap_of_bytes(mapped.bytes(), path.string());
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::bitmap, path.string());
    throw;
  }
}

}  // namespace fairway
