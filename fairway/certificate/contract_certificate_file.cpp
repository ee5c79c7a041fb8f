#include "fairway/certificate/contract_certificate_file.hpp"

#include <cmath>
#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/certificate_file_parts.hpp"
#include "fairway/certificate/contract_mode_arrays.hpp"
#include "fairway/certificate/follow_proof_arrays.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr CertificateFormat this_format{"fairway-contract-certificate", "contract",
                                        "contract certificate", 10};
constexpr int most_parts_per_cell = 16;

/// Wide types first, so that every array is aligned.
std::vector<Tensor> tensors_of(const ContractCertificate& c, const Geometry& geometry) {
  const ContractVerdicts& v = c.verdicts;
  const std::vector<std::uint64_t> leaves{v.leaves()};
  const std::vector<std::uint64_t> groups{v.group_time_s.size()};
  std::vector<Tensor> tensors{
      {"geometry", "F64", {geometry_numbers}, std::as_bytes(std::span(&geometry, 1))},
      cell_tensor(c, "heading_rad", "F32", c.heading_rad),
      {"section_first", "U32", {v.first.size()}, bytes_of(v.first)},
      {"leaf_begin", "U32", leaves, bytes_of(v.begin)},
      {"leaf_group", "U32", leaves, bytes_of(v.group)},
      {"group_heading_rad", "F32", groups, bytes_of(v.group_heading_rad)},
      {"group_time_s", "F32", groups, bytes_of(v.group_time_s)}};
  add_wide_mode_tensors(c, tensors);
  tensors.push_back(cell_tensor(c, "region", "I8", c.region));
  tensors.push_back(cell_tensor(c, "cell_kind", "U8", c.kind));
  tensors.push_back({"leaf_verdict", "U8", leaves, bytes_of(v.verdict)});
  add_mode_bytes(c, tensors);
  if (!c.holding.empty()) tensors.push_back(cell_tensor(c, "holding", "U8", c.holding));
  if (c.follow) add_tensors(*c.follow, tensors);
  return tensors;
}

json record_of(const ContractCertificate& c) {
  json record = plan_record_of(c);
  record["contract"] = json_of(c.contract);
  record["parts_per_cell"] = c.parts_per_cell;
  if (c.follow) record["follow"] = record_of(*c.follow);
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
  bool fits = leaves_are_in_order(v.first, v.begin) && !v.group_time_s.empty();
  for (std::size_t k = 0; fits && k < v.leaves(); ++k) {
    fits = v.verdict[k] < stored_verdict_count && v.group[k] < v.group_time_s.size();
  }
  for (std::size_t g = 0; fits && g < v.group_time_s.size(); ++g) {
    fits = v.group_time_s[g] >= 0.0F && !std::isinf(v.group_heading_rad[g]);
  }
  if (!fits) throw InputError(where, "has leaves that are out of order or out of range");
}

/// The contract and the parts, which the leaves depend on.
void take_contract(const json& record, const std::string& place, ContractCertificate& c) {
  c.contract = contract_of(member(record, "contract", place), place + ".contract");
  require_contract(c.contract, c.vehicle, place + ".contract");
  const json& per_cell = member(record, "parts_per_cell", place);
  if (!per_cell.is_number_integer() || per_cell < 1 || per_cell > most_parts_per_cell) {
    throw InputError(place + ".parts_per_cell",
                     fmt::format("expected 1 to {}", most_parts_per_cell));
  }
  c.parts_per_cell = per_cell.get<int>();
}

ContractCertificate certificate_of_bytes(std::span<const std::byte> bytes,
                                         const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  json record = record_of_file(file, this_format, where);
  ContractCertificate c;
  take_plan_arrays(file, where, c);
  take_holding(file, where, c);
  take_contract(record, where + ": fairway", c);
  take_verdicts(file, where, c);
  const std::size_t mode_arrays = take_contract_modes(file, where, c);
  const std::string modes_sha256 = digest_of_modes(record);
  if (record.contains("follow")) {
    c.follow = follow_proof_of(file, record["follow"], c.verdicts.leaves(), where);
  }
  take_record(file, this_format, where, std::move(record), {"contract", "parts_per_cell", "follow"},
              c, (c.follow ? follow_arrays : 0) + mode_arrays);
  // A plan's further modes may be left unproved.
  if (c.further_modes() > 0 && c.plan.mode_heading_rad != modes_sha256) {
    throw InputError(where + ": fairway.plan_sha256", "mode_heading_rad is not that of that plan");
  }
  return c;
}

}  // namespace

Parts ContractCertificate::parts() const {
  Parts made(flow(), over_ground(contract), parts_per_cell);
  if (follow) made.close_goal();
  return made;
}

Parts ContractCertificate::parts_of_mode(int mode) const {
  Flow of = flow();
  of.heading_rad = mode_heading_rad.data() + static_cast<std::size_t>(mode - 1) * grid.size();
  of.holding = nullptr;
  return Parts(of, over_ground(contract), parts_per_cell);
}

std::string record_text(const ContractCertificate& c) { return text_of_record(record_of(c)); }

void write_contract_certificate(const ContractCertificate& c, const std::filesystem::path& path,
                                Existing existing) {
  const Geometry geometry = Geometry::of(c.grid, c.vehicle);
  write_certificate_file(path, existing, this_format, record_of(c), c.region_of_interest,
                         tensors_of(c, geometry));
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
