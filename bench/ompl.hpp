// OMPL's DubinsStateSpace, a peer on the same pairs of poses. Without it (ompl_absent.cpp) there
// are no results.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway::bench {

class Ompl {
 public:
  Ompl(std::span<const State> from, std::span<const State> to, double turn_radius_m);
  ~Ompl();
  Ompl(const Ompl&) = delete;
  Ompl& operator=(const Ompl&) = delete;

  [[nodiscard]] static bool is_there();
  /// DubinsStateSpace::distance for every pair, one after another.
  void distances(std::span<double> length_m) const;

 private:
  struct Poses;
  std::unique_ptr<Poses> poses_;
};

}  // namespace fairway::bench
