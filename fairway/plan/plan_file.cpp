#include "fairway/plan/plan_file.hpp"

#include <array>
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/digest.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/plan/plan_defect.hpp"
#include "fairway/plan/plan_record_json.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/vehicle_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr int format_version = 1;
constexpr const char* modes_name = "mode_heading_rad";
constexpr std::array<const char*, 5> own_keys{"format_version", "origin_m", "cell_m", "vehicle",
                                              "sha256"};

/// F32 first, so that every array is aligned.
std::vector<Tensor> tensors_of(const Plan& plan) {
  const std::vector<std::uint64_t> shape{static_cast<std::uint64_t>(plan.grid.ny),
                                         static_cast<std::uint64_t>(plan.grid.nx)};
  std::vector<Tensor> tensors{
      {"heading_rad", "F32", shape, std::as_bytes(std::span(plan.heading_rad))},
      {"cost_m", "F32", shape, std::as_bytes(std::span(plan.cost_m))}};
  if (plan.further_modes() > 0) {
    tensors.push_back({modes_name,
                       "F32",
                       {plan.further_modes(), shape[0], shape[1]},
                       std::as_bytes(std::span(plan.mode_heading_rad))});
  }
  tensors.push_back({"region", "I8", shape, std::as_bytes(std::span(plan.region))});
  return tensors;
}

std::vector<std::string> digests_of(const std::vector<Tensor>& tensors) {
  std::vector<std::string> digest(tensors.size());
  for_ranges(tensors.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) digest[i] = sha256_hex(tensors[i].data);
  });
  return digest;
}

bool is_on(const Grid& grid, Vec2 p) {
  return p.x >= grid.x0_m && p.x <= grid.x0_m + grid.width_m() && p.y >= grid.y0_m &&
         p.y <= grid.y0_m + grid.height_m();
}

json metadata_of(const Plan& plan, const std::vector<Tensor>& tensors) {
  json record = json_of(plan.record);
  for (const char* key : own_keys)
    require(!record.contains(key), "the record leaves out what the plan holds");
  const auto digest = digests_of(tensors);
  record["format_version"] = format_version;
  record["origin_m"] = {plan.grid.x0_m, plan.grid.y0_m};
  record["cell_m"] = plan.grid.cell_m;
  record["vehicle"] = json_of(plan.vehicle);
  for (std::size_t i = 0; i < tensors.size(); ++i) record["sha256"][tensors[i].name] = digest[i];
  return record;
}

template <typename T>
void copy_tensor(const Safetensors& file, std::size_t index, std::vector<T>& into) {
  const std::span<const std::byte> data = file.tensors[index].data;
  into.resize(data.size() / sizeof(T));
  std::memcpy(into.data(), data.data(), data.size());
}

/// The index of the array of further modes, if there is one; its type and shape are as expected.
std::optional<std::size_t> modes_at(const Safetensors& file,
                                    const std::vector<std::uint64_t>& cells,
                                    const std::string& where) {
  for (std::size_t i = 0; i < file.tensors.size(); ++i) {
    const Tensor& tensor = file.tensors[i];
    if (tensor.name != modes_name) continue;
    if (tensor.dtype != "F32" || tensor.shape.size() != 3 || tensor.shape[0] < 1 ||
        tensor.shape[1] != cells[0] || tensor.shape[2] != cells[1]) {
      throw InputError(fmt::format("{}: \"{}\".shape", where, modes_name),
                       "expected F32 [modes, ny, nx], at least one mode");
    }
    return i;
  }
  return std::nullopt;
}

/// The index of the tensor `name`; its type and shape are as expected.
std::size_t tensor_at(const Safetensors& file, std::string_view name, std::string_view dtype,
                      const std::vector<std::uint64_t>& cells, const std::string& where) {
  for (std::size_t i = 0; i < file.tensors.size(); ++i) {
    const Tensor& tensor = file.tensors[i];
    if (tensor.name != name) continue;
    const std::string place = fmt::format("{}: \"{}\"", where, name);
    if (tensor.dtype != dtype) {
      throw InputError(place + ".dtype", fmt::format("is {}, expected {}", tensor.dtype, dtype));
    }
    if (tensor.shape.size() != 2 || tensor.shape != cells) {
      throw InputError(place + ".shape", "expected [ny, nx], the same for every array");
    }
    for (const std::uint64_t extent : tensor.shape) {
      if (extent < 1 || extent > INT_MAX) {
        throw InputError(place + ".shape", fmt::format("has the size {}", extent));
      }
    }
    return i;
  }
  throw InputError(where, fmt::format("lacks the array \"{}\"", name));
}

