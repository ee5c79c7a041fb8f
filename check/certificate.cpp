#include "check/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace fairway_check {
namespace {

using nlohmann::json;

template <typename T>
std::vector<T> values(const TensorFile& file, const char* name, const char* type,
                      const std::vector<std::uint64_t>& shape) {
  const Tensor& tensor = file.at(name, type);
  if (tensor.shape != shape) {
    throw Malformed(std::string(name) + ": its shape does not fit the other arrays");
  }
  std::vector<T> all(tensor.bytes.size() / sizeof(T));
  if (!all.empty()) std::memcpy(all.data(), tensor.bytes.data(), tensor.bytes.size());
  return all;
}

void require(bool good, const std::string& otherwise) {
  if (!good) throw Refused(otherwise);
}

double number(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_number()) throw Malformed(fmt::format("\"{}\" is no number", key));
  return value.get<double>();
}

void require_digests(const TensorFile& file) {
  const json& claimed = member(file.record, "sha256");
  for (const auto& [name, tensor] : file.tensors) {
    require(member(claimed, name.c_str()) == sha256(tensor.bytes),
            name + ": its digest is not the one claimed; the file was damaged or altered");
  }
  const json& plan = member(file.record, "plan_sha256");
  for (const char* name : {"heading_rad", "region"}) {
    require(member(plan, name) == claimed.at(name),
            fmt::format("{}: is not the plan's, by the digest in plan_sha256", name));
  }
  require(member(plan, "cost_m").is_string(), "plan_sha256 lacks cost_m");
}

void require_geometry(const Certificate& c, double units) {
  const auto good = [](double x) { return std::isfinite(x) && x > 0.0; };
  require(std::isfinite(c.x0_m) && std::isfinite(c.y0_m) && good(c.cell_m) && good(c.speed_mps) &&
              good(c.turn_radius_m) && units == 0x1p32,
          "geometry: expected finite numbers, and 2^32 units in a side");
  require(c.cell_m < c.turn_radius_m,
          "geometry: the cells are not smaller than the turning radius");
  constexpr double far = 1e9;
  require(std::abs(c.x0_m) <= far * c.cell_m && std::abs(c.y0_m) <= far * c.cell_m &&
              c.turn_radius_m <= far * c.cell_m,
          "geometry: out of proportion to the cells");
}

/// Whether [low, low + cell_m] lies in [from, to], as it is (0 or 1), or, where that is a matter of
/// rounding, as it is claimed.
bool lies_within(double low, double cell_m, double from, double to, bool claimed) {
  const double slack = 0x1p-49 * (std::abs(low) + cell_m);
  const double least = std::min(low - from, to - (low + cell_m));
  return std::abs(least) > slack ? least > 0.0 : claimed;
}

/// "goal", "obstacle", or the rectangle, which stands for itself.
struct Interest {
  std::string name;
  std::array<double, 4> box_m{};

  explicit Interest(const json& value) {
    if (value == "goal" || value == "obstacle") {
      name = value;
    } else if (value.is_array() && value.size() == 4) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (!value[i].is_number()) throw Malformed("region_of_interest: expected numbers");
        box_m[i] = value[i].get<double>();
      }
    } else {
      throw Malformed("region_of_interest: expected \"goal\", \"obstacle\", [x0, y0, x1, y1]");
    }
  }
};

CellKind kind_of(const Certificate& c, std::size_t ix, std::size_t iy, const Interest& interest) {
  const std::size_t i = iy * static_cast<std::size_t>(c.loop.nx) + ix;
  if (c.region[i] == 1) return interest.name == "obstacle" ? target : obstacle;
  if (!interest.name.empty()) {
    return interest.name == "goal" && c.region[i] == 2 ? target : ordinary;
  }
  const double d = c.cell_m;
  const bool claimed = c.kind[i] == target;
  const auto& [x0, y0, x1, y1] = interest.box_m;
  return lies_within(c.x0_m + static_cast<double>(ix) * d, d, x0, x1, claimed) &&
                 lies_within(c.y0_m + static_cast<double>(iy) * d, d, y0, y1, claimed)
             ? target
             : ordinary;
}

