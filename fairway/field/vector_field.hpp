// A direction for every cell while a field is being made (paper 1, Eqs. 6 and 7).
#pragma once

#include <cstddef>
#include <vector>

namespace fairway {

/// Components of unit vectors, [iy][ix]; (0, 0) where a cell has no direction.
struct VectorField {
  std::vector<float> x;
  std::vector<float> y;

  VectorField() = default;
  explicit VectorField(std::size_t cells) : x(cells, 0.0F), y(cells, 0.0F) {}
};

}  // namespace fairway
