#include "fairway/certificate/certificate_file.hpp"

#include <algorithm>
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
  const SectionVerdicts& m = c.mode_sections;
  const bool has_modes = c.further_modes() > 0;
  std::vector<Tensor> tensors{
      {"geometry", "F64", {geometry_numbers}, std::as_bytes(std::span(&geometry, 1))},
      cell_tensor(c, "heading_rad", "F32", c.heading_rad),
      {"section_first", "U32", {c.sections.first.size()}, bytes_of(c.sections.first)},
      {"leaf_begin", "U32", leaves, bytes_of(c.sections.begin)},
      {"leaf_rank", "U32", leaves, bytes_of(c.sections.rank)},
      {"leaf_time_s", "F32", leaves, bytes_of(c.sections.time_s)}};
  const std::vector<std::uint64_t> mode_leaves{m.leaves()};
  if (has_modes) {
    const auto modes = static_cast<std::uint64_t>(c.further_modes());
    const std::vector<std::uint64_t> fields{modes, static_cast<std::uint64_t>(c.grid.ny),
                                            static_cast<std::uint64_t>(c.grid.nx)};
    tensors.insert(tensors.end(),
                   {{"mode_heading_rad", "F32", fields, bytes_of(c.mode_heading_rad)},
                    {"mode_section_first", "U32", {m.first.size()}, bytes_of(m.first)},
                    {"mode_leaf_begin", "U32", mode_leaves, bytes_of(m.begin)},
                    {"mode_leaf_rank", "U32", mode_leaves, bytes_of(m.rank)},
                    {"mode_leaf_time_s", "F32", mode_leaves, bytes_of(m.time_s)}});
  }
  tensors.push_back(cell_tensor(c, "region", "I8", c.region));
  tensors.push_back(cell_tensor(c, "cell_kind", "U8", c.kind));
  tensors.push_back({"leaf_verdict", "U8", leaves, bytes_of(c.sections.verdict)});
  if (has_modes) {
    tensors.push_back({"mode_leaf_verdict", "U8", mode_leaves, bytes_of(m.verdict)});
    tensors.push_back({"mode_leaf_next", "U8", mode_leaves, bytes_of(m.next_mode)});
  }
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

bool is_there(const Safetensors& file, const char* name) {
  return std::any_of(file.tensors.begin(), file.tensors.end(),
                     [&](const Tensor& tensor) { return tensor.name == name; });
}

/// The arrays of further modes, if the plan has any; returns how many arrays these are.
std::size_t take_modes(const Safetensors& file, const std::string& where, Certificate& c) {
  if (!is_there(file, "mode_heading_rad")) return 0;
  const std::uint64_t nx = static_cast<std::uint64_t>(c.grid.nx);
  const std::uint64_t ny = static_cast<std::uint64_t>(c.grid.ny);
  c.mode_heading_rad = array_of<float>(file, "mode_heading_rad", "F32", {0, ny, nx}, where);
  const auto modes = static_cast<std::size_t>(c.further_modes());
  SectionVerdicts& m = c.mode_sections;
  m.first = array_of<std::uint32_t>(file, "mode_section_first", "U32",
                                    {4 * modes * c.grid.size() + 1}, where);
  m.begin = array_of<std::uint32_t>(file, "mode_leaf_begin", "U32", {0}, where);
  const std::vector<std::uint64_t> leaves{m.begin.size()};
  m.rank = array_of<std::uint32_t>(file, "mode_leaf_rank", "U32", leaves, where);
  m.time_s = array_of<float>(file, "mode_leaf_time_s", "F32", leaves, where);
  m.verdict = array_of<std::uint8_t>(file, "mode_leaf_verdict", "U8", leaves, where);
  m.next_mode = array_of<std::uint8_t>(file, "mode_leaf_next", "U8", leaves, where);
  bool fits = modes < most_modes && leaves_are_in_order(m.first, m.begin);
  for (std::size_t mode = 1; fits && mode <= modes; ++mode) {
    const std::size_t last = m.first[4 * mode * c.grid.size()];
    for (std::size_t k = m.first[4 * (mode - 1) * c.grid.size()]; fits && k < last; ++k) {
      fits = m.verdict[k] <= static_cast<std::uint8_t>(Verdict::reach) && m.time_s[k] >= 0.0F &&
             (m.next_mode[k] == no_mode || m.next_mode[k] < mode);
    }
  }
  if (!fits) {
    throw InputError(where, "has leaves of further modes that are out of order or out of range");
  }
  return 7;
}

Certificate certificate_of_bytes(std::span<const std::byte> bytes, const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  nlohmann::json record = record_of_file(file, this_format, where);
  Certificate c;
  take_plan_arrays(file, where, c);
  take_holding(file, where, c);
  take_sections(file, where, c);
  const std::size_t mode_arrays = take_modes(file, where, c);
  const std::string modes_sha256 = digest_of_modes(record);
  take_record(file, this_format, where, std::move(record), {}, c, mode_arrays);
  if (c.plan.mode_heading_rad != modes_sha256) {
    throw InputError(where + ": fairway.plan_sha256", "mode_heading_rad is not that of that plan");
  }
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