void require_cells(const Certificate& c, const Interest& interest) {
  for (std::size_t i = 0; i < c.cells(); ++i) {
    const auto ix = i % static_cast<std::size_t>(c.loop.nx);
    const auto iy = i / static_cast<std::size_t>(c.loop.nx);
    const double h = c.command_rad[i];
    const char* defect = nullptr;
    if (c.region[i] < -1 || c.region[i] > 2) defect = "region is none of -1, 0, 1, 2";
    if (!std::isnan(h) && !(h > -std::numbers::pi && h <= std::numbers::pi)) {
      defect = "heading_rad is not in (-pi, pi]";
    }
    if (!defect && c.kind[i] != kind_of(c, ix, iy, interest)) {
      defect = "cell_kind does not follow from region";
    }
    if (defect) throw Refused(fmt::format("cell ({}, {}): {}", ix, iy, defect));
  }
}

Shares shares(const json& record, const char* key) {
  Shares all{};
  double sum = 0.0;
  const json& claimed = member(record, key);
  for (std::size_t v = 0; v < all.size(); ++v) {
    all[v] = number(claimed, verdict_name[v]);
    require(all[v] >= 0.0 && all[v] <= 1.0, fmt::format("{}: a share is not in [0, 1]", key));
    sum += all[v];
  }
  require(sum == 0.0 || std::abs(sum - 1.0) < 1e-9, fmt::format("{}: does not sum to 1", key));
  return all;
}

void take(const TensorFile& file, Certificate& c) {
  const json& record = file.record;
  if (member(record, "format") != "fairway-certificate" || member(record, "format_version") != 1 ||
      member(record, "method") != "certified") {
    throw Malformed("is not a certificate of format_version 1 and method \"certified\"");
  }
  const std::vector<std::uint64_t> cells = file.at("heading_rad", "F32").shape;
  if (cells.size() != 2 || *std::min_element(cells.begin(), cells.end()) < 1 ||
      *std::max_element(cells.begin(), cells.end()) > 0x7fffffff ||
      file.at("heading_rad", "F32").bytes.size() / 4 > 0x3fffffff) {
    throw Malformed("heading_rad: its shape is no grid's");
  }
  c.loop.ny = static_cast<int>(cells[0]);
  c.loop.nx = static_cast<int>(cells[1]);
  c.command_rad = values<float>(file, "heading_rad", "F32", cells);
  c.region = values<std::int8_t>(file, "region", "I8", cells);
  c.kind = values<std::uint8_t>(file, "cell_kind", "U8", cells);
  c.first = values<std::uint32_t>(file, "section_first", "U32", {4 * c.cells() + 1});
  const std::vector<std::uint64_t> leaves{c.first.back()};
  c.begin = values<std::uint32_t>(file, "leaf_begin", "U32", leaves);
  c.rank = values<std::uint32_t>(file, "leaf_rank", "U32", leaves);
  c.time_s = values<float>(file, "leaf_time_s", "F32", leaves);
  c.verdict = values<std::uint8_t>(file, "leaf_verdict", "U8", leaves);
  const auto geometry = values<double>(file, "geometry", "F64", {6});
  c.x0_m = geometry[0];
  c.y0_m = geometry[1];
  c.cell_m = geometry[2];
  c.turn_radius_m = geometry[3];
  c.speed_mps = geometry[4];
  if (file.tensors.size() != 9) throw Malformed("has arrays that no certificate has");
  require_digests(file);
  require_geometry(c, geometry[5]);
  require_cells(c, Interest(member(record, "region_of_interest")));
  c.all = shares(record, "volume_fraction");
  c.free = shares(record, "volume_fraction_free");
  c.buffer = shares(record, "volume_fraction_buffer");
  c.samples = number(record, "samples");
  c.worst_time_s = number(record, "worst_time_s");
  require(c.samples >= 0.0 && std::isfinite(c.samples), "samples: is no count");
  require(c.worst_time_s >= 0.0 && std::isfinite(c.worst_time_s), "worst_time_s: is no time");
  c.loop.command_rad = c.command_rad.data();
  c.loop.kind = c.kind.data();
}

