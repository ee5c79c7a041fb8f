#include "fairway/compare/comparison_page.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/markup_text.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/compare/comparison_style.hpp"
#include "fairway/compare/comparison_text.hpp"
#include "fairway/compare/difference_map.hpp"

namespace fairway {
namespace {

std::string list_of(const std::vector<std::string>& sentences, const char* opening) {
  std::string items;
  for (const std::string& sentence : sentences) items += "<li>" + markup_text(sentence) + "</li>";
  return fmt::format("<ul{}>{}</ul>\n", opening, items);
}

std::string cell_of(const ComparedMeasure& m, std::size_t plan) {
  const MeasureText text = measure_text(m, plan);
  if (text.difference.empty()) return fmt::format("<td>{}</td>", markup_text(text.value));
  const double by = m.difference_from_first[plan].value * m.better;
  const char* kind = !text.differs || by == 0.0 ? "" : by > 0.0 ? "better" : "worse";
  const std::string mark = *kind == '\0' ? "" : fmt::format(" <b class=\"{0}\">{0}</b>", kind);
  return fmt::format("<td>{}<small>{}{}</small></td>", markup_text(text.value),
                     markup_text(text.difference), mark);
}

std::string table_of(const Comparison& c) {
  std::string head = "<th scope=\"col\">Measure</th>";
  for (const std::string& name : c.names) {
    head += fmt::format("<th scope=\"col\">{}</th>", markup_text(name));
  }
  std::string body;
  std::string group;
  for (const ComparedMeasure& m : c.table) {
    if (m.group != group) {
      group = m.group;
      body += fmt::format(
          "<tr class=\"group\"><th colspan=\"{}\" scope=\"colgroup\"><span>{}</span></th></tr>\n",
          c.names.size() + 1, markup_text(group));
    }
    const std::string unit = m.unit.empty() || m.unit == "%"
                                 ? ""
                                 : fmt::format(" <small>{}</small>", markup_text(m.unit));
    body += fmt::format("<tr><th scope=\"row\">{}{}</th>", markup_text(m.name), unit);
    for (std::size_t k = 0; k < c.names.size(); ++k) body += cell_of(m, k);
    body += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"wide\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Measures\"><table><thead><tr>{}"
      "</tr></thead><tbody>\n{}</tbody></table></div>\n",
      head, body);
}

std::string key_of(const char* kind, const std::string& words) {
  return fmt::format("<li><i class=\"{}\"></i>{}</li>", kind, markup_text(words));
}

std::string figure_of(const Comparison& c, const PairDifference& d) {
  const std::string& a = c.names[d.first];
  const std::string& b = c.names[d.second];
  const bool proved = d.of == Knowledge::contract || c.is_proved;
  const char* found = proved ? "proves" : "is seen to keep";
  std::string title = c.known_to(d.of);
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  const Grid& grid = d.map.places.grid;
  const double sample_m = grid.cell_m * d.map.places.cells_per_sample;
  return fmt::format(
      "<figure><figcaption><h2>{}</h2><p>Share of headings, of {} at each place, that only one "
      "plan "
      "{}. The map is {} by {} m; a square of it is {} m wide.</p></figcaption>\n{}"
      "<ul class=\"key\">{}{}{}{}{}{}{}{}{}{}</ul>\n"
      "<p class=\"hint\">Pictures of the same, with what neither {}: <a href=\"{}.svg\">SVG</a>, "
      "<a href=\"{}.png\">PNG</a>.</p></figure>\n",
      markup_text(title), d.map.each, found, length_text(grid.width_m()),
      length_text(grid.height_m()), length_text(sample_m),
      difference_svg(d, title + ": where the plans differ"),
      key_of("a1", fmt::format("only {}: up to 1/4 of the headings", a)), key_of("a2", "up to 3/4"),
      key_of("a3", fmt::format("more; in all {} of all states", percent_text(d.only_first.value))),
      key_of("b1", fmt::format("only {}: up to 1/4 of the headings", b)), key_of("b2", "up to 3/4"),
      key_of("b3", fmt::format("more; in all {} of all states", percent_text(d.only_second.value))),
      key_of("mixed", "each wins some headings"), key_of("same", "no difference"),
      key_of("goal", "goal or path"), key_of("obstacle", "obstacle"), found,
      picture_name(c.names.size(), d.second, d.of), picture_name(c.names.size(), d.second, d.of));
}

std::string sources_of(std::span<const ComparedPlan> plans) {
  std::string rows;
  for (const ComparedPlan& p : plans) {
    std::string proofs;
    for (const std::string& proof : p.proofs) proofs += markup_text(proof) + " ";
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{} × {} cells of {} m, {:g} m/s, turns of "
        "{:g} "
        "m</td><td>{}</td></tr>\n",
        markup_text(p.name), markup_text(p.from.string()), p.plan.grid.nx, p.plan.grid.ny,
        length_text(p.plan.grid.cell_m), p.plan.vehicle.speed_mps, p.plan.vehicle.turn_radius_m,
        proofs);
  }
  return "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Plans\"><table "
         "class=\"plain\">"
         "<thead><tr><th scope=\"col\">Plan</th><th scope=\"col\">From</th><th scope=\"col\">Grid "
         "and "
         "vehicle</th><th scope=\"col\">Proof</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

/// Of each sample, what the map shows there.
const char* kind_of(const DifferenceMap& map, std::size_t i) {
  if (map.places.kind[i] == CellKind::obstacle) return "obstacle";
  if (map.places.kind[i] == CellKind::target) return "goal";
  const std::size_t a = map.only_first[i];
  const std::size_t b = map.only_second[i];
  if (a == 0 && b == 0) return "same";
  if (a > 0 && b > 0) return "mixed";
  static constexpr const char* kinds[2][3]{{"a1", "a2", "a3"}, {"b1", "b2", "b3"}};
  const std::size_t n = 4 * (a + b);
  return kinds[a > 0 ? 0 : 1][n <= map.each ? 0 : n <= 3 * map.each ? 1 : 2];
}

}  // namespace

std::string difference_svg(const PairDifference& pair, const std::string& label) {
  const DifferenceMap& map = pair.map;
  const int nx = map.places.nx;
  const int ny = map.places.ny;
  std::string paths;
  for (const char* kind : {"obstacle", "goal", "a1", "a2", "a3", "b1", "b2", "b3", "mixed"}) {
    std::string d;
    for (int iy = 0; iy < ny; ++iy) {
      for (int ix = 0; ix < nx;) {
        int end = ix;
        while (end < nx && std::string_view(kind_of(map, map.places.index(end, iy))) == kind) ++end;
        if (end > ix) d += fmt::format("M{} {}h{}v1h-{}z", ix, ny - 1 - iy, end - ix, end - ix);
        ix = end > ix ? end : ix + 1;
      }
    }
    if (d.empty()) continue;
    paths += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, d);
    if (*kind == 'b') paths += fmt::format("<path class=\"hatch\" d=\"{}\"/>\n", d);
  }
  // Strokes over what only the second plan does: not told by colour alone.
  return fmt::format(
      "<svg class=\"map\" role=\"img\" aria-label=\"{0}\" viewBox=\"0 0 {1} {2}\" "
      "preserveAspectRatio=\"xMidYMid meet\" shape-rendering=\"crispEdges\"><defs><pattern "
      "id=\"hatch-{3}-{4}\" width=\"{5}\" height=\"{5}\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"{6}\" height=\"{5}\" class=\"stroke\"/>"
      "</pattern></defs><style>#map-{3}-{4} .hatch {{ fill: url(#hatch-{3}-{4}); }}</style>"
      "<rect class=\"same\" width=\"{1}\" height=\"{2}\"/><g id=\"map-{3}-{4}\">\n{7}</g></svg>\n",
      markup_text(label), nx, ny, name_of(pair.of), pair.second, std::max(nx, ny) / 90.0,
      std::max(nx, ny) / 380.0, paths);
}

