// Figs. 21, 22 and 23 of paper 2: how the region of interest is expanded backwards over borders,
// and the whole backward reachable set.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "fairway/report/picture.hpp"

namespace fairway::reproduce {

struct ExpansionFigures {
  std::map<std::string, Picture> pictures;
  std::array<double, 4> border_shares{};  ///< of S1 .. S4 in all samples of their borders (Fig. 21)
  /// Of the set of Fig. 23, n = 20 and m = 200.
  std::size_t states = 0;
  std::size_t stored_bytes = 0;
  double border_share = 0.0;
  double volume_share = 0.0;
  int sweeps = 0;                   ///< that Algorithm 1 takes
  bool algorithm_1_agrees = false;  ///< bit for bit
};

[[nodiscard]] ExpansionFigures draw_expansion();

}  // namespace fairway::reproduce