std::string defect_of_leaf(const Certificate& c, std::size_t leaf) {
  const double t = c.time_s[leaf];
  switch (c.verdict[leaf]) {
    case undecided:
      return c.rank[leaf] == 0 && t == 0.0 ? "" : "is undecided, yet has a rank or a time";
    case reach:
    case collide:
    case leave:
      return t >= 0.0 && std::isfinite(t) ? "" : "has a time that is no bound";
    case trapped:
      return c.rank[leaf] == 0 && t == std::numeric_limits<double>::infinity()
                 ? ""
                 : "is trapped, yet has a rank or a time";
    default:
      return "has a verdict that is none";
  }
}

}  // namespace

std::string Certificate::name_of(std::size_t section, std::size_t leaf) const {
  static const char* const sides[4]{"right", "top", "left", "bottom"};
  const std::size_t nx = static_cast<std::size_t>(loop.nx);
  return fmt::format("leaf {} on the {} side of cell ({}, {}) (section {}, leaf {} of it)", leaf,
                     sides[section % 4], section / 4 % nx, section / 4 / nx, section,
                     leaf - first[section]);
}

void read_certificate(const std::string& path, Certificate& certificate) {
  const TensorFile file = read_tensors(path);
  try {
    take(file, certificate);
  } catch (const Malformed& error) {
    throw Malformed(fmt::format("{}: {}", path, error.what()));
  }
}

void require_good_leaves(const Certificate& c) {
  require(c.first.front() == 0 && std::is_sorted(c.first.begin(), c.first.end()),
          "section_first: does not ascend from 0");
  for (std::size_t s = 0; s + 1 < c.first.size(); ++s) {
    const std::size_t cell = s / 4;
    const int side = static_cast<int>(s % 4);
    const int ix = static_cast<int>(cell % static_cast<std::size_t>(c.loop.nx)) + step_x[side];
    const int iy = static_cast<int>(cell / static_cast<std::size_t>(c.loop.nx)) + step_y[side];
    const bool has_leaves = c.kind[cell] == ordinary && !std::isnan(c.command_rad[cell]) &&
                            positive(into_frame(side, c.loop.direction[cell]).x) &&
                            c.loop.kind_at(ix, iy) == ordinary;
    if ((c.first[s] < c.first[s + 1]) != has_leaves) {
      throw Refused(fmt::format("section {}: {} leaves", s, has_leaves ? "lacks" : "cannot have"));
    }
    for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
      std::string defect = defect_of_leaf(c, leaf);
      if (leaf == c.first[s] ? c.begin[leaf] != 0 : c.begin[leaf - 1] >= c.begin[leaf]) {
        defect = "does not begin where it must: leaves ascend from the side's begin";
      }
      if (!defect.empty()) throw Refused(c.name_of(s, leaf) + " " + defect);
    }
  }
}

void require_plan(const std::string& path, const std::string& certificate_path) {
  const TensorFile plan = read_tensors(path);
  const TensorFile certificate = read_tensors(certificate_path);
  try {
    const json& claimed = member(certificate.record, "plan_sha256");
    for (const auto& [name, type] :
         {std::pair{"heading_rad", "F32"}, {"cost_m", "F32"}, {"region", "I8"}}) {
      require(member(claimed, name) == sha256(plan.at(name, type).bytes),
              fmt::format("{}: is not that of the plan {}", name, path));
      require(plan.at(name, type).shape == certificate.at("heading_rad", "F32").shape,
              fmt::format("{}: has another shape in the plan {}", name, path));
    }
    const json& origin = member(plan.record, "origin_m");
    const json& vehicle = member(plan.record, "vehicle");
    const json found{origin.at(0), origin.at(1), member(plan.record, "cell_m"),
                     member(vehicle, "turn_radius_m"), member(vehicle, "speed_mps")};
    const auto geometry = values<double>(certificate, "geometry", "F64", {6});
    for (std::size_t i = 0; i < found.size(); ++i) {
      require(found[i] == geometry[i], "geometry: is not that of the plan " + path);
    }
  } catch (const json::exception& error) {
    throw Malformed(path + ": is no plan: " + error.what());
  } catch (const Malformed& error) {
    throw Malformed(path + ": is no plan: " + error.what());
  }
}

}  // namespace fairway_check
