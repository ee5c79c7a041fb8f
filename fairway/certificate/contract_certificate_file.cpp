#include "fairway/certificate/contract_certificate_file.hpp"

#include <cmath>
#include <cstdint>
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
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/verify/region_of_interest_json.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr const char* format_name = "fairway-contract-certificate";
constexpr int format_version = 1;
constexpr int most_parts_per_cell = 16;
constexpr std::size_t arrays = 10;

/// Wide types first, so that every array is aligned.
std::vector<Tensor> tensors_of(const ContractCertificate& c, const Geometry& geometry) {
  const std::vector<std::uint64_t> cells{static_cast<std::uint64_t>(c.grid.ny),
                                         static_cast<std::uint64_t>(c.grid.nx)};
  const ContractVerdicts& v = c.verdicts;
  const std::vector<std::uint64_t> leaves{v.leaves()};
  const std::vector<std::uint64_t> groups{v.group_time_s.size()};
  const auto bytes = [](const auto& array) { return std::as_bytes(std::span(array)); };
  return {{"geometry", "F64", {geometry_numbers}, std::as_bytes(std::span(&geometry, 1))},
          {"heading_rad", "F32", cells, bytes(c.heading_rad)},
          {"section_first", "U32", {v.first.size()}, bytes(v.first)},
          {"leaf_begin", "U32", leaves, bytes(v.begin)},
          {"leaf_group", "U32", leaves, bytes(v.group)},
          {"group_heading_rad", "F32", groups, bytes(v.group_heading_rad)},
          {"group_time_s", "F32", groups, bytes(v.group_time_s)},
          {"region", "I8", cells, bytes(c.region)},
          {"cell_kind", "U8", cells, bytes(c.kind)},
          {"leaf_verdict", "U8", leaves, bytes(v.verdict)}};
}

json record_of(const ContractCertificate& c) {
  json record = json::parse(c.evidence_json, nullptr, false);
  require(record.is_object(), "evidence_json is a JSON object");
  record["plan_sha256"] = json::parse(json_text(c.plan));
  record["frame"] = c.frame ? json_of(*c.frame) : json();
  record["contract"] = json_of(c.contract);
  record["parts_per_cell"] = c.parts_per_cell;
  return record;
}

void take_verdicts(const Safetensors& file, const std::string& where, ContractCertificate& c) {
  ContractVerdicts& v = c.verdicts;
  const std::size_t parts = c.grid.size() * static_cast<std::size_t>(c.parts_per_cell) *
                            static_cast<std::size_t>(c.parts_per_cell);
  v.first = array_of<std::uint32_t>(file, "section_first", "U32", {4 * parts + 1}, where);
  v.begin = array_of<std::uint32_t>(file, "leaf_begin", "U32", {0}, where);
  const std::vector<std::uint64_t> leaves{v.begin.size()};
  v.group = array_of<std::uint32_t>(file, "leaf_group", "U32", leaves, where);
  v.verdict = array_of<std::uint8_t>(file, "leaf_verdict", "U8", leaves, where);
  v.group_time_s = array_of<float>(file, "group_time_s", "F32", {0}, where);
  const std::vector<std::uint64_t> groups{v.group_time_s.size()};
  v.group_heading_rad = array_of<float>(file, "group_heading_rad", "F32", groups, where);
  bool fits = v.first.front() == 0 && v.first.back() == v.begin.size() && !v.group_time_s.empty();
  for (std::size_t i = 0; fits && i + 1 < v.first.size(); ++i) {
    fits =
        v.first[i] <= v.first[i + 1] && (v.first[i] == v.first[i + 1] || v.begin[v.first[i]] == 0);
    for (std::size_t k = v.first[i] + 1; fits && k < v.first[i + 1]; ++k) {
      fits = v.begin[k - 1] < v.begin[k];
    }
  }
  for (std::size_t k = 0; fits && k < v.leaves(); ++k) {
    fits = v.verdict[k] < verdict_count && v.group[k] < v.group_time_s.size();
  }
  for (std::size_t g = 0; fits && g < v.group_time_s.size(); ++g) {
    fits = v.group_time_s[g] >= 0.0F && !std::isinf(v.group_heading_rad[g]);
  }
  if (!fits) throw InputError(where, "has leaves that are out of order or out of range");
}

ContractCertificate certificate_of_bytes(std::span<const std::byte> bytes,
                                         const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  const auto text = file.metadata.find("fairway");
  if (text == file.metadata.end()) {
    throw InputError(where, "is not a certificate: __metadata__ has no string \"fairway\"");
  }
  const std::string place = where + ": fairway";
  json record = parse_strict_json(text->second, place);
  if (!record.is_object() || record.value("format", json()) != json(format_name)) {
    throw InputError(place + ".format",
                     fmt::format("is not \"{}\": not a contract certificate", format_name));
  }
  if (record.value("format_version", json()) != json(format_version)) {
    throw InputError(place + ".format_version", fmt::format("expected {}", format_version));
  }
  ContractCertificate c;
  PlanArrays plan = plan_arrays_of(file, where);
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.heading_rad = std::move(plan.heading_rad);
  c.region = std::move(plan.region);
  c.kind = std::move(plan.kind);
  c.contract = contract_of(member(record, "contract", place), place + ".contract");
  require_contract(c.contract, c.vehicle, place + ".contract");
  const json& per_cell = member(record, "parts_per_cell", place);
  if (!per_cell.is_number_integer() || per_cell < 1 || per_cell > most_parts_per_cell) {
    throw InputError(place + ".parts_per_cell",
                     fmt::format("expected 1 to {}", most_parts_per_cell));
  }
  c.parts_per_cell = per_cell.get<int>();
  take_verdicts(file, where, c);
  c.region_of_interest = region_of_interest_of(member(record, "region_of_interest", place), c.kind,
                                               place + ".region_of_interest");
  if (file.tensors.size() != arrays)
    throw InputError(where, "has arrays that do not belong in a contract certificate");
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
                          "plan_sha256", "frame", "contract", "parts_per_cell"}) {
    record.erase(key);
  }
  c.evidence_json = record.dump();
  return c;
}

}  // namespace

std::string record_text(const ContractCertificate& c) {
  return record_of(c).dump(-1, ' ', true, json::error_handler_t::replace);
}

void write_contract_certificate(const ContractCertificate& c, const std::filesystem::path& path,
                                Existing existing) {
  AtomicFile file(path, existing);
  const Geometry geometry = Geometry::of(c.grid, c.vehicle);
  const std::vector<Tensor> tensors = tensors_of(c, geometry);
  json record = record_of(c);
  record["format"] = format_name;
  record["format_version"] = format_version;
  record["method"] = "contract";
  record["region_of_interest"] = json_of(c.region_of_interest);
  record["sha256"] = digests_of(tensors);
  write_safetensors(
      file, {{{"fairway", record.dump(-1, ' ', true, json::error_handler_t::replace)}}, tensors});
  file.commit();
}

ContractCertificate read_contract_certificate(const std::filesystem::path& path) {
  const MappedFile mapped(path);
  try {
    return certificate_of_bytes(mapped.bytes(), path.string());
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::contract_certificate, path.string());
    throw;
  }
}

}  // namespace fairway