std::string comparison_page(std::span<const ComparedPlan> plans, const Comparison& c,
                            const std::string& command) {
  std::string title;
  for (const std::string& name : c.names) title += (title.empty() ? "" : " against ") + name;
  std::string figures;
  for (const PairDifference& d : c.pairs) figures += figure_of(c, d);
  const std::string warnings =
      c.warnings.empty() ? "" : "<div class=\"notice\">" + list_of(c.warnings, "") + "</div>\n";
  const char* states_files = c.has_contract
                                 ? "<a href=\"states.csv\">states.csv</a> and, under the contract, "
                                   "<a href=\"states-contract.csv\">states-contract.csv</a>"
                                 : "<a href=\"states.csv\">states.csv</a>";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style></head>\n<body><header><h1>{0}</h1>\n"
      "<p class=\"hint\">{2} states, sampled evenly over all cells that are neither obstacle nor "
      "goal in any of the plans, and all headings; every plan is asked about the same ones.</p>"
      "</header>\n{3}<main>\n<section aria-label=\"Differences\">{4}</section>\n"
      "<div class=\"beside\"><section class=\"figures\" aria-label=\"Maps\">{5}</section>\n"
      "<section><h2>Side by side</h2>\n<p class=\"hint\">Small print: the difference from {6}, "
      "with "
      "its error (95 %). <b class=\"better\">Better</b> and <b class=\"worse\">worse</b> are said "
      "where it is larger than that. Shares of all states are known to within {12}, {7}; costs are "
      "of "
      "exact flights, which are evidence, not a proof.</p>\n{8}</section></div>\n"
      "<section><h2>What was compared</h2>\n{9}<p class=\"hint\">States that one plan brings to "
      "the "
      "mission and another does not: {10}. Every number, with its error: "
      "<a href=\"comparison.csv\">comparison.csv</a>, "
      "<a href=\"comparison.json\">comparison.json</a>. Made by <code>{11}</code>.</p></section>\n"
      "</main></body></html>\n",
      markup_text(title), comparison_style, grouped(c.ground.counted), warnings,
      list_of(difference_lines(c), " class=\"lead\""), figures, markup_text(c.names.front()),
      c.is_proved ? "each answered by the plan's certificate" : "each flown exactly once",
      table_of(c), sources_of(plans), states_files, markup_text(command),
      percent_text(error_of_shares(c), 2));
}

}  // namespace fairway
