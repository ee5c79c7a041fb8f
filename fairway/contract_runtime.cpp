#include "fairway/contract_runtime.hpp"

#include <cmath>
#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <span>

#include <nlohmann/json.hpp>

#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway::runtime {
namespace {

constexpr int arrays_in_file = 10;
constexpr int arrays_to_follow = 7;  // and these, when a path is followed
constexpr int arrays_of_modes = 8;   // and these, of a plan's further modes, which are not read:
                                     // answers are those of the plan's own mode
constexpr int most_parts_per_cell = 16;

struct ContractRecord {
  VehicleContract contract;
  int parts_per_cell = 0;
  bool follows = false;
};

/// Throws InputError.
ContractRecord record_of(std::span<const std::byte> bytes, const Vehicle& vehicle) {
  const std::string where = "certificate";
  const auto metadata = parse_safetensors(bytes, where).metadata;
  const auto text = metadata.find("fairway");
  const nlohmann::json record =
      text != metadata.end() ? parse_strict_json(text->second, where) : nlohmann::json();
  ContractRecord found;
  if (!record.is_object() ||
      record.value("format", nlohmann::json()) != "fairway-contract-certificate") {
    return found;
  }
  found.contract = contract_of(member(record, "contract", where), where);
  require_contract(found.contract, vehicle, where);
  const nlohmann::json& parts = member(record, "parts_per_cell", where);
  if (parts.is_number_integer() && parts >= 1 && parts <= most_parts_per_cell) {
    found.parts_per_cell = parts.get<int>();
  }
  found.follows = record.contains("follow");
  return found;
}

template <typename Number>
std::span<const Number> numbers(const FileArrays& arrays, const char* name, const char* dtype,
                                std::uint64_t count) {
  const char* place = arrays.place(name, dtype, sizeof(Number), count);
  if (place == nullptr) return {};
  return {reinterpret_cast<const Number*>(place), static_cast<std::size_t>(count)};
}

std::uint64_t count_of(const FileArrays& arrays, const char* name) {
  const HeaderEntry* entry = arrays.find(name);
  return entry != nullptr && entry->sizes == 1 ? entry->shape[0] : 0;
}

/// Whether no query can read out of bounds, and every side of leaves is covered.
bool is_in_order(const ContractVerdictsView& v, std::uint64_t sections) {
  if (v.first.size() != sections + 1 || v.group_time_s.empty()) return false;
  const std::size_t leaves = v.begin.size();
  if (v.group.size() != leaves || v.verdict.size() != leaves) return false;
  if (v.first.front() != 0 || v.first.back() != leaves) return false;
  for (std::size_t s = 0; s < sections; ++s) {
    if (v.first[s] > v.first[s + 1] || v.first[s + 1] > leaves) return false;
    if (v.first[s] == v.first[s + 1]) continue;
    if (v.begin[v.first[s]] != 0) return false;
    for (std::size_t k = v.first[s] + 1; k < v.first[s + 1]; ++k) {
      if (v.begin[k - 1] >= v.begin[k]) return false;
    }
  }
  for (std::size_t k = 0; k < leaves; ++k) {
    if (v.verdict[k] >= stored_verdict_count || v.group[k] >= v.group_time_s.size()) return false;
  }
  for (const float time_s : v.group_time_s) {
    if (!(time_s >= 0.0F)) return false;
  }
  return true;
}

}  // namespace

struct ContractCertificate::Opened {
  Flow flow;
  VehicleContract contract;
  double least_speed_mps = 0.0;
  ContractVerdictsView verdicts;
  std::optional<Parts> parts;
  std::optional<QuickLookup> lookup;

  Status take(const void* bytes, std::size_t size);
};

Status ContractCertificate::Opened::take(const void* bytes, std::size_t size) {
  FileArrays arrays;
  if (const Status status = arrays.open(bytes, size); status != Status::ok) return status;
  const int more = arrays.count() - arrays_in_file - (arrays.holds() ? 1 : 0);
  const bool has_modes = more == arrays_of_modes && arrays.find("mode_heading_rad") != nullptr;
  if ((more != 0 && more != arrays_to_follow && !has_modes) ||
      arrays.find("group_heading_rad") == nullptr) {
    return Status::not_certificate;
  }
  if (const Status status = arrays.take_flow(flow); status != Status::ok) return status;
  const ContractRecord record =
      record_of({static_cast<const std::byte*>(bytes), size}, flow.vehicle);
  if (record.parts_per_cell == 0 || record.follows != (more == arrays_to_follow)) {
    return Status::not_certificate;
  }
  contract = record.contract;
  const VehicleContract ground = over_ground(contract);
  least_speed_mps = ground.speed_mps.least;
  const auto per_cell = static_cast<std::uint64_t>(record.parts_per_cell);
  const std::uint64_t sections = 4 * flow.grid.size() * per_cell * per_cell;
  const std::uint64_t leaves = count_of(arrays, "leaf_verdict");
  const std::uint64_t groups = count_of(arrays, "group_time_s");
  verdicts.first = numbers<std::uint32_t>(arrays, "section_first", "U32", sections + 1);
  verdicts.begin = numbers<std::uint32_t>(arrays, "leaf_begin", "U32", leaves);
  verdicts.group = numbers<std::uint32_t>(arrays, "leaf_group", "U32", leaves);
  verdicts.verdict = numbers<std::uint8_t>(arrays, "leaf_verdict", "U8", leaves);
  verdicts.group_time_s = numbers<float>(arrays, "group_time_s", "F32", groups);
  if (!is_in_order(verdicts, sections)) return Status::misfit;
  parts.emplace(flow, ground, record.parts_per_cell);
  if (record.follows) parts->close_goal();
  lookup.emplace(*parts, verdicts, least_speed_mps);
  return Status::ok;
}

ContractCertificate::ContractCertificate() noexcept = default;
ContractCertificate::~ContractCertificate() = default;
ContractCertificate::ContractCertificate(ContractCertificate&& other) noexcept = default;
ContractCertificate& ContractCertificate::operator=(ContractCertificate&& other) noexcept = default;

Status ContractCertificate::open(const void* bytes, std::size_t size) noexcept {
  opened_.reset();
  try {
    auto opened = std::make_unique<Opened>();
    const Status status = opened->take(bytes, size);
    if (status == Status::ok) opened_ = std::move(opened);
    return status;
  } catch (const std::bad_alloc&) {
    return Status::no_memory;
  } catch (const std::exception&) {  // what the record says is no contract
    return Status::misfit;
  }
}

Answer ContractCertificate::query(double x_m, double y_m, double heading_rad) const noexcept {
  Answer answer;
  const bool finite = std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(heading_rad);
  if (!opened_ || !finite) return answer;
  try {
    const ContractAnswer found =
        opened_->lookup->answer(opened_->flow.grid, {x_m, y_m}, heading_rad);
    answer.verdict = opened_->flow.told(found.verdict, opened_->flow.grid.cell_of({x_m, y_m}));
    if (found.verdict == Verdict::reach) answer.time_bound_s = found.worst_time_s;
  } catch (const std::exception&) {  // no memory
  }
  return answer;
}

const VehicleContract* ContractCertificate::contract() const noexcept {
  return opened_ ? &opened_->contract : nullptr;
}

const Flow* ContractCertificate::flow() const noexcept {
  return opened_ ? &opened_->flow : nullptr;
}

}  // namespace fairway::runtime
