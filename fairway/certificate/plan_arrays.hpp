// The arrays that certificates of either kind take from their plan, as their files have them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/tensor_arrays.hpp"
#include "fairway/map/region.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"

namespace fairway {

/// The array `name` of `file`, of this type and shape (0: any extent).
template <typename T>
std::vector<T> array_of(const Safetensors& file, const char* name, const char* dtype,
                        const std::vector<std::uint64_t>& shape, const std::string& where) {
  const Tensor& tensor = tensor_of(file, name, dtype, shape, sizeof(T), where, "a certificate");
  std::vector<T> values(tensor.data.size() / sizeof(T));
  std::memcpy(values.data(), tensor.data.data(), tensor.data.size());
  return values;
}

struct PlanArrays {
  Grid grid;
  Vehicle vehicle;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<CellKind> kind;      ///< [iy][ix]
};

/// "heading_rad", "region", "cell_kind" and "geometry". Throws InputError{where, ...}.
[[nodiscard]] PlanArrays plan_arrays_of(const Safetensors& file, const std::string& where);

}  // namespace fairway
