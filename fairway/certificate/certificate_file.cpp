#include "fairway/certificate/certificate_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/frame_json.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/base/tensor_arrays.hpp"
#include "fairway/certificate/plan_arrays.hpp"
#include "fairway/plan/plan_digests_json.hpp"
#include "fairway/verify/region_of_interest_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* format_name = "fairway-certificate";
constexpr int format_version = 1;

/// Wide types first, so that every array is aligned.
std::vector<Tensor> tensors_of(const Certificate& c, const Geometry& geometry) {
  const std::vector<std::uint64_t> cells{static_cast<std::uint64_t>(c.grid.ny),
                                         static_cast<std::uint64_t>(c.grid.nx)};
  const std::vector<std::uint64_t> leaves{c.sections.leaves()};
  const auto bytes = [](const auto& array) { return std::as_bytes(std::span(array)); };
  return {{"geometry", "F64", {geometry_numbers}, std::as_bytes(std::span(&geometry, 1))},
          {"heading_rad", "F32", cells, bytes(c.heading_rad)},
          {"section_first", "U32", {c.sections.first.size()}, bytes(c.sections.first)},
          {"leaf_begin", "U32", leaves, bytes(c.sections.begin)},
          {"leaf_rank", "U32", leaves, bytes(c.sections.rank)},
          {"leaf_time_s", "F32", leaves, bytes(c.sections.time_s)},
          {"region", "I8", cells, bytes(c.region)},
          {"cell_kind", "U8", cells, bytes(c.kind)},
          {"leaf_verdict", "U8", leaves, bytes(c.sections.verdict)}};
}

json record_of(const Certificate& c) {
  json record = json::parse(c.evidence_json, nullptr, false);
  require(record.is_object(), "evidence_json is a JSON object");
  record["plan_sha256"] = json::parse(json_text(c.plan));
  record["frame"] = c.frame ? json_of(*c.frame) : json();
  return record;
}

void take_cells(const Safetensors& file, const std::string& where, Certificate& c) {
  PlanArrays arrays = plan_arrays_of(file, where);
  c.grid = arrays.grid;
  c.vehicle = arrays.vehicle;
  c.heading_rad = std::move(arrays.heading_rad);
  c.region = std::move(arrays.region);
  c.kind = std::move(arrays.kind);
}

void take_sections(const Safetensors& file, const std::string& where, Certificate& c) {
  SectionVerdicts& s = c.sections;
  s.first = array_of<std::uint32_t>(file, "section_first", "U32", {4 * c.grid.size() + 1}, where);
  s.begin = array_of<std::uint32_t>(file, "leaf_begin", "U32", {0}, where);
  const std::vector<std::uint64_t> leaves{s.begin.size()};
  s.rank = array_of<std::uint32_t>(file, "leaf_rank", "U32", leaves, where);
  s.time_s = array_of<float>(file, "leaf_time_s", "F32", leaves, where);
  s.verdict = array_of<std::uint8_t>(file, "leaf_verdict", "U8", leaves, where);
  bool fits = s.first.front() == 0 && s.first.back() == s.begin.size();
  for (std::size_t i = 0; fits && i + 1 < s.first.size(); ++i) {
    fits =
        s.first[i] <= s.first[i + 1] && (s.first[i] == s.first[i + 1] || s.begin[s.first[i]] == 0);
    for (std::size_t k = s.first[i] + 1; fits && k < s.first[i + 1]; ++k) {
      fits = s.begin[k - 1] < s.begin[k];
    }
  }
  for (std::size_t k = 0; fits && k < s.leaves(); ++k) {
    fits = s.verdict[k] < verdict_count && s.time_s[k] >= 0.0F;
  }
  if (!fits) throw InputError(where, "has leaves that are out of order or out of range");
}

}  // namespace

std::string record_text(const Certificate& c) {
  return record_of(c).dump(-1, ' ', true, json::error_handler_t::replace);
}

void write_certificate(const Certificate& c, const std::filesystem::path& path, Existing existing) {
  AtomicFile file(path, existing);
  const Geometry geometry = Geometry::of(c.grid, c.vehicle);
  const std::vector<Tensor> tensors = tensors_of(c, geometry);
  json record = record_of(c);
  record["format"] = format_name;
  record["format_version"] = format_version;
  record["method"] = "certified";
  record["region_of_interest"] = json_of(c.region_of_interest);
  record["sha256"] = digests_of(tensors);
  write_safetensors(
      file, {{{"fairway", record.dump(-1, ' ', true, json::error_handler_t::replace)}}, tensors});
  file.commit();
}

namespace {

Certificate certificate_of_bytes(std::span<const std::byte> bytes, const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  const auto text = file.metadata.find("fairway");
  if (text == file.metadata.end()) {
    throw InputError(where, "is not a certificate: __metadata__ has no string \"fairway\"");
  }
  const std::string place = where + ": fairway";
  json record = parse_strict_json(text->second, place);
  if (!record.is_object() || record.value("format", json()) != json(format_name)) {
    throw InputError(place + ".format",
                     fmt::format("is not \"{}\": not a certificate", format_name));
  }
  if (record.value("format_version", json()) != json(format_version)) {
    throw InputError(place + ".format_version", fmt::format("expected {}", format_version));
  }
  Certificate c;
  take_cells(file, where, c);
  take_sections(file, where, c);
  c.region_of_interest = region_of_interest_of(member(record, "region_of_interest", place), c.kind,
                                               place + ".region_of_interest");
  if (file.tensors.size() != 9)
    throw InputError(where, "has arrays that do not belong in a certificate");
  const json found = digests_of(file.tensors);
  require_digests(record, found, place);
  if (cell_kinds(c.grid, c.region, c.region_of_interest) != c.kind) {
    throw InputError(where + ": \"cell_kind\"", "does not follow from region");
  }
  c.plan = plan_digests_of_json(member(record, "plan_sha256", place), place + ".plan_sha256");
  if (c.plan.heading_rad != found["heading_rad"] || c.plan.region != found["region"]) {
    throw InputError(place + ".plan_sha256", "heading_rad and region are not those of that plan");
  }
  if (const auto frame = record.find("frame"); frame != record.end() && !frame->is_null()) {
    c.frame = frame_of(*frame, place + ".frame");
  }
  for (const char* key : {"format", "format_version", "method", "region_of_interest", "sha256",
                          "plan_sha256", "frame"}) {
    record.erase(key);
  }
  c.evidence_json = record.dump();
  return c;
}

}  // namespace

Certificate read_certificate(const std::filesystem::path& path) {
  const MappedFile mapped(path);
  try {
    return certificate_of_bytes(mapped.bytes(), path.string());
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::certificate, path.string());
    throw;
  }
}

}  // namespace fairway
