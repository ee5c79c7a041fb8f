#include "fairway/contract_runtime.hpp"

#include <cmath>
#include <cstdint>
#include <deque>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/inclusion/contract_hand_over.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway::runtime {
namespace {

constexpr int arrays_in_file = 10;
constexpr int arrays_to_follow = 7;  // and these, when a path is followed
constexpr int arrays_of_modes = 8;   // and these, of a plan's further modes
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

/// What a file has of leaves; arrays that are missing or do not fit are empty.
ContractVerdictsView leaves_in(const FileArrays& arrays, const std::string& prefix,
                               std::uint64_t sections) {
  const auto name = [&prefix](const char* rest) { return prefix + rest; };
  const std::uint64_t leaves = count_of(arrays, name("leaf_verdict").c_str());
  const std::uint64_t groups = count_of(arrays, name("group_time_s").c_str());
  ContractVerdictsView v;
  v.first = numbers<std::uint32_t>(arrays, name("section_first").c_str(), "U32", sections + 1);
  v.begin = numbers<std::uint32_t>(arrays, name("leaf_begin").c_str(), "U32", leaves);
  v.group = numbers<std::uint32_t>(arrays, name("leaf_group").c_str(), "U32", leaves);
  v.verdict = numbers<std::uint8_t>(arrays, name("leaf_verdict").c_str(), "U8", leaves);
  v.group_time_s = numbers<float>(arrays, name("group_time_s").c_str(), "F32", groups);
  return v;
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

/// One mode with what is proved of it; not moved, as `lookup` refers to `parts`.
struct ProvedMode {
  ProvedMode(const float* commands, Parts&& of_commands, const VehicleContract& ground,
             const ContractVerdictsView& of)
      : heading_rad(commands),
        verdicts(of),
        parts(std::move(of_commands)),
        lookup(parts, verdicts, ground.speed_mps.least) {}

  const float* heading_rad;
  ContractVerdictsView verdicts;
  Parts parts;
  QuickLookup lookup;
};

/// Whether hand-overs of the leaves of a further mode are to earlier ones.
bool goes_down(const ContractVerdictsView& v, int mode) {
  for (std::size_t leaf = v.first.front(); leaf < v.first.back(); ++leaf) {
    const std::uint8_t next = v.group_next_mode[v.group[leaf]];
    if (v.verdict[leaf] > static_cast<std::uint8_t>(Verdict::reach)) return false;
    if (next != no_mode && next >= mode) return false;
  }
  return true;
}

}  // namespace

struct ContractCertificate::Opened {
  Flow flow;
  VehicleContract contract;
  VehicleContract ground;  ///< the same, of the motion over ground
  std::deque<ProvedMode> modes;

