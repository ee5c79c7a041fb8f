// What the files of both kinds of certificates have in common: the arrays and digests of their
// plan, the rows of leaves, and what a record says beside the proof. Templates, as neither
// certificate is a part of the other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/frame_json.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/certificate/plan_arrays.hpp"
#include "fairway/plan/plan_digests_json.hpp"
#include "fairway/verify/region_of_interest_json.hpp"

namespace fairway {

struct CertificateFormat {
  const char* name;    ///< in the record: "format"
  const char* method;  ///< "method"
  const char* noun;    ///< "certificate"
  std::size_t arrays;
};
inline constexpr int certificate_format_version = 1;

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& array) {
  return std::as_bytes(std::span(array));
}

/// A tensor of the certificate's plan: [iy][ix].
template <typename Certificate, typename T>
Tensor cell_tensor(const Certificate& c, const char* name, const char* dtype,
                   const std::vector<T>& array) {
  return {name,
          dtype,
          {static_cast<std::uint64_t>(c.grid.ny), static_cast<std::uint64_t>(c.grid.nx)},
          bytes_of(array)};
}

/// What every record has, beside that of the proof and the file.
template <typename Certificate>
nlohmann::json plan_record_of(const Certificate& c) {
  nlohmann::json record = nlohmann::json::parse(c.evidence_json, nullptr, false);
  require(record.is_object(), "evidence_json is a JSON object");
  record["plan_sha256"] = nlohmann::json::parse(json_text(c.plan));
  record["frame"] = c.frame ? json_of(*c.frame) : nlohmann::json();
  return record;
}

[[nodiscard]] std::string text_of_record(const nlohmann::json& record);

/// Writes `record`, completed, and the arrays, whole or not at all.
void write_certificate_file(const std::filesystem::path& path, Existing existing,
                            const CertificateFormat& format, nlohmann::json record,
                            const RegionOfInterest& region, const std::vector<Tensor>& tensors);

/// What the file says of its own array mode_heading_rad, held against the array when the record is
/// taken; "": it has none.
[[nodiscard]] std::string digest_of_modes(const nlohmann::json& record);

/// The record, if it is one of this format. Throws InputError{where, ...}.
[[nodiscard]] nlohmann::json record_of_file(const Safetensors& file,
                                            const CertificateFormat& format,
                                            const std::string& where);

/// Whether sections' leaves [first[s], first[s + 1]) begin at 0 and ascend.
[[nodiscard]] bool leaves_are_in_order(const std::vector<std::uint32_t>& first,
                                       const std::vector<std::uint32_t>& begin);

template <typename Certificate>
void take_plan_arrays(const Safetensors& file, const std::string& where, Certificate& c) {
  PlanArrays plan = plan_arrays_of(file, where);
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.heading_rad = std::move(plan.heading_rad);
  c.region = std::move(plan.region);
  c.kind = std::move(plan.kind);
}

/// Where the plan holds; a plan that holds nowhere leaves it out.
template <typename Certificate>
void take_holding(const Safetensors& file, const std::string& where, Certificate& c) {
  const auto is_it = [](const Tensor& tensor) { return tensor.name == "holding"; };
  if (std::none_of(file.tensors.begin(), file.tensors.end(), is_it)) return;
  const std::vector<std::uint64_t> cells{static_cast<std::uint64_t>(c.grid.ny),
                                         static_cast<std::uint64_t>(c.grid.nx)};
  c.holding = array_of<std::uint8_t>(file, "holding", "U8", cells, where);
  for (std::size_t i = 0; i < c.holding.size(); ++i) {
    const bool may = c.region[i] != Region::obstacle && c.region[i] != Region::goal;
    if (c.holding[i] > (may ? 1 : 0)) {
      throw InputError(where + ": \"holding\"", "expected 0, or 1 in a free or a buffer cell");
    }
  }
}

/// The region of interest, the plan and the frame, once digests and cells are right; what is left
/// of the record, without the keys of its own that `c` holds, is evidence.
template <typename Certificate>
void take_record(const Safetensors& file, const CertificateFormat& format, const std::string& where,
                 nlohmann::json record, std::initializer_list<const char*> own_keys, Certificate& c,
                 std::size_t more_arrays = 0) {
  const std::string place = where + ": fairway";
  c.region_of_interest = region_of_interest_of(member(record, "region_of_interest", place), c.kind,
                                               place + ".region_of_interest");
  const std::size_t holding = c.holding.empty() ? 0 : 1;
  if (file.tensors.size() != format.arrays + holding + more_arrays) {
    throw InputError(where, std::string("has arrays that do not belong in a ") + format.noun);
  }
  const nlohmann::json found = digests_of(file.tensors);
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
  for (const char* key : own_keys) record.erase(key);
  c.evidence_json = record.dump();
}

}  // namespace fairway
