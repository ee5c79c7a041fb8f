#include "fairway/certificate/plan_arrays.hpp"

#include "fairway/base/error.hpp"

namespace fairway {

PlanArrays plan_arrays_of(const Safetensors& file, const std::string& where) {
  PlanArrays c;
  for (const Tensor& tensor : file.tensors) {
    if (tensor.name != "heading_rad" || tensor.shape.size() != 2) continue;
    for (const std::uint64_t extent : tensor.shape) {
      if (extent < 1 || extent > 0x7fffffff) {
        throw InputError(where + ": \"heading_rad\".shape", "expected [ny, nx]");
      }
    }
    c.grid.ny = static_cast<int>(tensor.shape[0]);
    c.grid.nx = static_cast<int>(tensor.shape[1]);
  }
  const std::vector<std::uint64_t> cells{static_cast<std::uint64_t>(c.grid.ny),
                                         static_cast<std::uint64_t>(c.grid.nx)};
  c.heading_rad = array_of<float>(file, "heading_rad", "F32", cells, where);
  c.region = array_of<Region>(file, "region", "I8", cells, where);
  c.kind = array_of<CellKind>(file, "cell_kind", "U8", cells, where);
  const auto numbers = array_of<double>(file, "geometry", "F64", {geometry_numbers}, where);
  Geometry g;
  std::memcpy(&g, numbers.data(), sizeof g);
  if (!g.is_valid()) {
    throw InputError(
        where + ": \"geometry\"",
        "expected sizes in the ranges of docs/formats.md, cells smaller than the turning "
        "radius, and 2^32 units");
  }
  g.put_into(c.grid, c.vehicle);
  return c;
}

}  // namespace fairway
