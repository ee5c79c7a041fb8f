#include "fairway/ceiling/signed_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

constexpr double widest_fine_spacing = 0.028;
constexpr float far_off = 1e9F;

struct Cells {
  int nx = 0;
  int ny = 0;
  double side = 1.0;  // turn radii
  const std::vector<std::uint8_t>& in_set;
  bool beyond = true;

  [[nodiscard]] bool in(int ix, int iy) const {
    if (ix < 0 || iy < 0 || ix >= nx || iy >= ny) return beyond;
    return in_set[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
                  static_cast<std::size_t>(ix)] != 0;
  }
};

/// Along one axis from a place to the interval of a cell, in cells.
double gap(double place, int cell) {
  return std::max({0.0, static_cast<double>(cell) - place, place - static_cast<double>(cell + 1)});
}

/// Squared distances, in turn radii, of a row of fine places to the cells that are `wanted`.
class RowDistances {
 public:
  RowDistances(const SignedDistance& d, const Cells& cells, double per_cell, bool wanted)
      : d_(d), cells_(cells), per_cell_(per_cell) {
    window_ = static_cast<int>(std::ceil(farthest_distance / cells.side)) + 1;
    first_ = static_cast<int>(std::floor(-d.margin / per_cell)) - window_;
    last_ = static_cast<int>(std::ceil((d.rows + d.margin) / per_cell)) + window_;
    along_.resize(static_cast<std::size_t>(last_ - first_ + 1) *
                  static_cast<std::size_t>(d.stride()));
    for_rows(last_ - first_ + 1, [&](int from, int to) {
      for (int row = from; row < to; ++row) fill_row(row, wanted);
    });
  }

  void squares(int j, std::vector<float>& out) const {
    out.assign(static_cast<std::size_t>(d_.stride()), far_off);
    const double y = (j + 0.5) / per_cell_;
    const int cell = static_cast<int>(std::floor(y));
    for (int iy = cell - window_; iy <= cell + window_; ++iy) {
      const auto across = static_cast<float>(gap(y, iy) * cells_.side);
      const float* along = &along_[static_cast<std::size_t>(iy - first_) * out.size()];
      for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = std::min(out[i], along[i] * along[i] + across * across);
      }
    }
  }

 private:
  void fill_row(int row, bool wanted) {
    float* out = &along_[static_cast<std::size_t>(row) * static_cast<std::size_t>(d_.stride())];
    for (int i = -d_.margin; i < d_.columns + d_.margin; ++i) {
      const double x = (i + 0.5) / per_cell_;
      const int cell = static_cast<int>(std::floor(x));
      double least = 1e4;
      for (int ix = cell - window_; ix <= cell + window_; ++ix) {
        if (cells_.in(ix, first_ + row) == wanted) least = std::min(least, gap(x, ix));
      }
      *out++ = static_cast<float>(least * cells_.side);
    }
  }

  const SignedDistance& d_;
  const Cells& cells_;
  double per_cell_;
  int window_ = 1;
  int first_ = 0;
  int last_ = 0;
  std::vector<float> along_;
};

Radius in_units(float square) {
  const double limit = farthest_distance * units_per_turn_radius;
  return static_cast<Radius>(
      std::lround(std::min(limit, std::sqrt(static_cast<double>(square)) * units_per_turn_radius)));
}

}  // namespace

SignedDistance signed_distance(const BallLattice& lattice, const std::vector<std::uint8_t>& in_set,
                               bool beyond) {
  SignedDistance d;
  d.fine = 2 * static_cast<int>(std::ceil(0.5 * (lattice.spacing / widest_fine_spacing - 1.0))) + 1;
  d.fine = std::max(1, d.fine);
  d.spacing = lattice.spacing / d.fine;
  d.columns = lattice.nx * d.fine;
  d.rows = lattice.ny * d.fine;
  d.margin = lattice.margin * d.fine;
  d.values.resize(static_cast<std::size_t>(d.stride()) *
                  static_cast<std::size_t>(d.rows + 2 * d.margin));
  const double side = lattice.spacing * lattice.per_cell;
  const Cells cells{lattice.cells_x, lattice.cells_y, side, in_set, beyond};
  const double per_cell = static_cast<double>(lattice.per_cell) * d.fine;
  const RowDistances outside(d, cells, per_cell, true);
  const RowDistances inside(d, cells, per_cell, false);
  for_rows(d.rows + 2 * d.margin, [&](int from, int to) {
    std::vector<float> to_set;
    std::vector<float> to_rest;
    for (int row = from; row < to; ++row) {
      outside.squares(row - d.margin, to_set);
      inside.squares(row - d.margin, to_rest);
      Radius* out = &d.values[static_cast<std::size_t>(row) * to_set.size()];
      for (std::size_t i = 0; i < to_set.size(); ++i) {
        out[i] =
            to_set[i] > 0.0F ? in_units(to_set[i]) : static_cast<Radius>(-in_units(to_rest[i]));
      }
    }
  });
  return d;
}

}  // namespace fairway
