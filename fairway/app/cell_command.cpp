// fairway cell: paper 2's cellular sets of one cell of a plan.
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/error.hpp"
#include "fairway/cellular/compute_cell_sets.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/report/draw_cell_sets.hpp"
#include "fairway/run/product_picture.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct CellArguments {
  fs::path plan;
  fs::path picture;
  std::string cell;
  std::string entry;
  std::string exit;
  int places = 8;
};

std::optional<Cell> cell_of_text(const std::string& text) {
  const std::vector<std::string> parts = CLI::detail::split(text, ',');
  Cell cell;
  if (parts.size() != 2 || !CLI::detail::lexical_cast(parts[0], cell.ix) ||
      !CLI::detail::lexical_cast(parts[1], cell.iy)) {
    return {};
  }
  return cell;
}

CLI::Validator cell_argument() {
  return {[](const std::string& text) {
            return cell_of_text(text) ? std::string() : "expected IX,IY, found " + text;
          },
          ""};
}

/// One set: its place and its ranges.
struct Line {
  const char* set;
  Side entry;
  Side exit;
  double along_m;
  const HeadingSet* headings;
};

std::vector<Line> lines_of(const CellSets& sets, const CellArguments& a) {
  std::vector<Line> lines;
  const auto add = [&](const char* name, bool theta) {
    for (const Side entry : all_sides) {
      if (!a.entry.empty() && a.entry != name_of(entry)) continue;
      for (const Side exit : all_sides) {
        if (!a.exit.empty() && a.exit != name_of(exit)) continue;
        const CellSets::Row& row = theta ? sets.theta_of(entry, exit) : sets.phi_of(entry, exit);
        for (std::size_t i = 0; i < row.size(); ++i) {
          lines.push_back({name, entry, exit, sets.along_m[i], &row[i]});
        }
      }
    }
  };
  add("theta", true);
  add("phi", false);
  return lines;
}

json json_of(const Line& line) {
  json ranges = json::array();
  for (const HeadingRange& range : *line.headings) {
    ranges.push_back({range.from_rad, range.to_rad()});
  }
  return {{"set", line.set},
          {"entry", name_of(line.entry)},
          {"exit", name_of(line.exit)},
          {"along_m", line.along_m},
          {"headings_rad", std::move(ranges)}};
}

std::string csv_of(const std::vector<Line>& lines) {
  std::string text = "set,entry,exit,along_m,from_rad,to_rad\n";
  for (const Line& line : lines) {
    for (const HeadingRange& range : *line.headings) {
      text += fmt::format("{},{},{},{},{},{}\n", line.set, name_of(line.entry), name_of(line.exit),
                          line.along_m, range.from_rad, range.to_rad());
    }
  }
  return text;
}

CellSets sets_of(const Plan& plan, Cell cell, int places) {
  const double command_rad = plan.heading_rad[plan.grid.index(cell)];
  const Direction command =
      std::isnan(command_rad) ? Direction::none() : Direction::of(Heading::from_rad(command_rad));
  return compute_cell_sets(command, {plan.grid.cell_m, plan.vehicle.turn_radius_m}, places);
}

int cell_command(const CellArguments& a, const Session& session) {
  require_places({a.picture}, {a.plan}, session.existing());
  const Plan plan = read_plan(a.plan);
  const Cell cell = cell_of_text(a.cell).value_or(Cell{-1, -1});
  if (!plan.grid.contains(cell)) {
    throw InputError(a.plan.string(), fmt::format("has no cell {}: expected IX from 0 to {} and IY "
                                                  "from 0 to {}",
                                                  a.cell, plan.grid.nx - 1, plan.grid.ny - 1));
  }
  const CellSets sets = sets_of(plan, cell, a.places);
  const bool commanded = sets.command.unit != Vec2{};
  if (!a.picture.empty()) {
    constexpr int fine = 240;
    const std::string command_text =
        commanded ? fmt::format("command {:.1f}°", sets.command.rad * 180.0 / pi) : "no command";
    const Picture picture =
        draw_cell_sets(sets_of(plan, cell, fine),
                       fmt::format("Cell ({}, {}), {}, d = {:g} m, r = {:g} m", cell.ix, cell.iy,
                                   command_text, plan.grid.cell_m, plan.vehicle.turn_radius_m));
    write_picture(picture, a.picture, session.existing());
  }
  const std::vector<Line> lines = lines_of(sets, a);
  if (session.json) {
    json all = json::array();
    for (const Line& line : lines) all.push_back(json_of(line));
    const Vec2 corner = plan.grid.corner(cell);
    session.tell({{"plan", a.plan.string()},
                  {"cell", {cell.ix, cell.iy}},
                  {"corner_m", {corner.x, corner.y}},
                  {"cell_m", plan.grid.cell_m},
                  {"command_rad", commanded ? json(sets.command.rad) : json()},
                  {"turn_radius_m", plan.vehicle.turn_radius_m},
                  {"sets", std::move(all)}},
                 "");
    return exit_done;
  }
  print(csv_of(lines));
  return exit_done;
}

}  // namespace

Action declare_cell(CLI::App& options) {
  auto arguments = std::make_shared<CellArguments>();
  CellArguments& a = *arguments;
  options.add_option("plan", a.plan, "the plan file")->required()->type_name("PLAN");
  options
      .add_option("--cell", a.cell, "column and row of the cell, counted from 0 at the lower left")
      ->required()
      ->type_name("IX,IY")
      ->check(cell_argument());
  const auto side = CLI::IsMember({"right", "top", "left", "bottom"});
  options.add_option("--entry", a.entry, "only sets of vehicles that enter through this border")
      ->check(side)
      ->type_name("BORDER");
  options.add_option("--exit", a.exit, "only sets of vehicles that leave through this border")
      ->check(side)
      ->type_name("BORDER");
  options
      .add_option("--places", a.places,
                  "number of places on each border: the middles of equal pieces")
      ->check(CLI::Range(1, 10'000))
      ->type_name("N")
      ->capture_default_str();
  options
      .add_option("-o,--output", a.picture,
                  "draw all sets of the cell, heading against place: .svg or .png")
      ->check(picture_argument())
      ->type_name("FILE");
  options.footer(
      "Paper 2's cellular sets under the cell's command, as CSV\n"
      "set,entry,exit,along_m,from_rad,to_rad: one line for each range of headings,\n"
      "counter-clockwise from the first to the second. theta: the headings that enter at a place\n"
      "of the entry border and leave through the exit border (along_m on the entry). phi: the\n"
      "headings with which a vehicle that entered anywhere on the entry can leave at a place of\n"
      "the exit (along_m on the exit). along_m runs upwards or to the right. A set without a line\n"
      "is empty.\n"
      "Example: fairway cell out/demo/plan.safetensors --cell 60,40 -o cell.svg");
  return [arguments](const Session& session) { return cell_command(*arguments, session); };
}

}  // namespace fairway
