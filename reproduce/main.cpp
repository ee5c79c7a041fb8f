// fairway-reproduce DEMO_FOLDER OUT_FOLDER: redraws Figs. 3 to 8 of paper 1 on the project's own
// map and prints measurements of them. Twice: to the letter of the paper (metric, filter
// and blend "paper"), and with the project's defaults. Then Figs. 6, 8 and 20 to 23 of paper 2, and
// 5 to 7 of paper 3.
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "reproduce/cell_set_figures.hpp"
#include "reproduce/expansion_figures.hpp"
#include "reproduce/figures.hpp"
#include "reproduce/steering_figures.hpp"
#include "reproduce/steering_robustness.hpp"
#include "reproduce/tables.hpp"

namespace {

struct Setting {
  const char* folder;
  const char* title;
  fairway::FieldOptions options;
};

void write_pictures(const std::filesystem::path& folder,
                    const std::map<std::string, fairway::Picture>& pictures) {
  using namespace fairway;
  std::filesystem::create_directories(folder);
  for (const auto& [name, picture] : pictures) {
    write_whole(folder / (name + ".svg"), Existing::replace, picture.svg);
    write_whole(folder / (name + ".png"), Existing::replace, picture.png);
  }
}

int reproduce(const std::filesystem::path& demo, const std::filesystem::path& out) {
  using namespace fairway;
  const std::array<Setting, 2> settings{
      {{"paper", "To the letter of the paper", reproduce::options_to_the_letter()},
       {"default", "With the preset \"paper\" (except sigma)", FieldOptions{}}}};
  std::string text;
  nlohmann::json numbers;
  for (const Setting& setting : settings) {
    const auto done = reproduce::reproduce_figures(demo, setting.options);
    write_pictures(out / setting.folder, done.pictures);
    const std::string tables = reproduce::tables_of(done);
    fmt::print("## {}\n\n{}\n", setting.title, tables);
    text += fmt::format("## {}\n\n{}\n", setting.title, tables);
    numbers[setting.folder] = reproduce::numbers_of(done);
  }
  const auto cells = reproduce::draw_cell_sets();
  const auto expansion = reproduce::draw_expansion();
  write_pictures(out / "verification", cells.pictures);
  write_pictures(out / "verification", expansion.pictures);
  const std::string tables = reproduce::tables_of(cells, expansion);
  fmt::print("## Paper 2\n\n{}\n", tables);
  text += fmt::format("## Paper 2\n\n{}\n", tables);
  numbers["verification"] = reproduce::numbers_of(cells, expansion);
  const auto steering = reproduce::draw_steering();
  write_pictures(out / "steering", steering.pictures);
  const std::string steering_tables = reproduce::tables_of(steering) +
                                      "\nMoving goals and noise:\n\n" +
                                      reproduce::table_of(reproduce::steering_robustness(400));
  fmt::print("## Paper 3\n\n{}\n", steering_tables);
  text += fmt::format("## Paper 3\n\n{}\n", steering_tables);
  write_whole(out / "measures.md", Existing::replace, text);
  write_whole(out / "measures.json", Existing::replace, numbers.dump(2) + "\n");
  fmt::print("Figures and tables are in {}\n", out.string());
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "usage: fairway-reproduce DEMO_FOLDER OUT_FOLDER\n");
    return 64;
  }
  try {
    return reproduce(words[1], words[2]);
  } catch (const fairway::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 65;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fairway-reproduce: {}\n", error.what());
    return 70;
  }
}
