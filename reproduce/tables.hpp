// The numbers of a reproduction, as Markdown to read and as JSON to compare.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reproduce/cell_set_figures.hpp"
#include "reproduce/expansion_figures.hpp"
#include "reproduce/figures.hpp"

namespace fairway::reproduce {

[[nodiscard]] std::string tables_of(const Reproduction& reproduction);
[[nodiscard]] nlohmann::json numbers_of(const Reproduction& reproduction);

/// The same for paper 2.
[[nodiscard]] std::string tables_of(const CellSetFigures& cells, const ExpansionFigures& expansion);
[[nodiscard]] nlohmann::json numbers_of(const CellSetFigures& cells,
                                        const ExpansionFigures& expansion);

}  // namespace fairway::reproduce
