// Figs. 6, 8 and 20 of paper 2: which headings lead out of a cell by a border (Theta), and with
// which headings it is left (Phi).
#pragma once

#include <map>
#include <string>

#include "fairway/report/picture.hpp"

namespace fairway::reproduce {

struct CellSetFigures {
  std::map<std::string, Picture> pictures;  ///< "paper2-fig6" and so on
  double unreachable_8a = 0.0;  ///< share of the cell's points from which the top is out of reach
  double unreachable_8b = 0.0;
  double y_max_m = 0.0;  ///< Eq. 16 for Fig. 20
};

[[nodiscard]] CellSetFigures draw_cell_sets();

}  // namespace fairway::reproduce
