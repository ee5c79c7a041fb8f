#include "fairway/compare/write_comparison.hpp"

#include "fairway/compare/comparison_page.hpp"
#include "fairway/compare/comparison_text.hpp"
#include "fairway/compare/difference_map.hpp"

namespace fairway {
namespace {

constexpr const char* page_file = "compare.html";
constexpr const char* table_file = "comparison.csv";

const char* states_file(Knowledge of) {
  return of == Knowledge::exact ? "states.csv" : "states-contract.csv";
}

}  // namespace

std::vector<std::string> comparison_files(std::size_t plans) {
  std::vector<std::string> files{comparison_file, page_file, table_file};
  for (const Knowledge of : {Knowledge::exact, Knowledge::contract}) {
    files.push_back(states_file(of));
    for (std::size_t k = 1; k < plans; ++k) {
      for (const char* extension : {".svg", ".png"}) {
        files.push_back(picture_name(plans, k, of) + extension);
      }
    }
  }
  return files;
}

void write_comparison(std::span<const ComparedPlan> plans, const Comparison& comparison,
                      const std::string& command, const std::filesystem::path& place) {
  const auto write = [&](const std::string& name, const std::string& text) {
    write_whole(place / name, Existing::keep, text);
  };
  write(table_file, comparison_csv(comparison));
  write(states_file(Knowledge::exact), differing_states_csv(comparison, Knowledge::exact));
  if (comparison.has_contract) {
    write(states_file(Knowledge::contract), differing_states_csv(comparison, Knowledge::contract));
  }
  for (const PairDifference& pair : comparison.pairs) {
    const Picture picture = draw_difference(comparison, pair);
    const std::string name = picture_name(plans.size(), pair.second, pair.of);
    write(name + ".svg", picture.svg);
    write(name + ".png", picture.png);
  }
  write(page_file, comparison_page(plans, comparison, command));
  write(comparison_file, comparison_json(plans, comparison)
                                 .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                             "\n");
}

}  // namespace fairway
