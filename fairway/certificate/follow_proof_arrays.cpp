#include "fairway/certificate/follow_proof_arrays.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file_parts.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// An array [rows, 2] of pairs.
template <typename Pair, typename Number>
std::vector<Pair> pairs_of(const Safetensors& file, const char* name, const char* dtype,
                           const std::string& where) {
  static_assert(sizeof(Pair) == 2 * sizeof(Number));
  const auto numbers = array_of<Number>(file, name, dtype, {0, 2}, where);
  std::vector<Pair> pairs;
  pairs.reserve(numbers.size() / 2);
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    pairs.push_back({numbers[i], numbers[i + 1]});
  }
  return pairs;
}

HoldDisc disc_of(const json& value, const std::string& where) {
  const json& goal = member(value, "goal_m", where);
  const json& radius = member(value, "radius_m", where);
  if (!goal.is_array() || goal.size() != 2 || !goal[0].is_number() || !goal[1].is_number() ||
      !radius.is_number() || !(radius.get<double>() > 0.0)) {
    throw InputError(where, "expected {\"goal_m\": [x, y], \"radius_m\": more than 0}");
  }
  return {{goal[0].get<double>(), goal[1].get<double>()}, radius.get<double>()};
}

bool fits(const FollowProof& f) {
  bool fit = f.path.vertices_m.size() >= 2 && !f.tube.empty() && f.stages.size() >= 1;
  for (const Vec2 v : f.path.vertices_m) fit = fit && std::isfinite(v.x) && std::isfinite(v.y);
  for (const TubeStretch& s : f.tube) fit = fit && s.distance_m >= 0.0F && s.off_rad >= 0.0F;
  for (const std::uint16_t stage : f.leaf_stage) fit = fit && stage <= f.stages.size();
  return fit && f.stages.lap_least_s >= 0.0 && f.stages.lap_most_s >= f.stages.lap_least_s;
}

}  // namespace

void add_tensors(const FollowProof& f, std::vector<Tensor>& tensors) {
  const std::vector<std::uint64_t> stages{f.stages.size()};
  // Wide types first, so that every array is aligned.
  tensors.insert(tensors.begin(),
                 {"path_m", "F64", {f.path.vertices_m.size(), 2}, bytes_of(f.path.vertices_m)});
  tensors.push_back({"tube", "F32", {f.tube.size(), 2}, bytes_of(f.tube)});
  tensors.push_back({"stage_heading_rad", "F32", stages, bytes_of(f.stages.heading_rad)});
  tensors.push_back({"stage_off_rad", "F32", stages, bytes_of(f.stages.off_rad)});
  tensors.push_back({"stage_time_s", "F32", stages, bytes_of(f.stages.time_s)});
  tensors.push_back({"stage_station_m", "F32", stages, bytes_of(f.stages.station_m)});
  tensors.push_back({"leaf_stage", "U16", {f.leaf_stage.size()}, bytes_of(f.leaf_stage)});
  std::stable_sort(tensors.begin(), tensors.end(), [](const Tensor& a, const Tensor& b) {
    const auto width = [](const Tensor& t) { return std::stoi(t.dtype.substr(1)); };
    return width(a) > width(b);
  });
}

json record_of(const FollowProof& f) {
  json record = {{"closed", f.path.closed},
                 {"lap_time_s", {f.stages.lap_least_s, f.stages.lap_most_s}}};
  if (f.hold) {
    record["hold"] = {{"goal_m", {f.hold->goal_m.x, f.hold->goal_m.y}},
                      {"radius_m", f.hold->radius_m}};
  }
  return record;
}

FollowProof follow_proof_of(const Safetensors& file, const json& record, std::size_t leaves,
                            const std::string& where) {
  const std::string place = where + ": fairway.follow";
  FollowProof f;
  const json& closed = member(record, "closed", place);
  const json& lap_s = member(record, "lap_time_s", place);
  if (!closed.is_boolean() || !lap_s.is_array() || lap_s.size() != 2 || !lap_s[0].is_number() ||
      !lap_s[1].is_number()) {
    throw InputError(place, "expected {\"closed\": true or false, \"lap_time_s\": [least, most]}");
  }
  f.path.closed = closed.get<bool>();
  f.stages.lap_least_s = lap_s[0].get<double>();
  f.stages.lap_most_s = lap_s[1].get<double>();
  if (record.contains("hold")) f.hold = disc_of(record["hold"], place + ".hold");
  f.path.vertices_m = pairs_of<Vec2, double>(file, "path_m", "F64", where);
  f.tube = pairs_of<TubeStretch, float>(file, "tube", "F32", where);
  f.leaf_stage = array_of<std::uint16_t>(file, "leaf_stage", "U16", {leaves}, where);
  f.stages.heading_rad = array_of<float>(file, "stage_heading_rad", "F32", {0}, where);
  const std::vector<std::uint64_t> stages{f.stages.size()};
  f.stages.off_rad = array_of<float>(file, "stage_off_rad", "F32", stages, where);
  f.stages.time_s = array_of<float>(file, "stage_time_s", "F32", stages, where);
  f.stages.station_m = array_of<float>(file, "stage_station_m", "F32", stages, where);
  if (!fits(f)) throw InputError(where, "has a path, a tube or stages that are out of range");
  return f;
}

}  // namespace fairway