void require_digest(const json& digests, const Tensor& tensor, const std::string& found,
                    const std::string& where) {
  const std::string place = where + ".sha256";
  if (text_member(digests, tensor.name.c_str(), place) != found) {
    throw InputError(place + "." + tensor.name,
                     "does not match the array: the file was damaged or altered");
  }
}

void take_geometry(const json& record, const std::string& where, Plan& plan) {
  const json& version = member(record, "format_version", where);
  if (version != json(format_version)) {
    throw InputError(where + ".format_version",
                     fmt::format("is {}, expected {}", shown(version), format_version));
  }
  const json& origin = member(record, "origin_m", where);
  if (!origin.is_array() || origin.size() != 2 || !origin[0].is_number() ||
      !origin[1].is_number()) {
    throw InputError(where + ".origin_m", "expected [x0, y0], found " + shown(origin));
  }
  plan.grid.x0_m = origin[0].get<double>();
  plan.grid.y0_m = origin[1].get<double>();
  plan.grid.cell_m = finite_number(record, "cell_m", where);
  plan.vehicle = vehicle_of(member(record, "vehicle", where), where + ".vehicle");
}

}  // namespace

void write_plan(const Plan& plan, const std::filesystem::path& path, Existing existing) {
  if (const std::string defect = plan_defect(plan); !defect.empty()) {
    throw PreconditionViolation("cannot write a plan: " + defect);
  }
  AtomicFile file(path, existing);
  const std::vector<Tensor> tensors = tensors_of(plan);
  const std::string record =
      metadata_of(plan, tensors).dump(-1, ' ', true, json::error_handler_t::replace);
  write_safetensors(file, {{{"fairway", record}}, tensors});
  file.commit();
}

Plan plan_of_bytes(std::span<const std::byte> bytes, const std::string& where) {
  const Safetensors file = parse_safetensors(bytes, where);
  const auto text = file.metadata.find("fairway");
  if (text == file.metadata.end()) {
    throw InputError(where, "is not a plan: __metadata__ has no string \"fairway\"");
  }
  const std::string place = where + ": fairway";
  json record = parse_strict_json(text->second, place);
  std::vector<std::uint64_t> cells;
  for (const Tensor& tensor : file.tensors) {
    if (tensor.name == "heading_rad") cells = tensor.shape;
  }
  const std::size_t heading = tensor_at(file, "heading_rad", "F32", cells, where);
  const std::size_t cost = tensor_at(file, "cost_m", "F32", cells, where);
  const std::size_t region = tensor_at(file, "region", "I8", cells, where);
  const std::optional<std::size_t> modes = modes_at(file, cells, where);
  if (file.tensors.size() != (modes ? 4 : 3)) {
    throw InputError(where,
                     "has arrays other than heading_rad, cost_m, region and mode_heading_rad");
  }

  Plan plan;
  plan.grid.ny = static_cast<int>(cells[0]);
  plan.grid.nx = static_cast<int>(cells[1]);
  take_geometry(record, place, plan);
  const auto digest = digests_of(file.tensors);
  const json& digests = member(record, "sha256", place);
  require_known_keys(digests, {"heading_rad", "cost_m", "region", modes_name}, place + ".sha256");
  for (std::size_t i = 0; i < file.tensors.size(); ++i)
    require_digest(digests, file.tensors[i], digest[i], place);

  copy_tensor(file, heading, plan.heading_rad);
  copy_tensor(file, cost, plan.cost_m);
  copy_tensor(file, region, plan.region);
  if (modes) copy_tensor(file, *modes, plan.mode_heading_rad);
  for (const char* key : own_keys) record.erase(key);
  plan.record = plan_record_of(std::move(record), place);
  if (plan.record.contract && geometry_defect(plan.grid, plan.vehicle).empty()) {
    require_contract(*plan.record.contract, plan.vehicle, place + ".contract");
  }
  if (const std::string defect = plan_defect(plan); !defect.empty()) {
    throw InputError(where, defect);
  }
  if (const auto goal = goal_pose_of(plan); goal && !is_on(plan.grid, goal->position_m)) {
    throw InputError(place + ".mission.goal_m", "expected [x, y] on the plan's grid");
  }
  return plan;
}

Plan read_plan(const std::filesystem::path& path) {
  const MappedFile file(path);
  try {
    return plan_of_bytes(file.bytes(), path.string());
  } catch (const InputError&) {
    refuse_other_kind(file.bytes(), FileKind::plan, path.string());
    throw;
  }
}

}  // namespace fairway