  Status take(const void* bytes, std::size_t size);
  Status take_further(const FileArrays& arrays, int per_cell, std::uint64_t sections);
  void add_first(const VehicleContract& kept, int per_cell, bool follows,
                 const ContractVerdictsView& verdicts);
  void add_further(const float* heading_rad, int per_cell, const ContractVerdictsView& verdicts);
  /// Null for a state that is not finite, or a million cells off.
  const ProvedMode* mode_near(int k, double x_m, double y_m, double heading_rad) const {
    const double far_m = 1e6 * flow.grid.cell_m;
    const bool near = std::abs(x_m - flow.grid.x0_m) < far_m &&
                      std::abs(y_m - flow.grid.y0_m) < far_m && std::isfinite(heading_rad);
    return near ? mode(k) : nullptr;
  }
  /// A place, metres, in parts.
  Vec2 in_parts(Vec2 place_m) const {
    const double part_m = modes.front().parts.part_m();
    return {(place_m.x - flow.grid.x0_m) / part_m, (place_m.y - flow.grid.y0_m) / part_m};
  }
  const ProvedMode* mode(int k) const {
    const bool is_one = k >= 0 && k < static_cast<int>(modes.size());
    return is_one ? &modes[static_cast<std::size_t>(k)] : nullptr;
  }
};

Status ContractCertificate::Opened::take(const void* bytes, std::size_t size) {
  FileArrays arrays;
  if (const Status status = arrays.open(bytes, size); status != Status::ok) return status;
  const int more = arrays.count() - arrays_in_file - (arrays.holds() ? 1 : 0);
  const bool has_modes = more == arrays_of_modes && arrays.has_modes();
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
  const auto per_cell = static_cast<std::uint64_t>(record.parts_per_cell);
  const std::uint64_t sections = 4 * flow.grid.size() * per_cell * per_cell;
  const ContractVerdictsView verdicts = leaves_in(arrays, "", sections);
  if (!is_in_order(verdicts, sections)) return Status::misfit;
  add_first(record.contract, record.parts_per_cell, record.follows, verdicts);
  return has_modes ? take_further(arrays, record.parts_per_cell, sections) : Status::ok;
}

void ContractCertificate::Opened::add_first(const VehicleContract& kept, int per_cell, bool follows,
                                            const ContractVerdictsView& verdicts) {
  contract = kept;
  ground = over_ground(contract);
  Parts parts(flow, ground, per_cell);
  if (follows) parts.close_goal();
  modes.emplace_back(flow.heading_rad, std::move(parts), ground, verdicts);
}

void ContractCertificate::Opened::add_further(const float* heading_rad, int per_cell,
                                              const ContractVerdictsView& verdicts) {
  Flow of_mode = flow;
  of_mode.heading_rad = heading_rad;
  of_mode.holding = nullptr;
  modes.emplace_back(heading_rad, Parts(of_mode, ground, per_cell), ground, verdicts);
}

Status ContractCertificate::Opened::take_further(const FileArrays& arrays, int per_cell,
                                                 std::uint64_t sections) {
  const HeaderEntry* commands = arrays.find("mode_heading_rad");
  if (commands->sizes != 3) return Status::not_certificate;
  const std::uint64_t further = commands->shape[0];
  if (further < 1 || further >= most_modes) return Status::misfit;
  const char* fields =
      arrays.place("mode_heading_rad", "F32", 4, further, static_cast<std::uint64_t>(flow.grid.ny),
                   static_cast<std::uint64_t>(flow.grid.nx));
  ContractVerdictsView all = leaves_in(arrays, "mode_", further * sections);
  all.group_next_mode =
      numbers<std::uint8_t>(arrays, "mode_group_next", "U8", all.group_time_s.size());
  if (fields == nullptr || arrays.find("mode_group_heading_rad") == nullptr ||
      all.group_next_mode.empty() || !is_in_order(all, further * sections)) {
    return Status::misfit;
  }
  for (std::uint64_t k = 0; k < further; ++k) {
    ContractVerdictsView own = all;
    own.first = all.first.subspan(k * sections, sections + 1);
    const int mode = static_cast<int>(k) + 1;
    if (!goes_down(own, mode)) return Status::misfit;
    add_further(reinterpret_cast<const float*>(fields) + k * flow.grid.size(), per_cell, own);
  }
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

void ContractCertificate::look_into(const fairway::ContractCertificate& c) {
  auto opened = std::make_unique<Opened>();
  opened->flow = c.flow();
  opened->add_first(c.contract, c.parts_per_cell, c.follow.has_value(), c.verdicts);
  for (int mode = 1; mode <= c.further_modes(); ++mode) {
    const std::size_t begin = static_cast<std::size_t>(mode - 1) * c.grid.size();
    opened->add_further(c.mode_heading_rad.data() + begin, c.parts_per_cell,
                        c.verdicts_of_mode(mode));
  }
  opened_ = std::move(opened);
}

Answer ContractCertificate::query(double x_m, double y_m, double heading_rad) const noexcept {
  Answer answer;
  const bool finite = std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(heading_rad);
  if (!opened_ || !finite) return answer;
  const Flow& flow = opened_->flow;
  try {
    for (int mode = 0; mode < modes(); ++mode) {
      const ContractAnswer found =
          opened_->mode(mode)->lookup.answer(flow.grid, {x_m, y_m}, heading_rad);
      if (found.verdict == Verdict::reach) {
        return {flow.told(found.verdict, flow.grid.cell_of({x_m, y_m})), found.worst_time_s, mode};
      }
      if (mode == 0) answer.verdict = flow.told(found.verdict, flow.grid.cell_of({x_m, y_m}));
    }
  } catch (const std::exception&) {  // no memory
  }
  return answer;
}

Answer ContractCertificate::query_around(int mode, double x_m, double y_m,
                                         double heading_rad) const noexcept {
  const ProvedMode* asked = opened_ ? opened_->mode_near(mode, x_m, y_m, heading_rad) : nullptr;
  if (asked == nullptr) return {};
  try {
    const double time_s = time_around(
        asked->parts, asked->verdicts, opened_->ground.speed_mps.least,
        opened_->in_parts({x_m, y_m}), heading_rad, EstimateError::of(opened_->contract));
    if (std::isfinite(time_s)) return {Verdict::reach, time_s, mode};
  } catch (const std::exception&) {  // no memory
  }
  return {};
}

Answer ContractCertificate::hand_over(int mode, double x_m, double y_m, double heading_rad,
                                      double in_time_s) const noexcept {
  const ProvedMode* own =
      opened_ && mode > 0 ? opened_->mode_near(mode, x_m, y_m, heading_rad) : nullptr;
  if (own == nullptr) return {};
  const ContractHandOver to =
      hand_over_near(own->parts, own->verdicts, opened_->in_parts({x_m, y_m}), heading_rad,
                     EstimateError::of(opened_->contract), in_time_s);
  if (to.mode == no_mode) return {};
  return {Verdict::reach, to.time_s, to.mode};
}

int ContractCertificate::modes() const noexcept {
  return opened_ ? static_cast<int>(opened_->modes.size()) : 0;
}

const VehicleContract* ContractCertificate::contract() const noexcept {
  return opened_ ? &opened_->contract : nullptr;
}

const Flow* ContractCertificate::flow() const noexcept {
  return opened_ ? &opened_->flow : nullptr;
}

const float* ContractCertificate::heading_rad(int mode) const noexcept {
  const ProvedMode* asked = opened_ ? opened_->mode(mode) : nullptr;
  return asked != nullptr ? asked->heading_rad : nullptr;
}

}  // namespace fairway::runtime
