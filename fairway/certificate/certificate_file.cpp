#include "fairway/certificate/certificate_file.hpp"

#include <cmath>
#include <cstdint>
#include <span>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/certificate_file_parts.hpp"

namespace fairway {
namespace {

constexpr CertificateFormat this_format{"fairway-certificate", "certified", "certificate", 9};

/// Wide types first, so that every array is aligned.
std::vector<Tensor> tensors_of(const Certificate& c, const Geometry& geometry) {
  const std::vector<std::uint64_t> leaves{c.sections.leaves()};
  std::vector<Tensor> tensors{
      {"geometry", "F64", {geometry_numbers}, std::as_bytes(std::span(&geometry, 1))},
      cell_tensor(c, "heading_rad", "F32", c.heading_rad),
      {"section_first", "U32", {c.sections.first.size()}, bytes_of(c.sections.first)},
      {"leaf_begin", "U32", leaves, bytes_of(c.sections.begin)},
      {"leaf_rank", "U32", leaves, bytes_of(c.sections.rank)},
      {"leaf_time_s", "F32", leaves, bytes_of(c.sections.time_s)},
      cell_tensor(c, "region", "I8", c.region),
      cell_tensor(c, "cell_kind", "U8", c.kind),
      {"leaf_verdict", "U8", leaves, bytes_of(c.sections.verdict)}};
  if (!c.holding.empty()) tensors.push_back(cell_tensor(c, "holding", "U8", c.holding));
  return tensors;
}

void take_sections(const Safetensors& file, const std::string& where, Certificate& c) {
  SectionVerdicts& s = c.sections;
  s.first = array_of<std::uint32_t>(file, "section_first", "U32", {4 * c.grid.size() + 1}, where);
  s.begin = array_of<std::uint32_t>(file, "leaf_begin", "U32", {0}, where);
  const std::vector<std::uint64_t> leaves{s.begin.size()};
  s.rank = array_of<std::uint32_t>(file, "leaf_rank", "U32", leaves, where);
  s.time_s = array_of<float>(file, "leaf_time_s", "F32", leaves, where);
  s.verdict = array_of<std::uint8_t>(file, "leaf_verdict", "U8", leaves, where);
  bool fits = leaves_are_in_order(s.first, s.begin);
  for (std::size_t k = 0; fits && k < s.leaves(); ++k) {
    fits = s.verdict[k] < stored_verdict_count && s.time_s[k] >= 0.0F;
  }
  if (!fits) throw InputError(where, "has leaves that are out of order or out of range");
}

Certificate certificate_of_bytes(std::span<const std::byte> bytes, const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  nlohmann::json record = record_of_file(file, this_format, where);
  Certificate c;
  take_plan_arrays(file, where, c);
  take_holding(file, where, c);
  take_sections(file, where, c);
  take_record(file, this_format, where, std::move(record), {}, c);
  return c;
}

}  // namespace

std::string record_text(const Certificate& c) { return text_of_record(plan_record_of(c)); }

void write_certificate(const Certificate& c, const std::filesystem::path& path, Existing existing) {
  const Geometry geometry = Geometry::of(c.grid, c.vehicle);
  write_certificate_file(path, existing, this_format, plan_record_of(c), c.region_of_interest,
                         tensors_of(c, geometry));
}

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
