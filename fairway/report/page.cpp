#include "fairway/report/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/markup_text.hpp"
#include "fairway/report/color.hpp"
#include "fairway/report/mode_style.hpp"
#include "fairway/report/outcome_style.hpp"
#include "fairway/report/page_arrays.hpp"
#include "fairway/report/page_frame.hpp"
#include "fairway/report/page_payload.hpp"
#include "fairway/report/page_template.hpp"
#include "fairway/report/page_verdicts.hpp"
#include "fairway/report/verdict_style.hpp"
#include "fairway/vehicle/mission_json.hpp"
#include "fairway/vehicle/vehicle_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

std::string hex(const Color& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

json style_json(const char* name, const VerdictStyle& style) {
  return {{"name", name},
          {"words", name},
          {"ground", hex(style.ground)},
          {"pen", hex(style.pen.color)},
          {"pen_pt", style.pen.width_pt},
          {"dotted", !style.pen.dash_pt.empty()},
          {"rising", style.rising},
          {"falling", style.falling}};
}

/// The pictures' own colours and patterns, so that page and pictures agree.
json styles_json() {
  json verdicts = json::array();
  for (int v = 0; v < verdict_count; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    verdicts.push_back(style_json(name_of(verdict), style_of(verdict)));
  }
  json outcomes = json::object();
  for (const Outcome outcome : outcomes_in_order) {
    const OutcomeStyle style = style_of(outcome);
    outcomes[name_of(outcome)] = {{"color", hex(style.on_screen)}, {"dash", style.dash_px}};
  }
  json ramp = json::array();
  constexpr int steps = 64;
  for (int k = 0; k < steps; ++k) ramp.push_back(hex(cost_ramp(k / (steps - 1.0))));
  json shares = json::array();
  for (int share = 0; share < 3; ++share) {
    json colors = json::array();
    for (int rank = 0; rank < share_classes; ++rank)
      colors.push_back(hex(share_color(share, rank)));
    shares.push_back(std::move(colors));
  }
  json series = json::array();
  for (int k = 0; k < 8; ++k) series.push_back(hex(series_color(k)));
  return {{"verdict", std::move(verdicts)},
          {"outcome", std::move(outcomes)},
          {"cost_ramp", std::move(ramp)},
          {"share", std::move(shares)},
          {"series", std::move(series)},
          {"obstacle", hex(palette::obstacle)},
          {"buffer", hex(palette::buffer)},
          {"buffer_pattern", hex(palette::buffer_pattern)},
          {"free", hex(palette::free)},
          {"goal", hex(palette::goal)},
          {"goal_pattern", hex(palette::goal_pattern)},
          {"unreachable", hex(palette::unreachable)},
          {"unreachable_pattern", hex(palette::unreachable_pattern)}};
}

/// What the page needs to know about the codes of verdicts.
json codes_json() {
  json failing = json::array();
  json safe = json::array();
  json seldom = json::array();
  for (const Verdict verdict : verdicts_in_order) {
    if (fails(verdict)) failing.push_back(verdict);
    if (is_safe(verdict)) safe.push_back(verdict);
    if (!is_listed(verdict, false)) seldom.push_back(verdict);
  }
  return {{"reach", Verdict::reach},         {"failing", std::move(failing)},
          {"safe", std::move(safe)},         {"seldom", std::move(seldom)},
          {"undecided", Verdict::undecided}, {"order", verdicts_in_order},
          {"obstacle", page_obstacle},       {"target", page_target}};
}

json flights_json(const std::vector<PageFlights>& groups) {
  json shown = json::array();
  std::size_t begin = 0;
  for (const PageFlights& group : groups) {
    for (const Flight& f : group.flights.first(std::min(group.most, group.flights.size()))) {
      const bool ends = std::isfinite(f.result.time_s);
      shown.push_back(
          {{"group", group.group},
           {"outcome", name_of(f.result.outcome)},
           {"time_s", ends ? json(f.result.time_s) : json()},
           {"length_m", ends ? json(f.result.length_m) : json()},
           {"start", {f.start.position_m.x, f.start.position_m.y, f.start.heading.rad()}},
           {"pieces", {begin, begin + f.segments.size()}}});
      if (!group.ground.empty()) shown.back()["ground"] = group.ground;
      if (f.onward.after != After::none) shown.back()["after"] = name_of(f.onward.after);
      begin += f.segments.size();
      const FinalLeg& leg = f.final_leg;
      if (leg.state == FinalLegState::not_asked) continue;
      shown.back()["leg"] = {{"state", name_of(leg.state)},
                             {"length_m", leg.length_m},
                             {"word", leg.word},
                             {"pieces", {begin, begin + leg.segments.size()}}};
      begin += leg.segments.size();
    }
  }
  return shown;
}

/// The line that is followed, to the millimetre: an axis for distances from it.
json line_json(const PathMission& line) {
  json places = json::array();
  const auto mm = [](double m) { return std::round(1000.0 * m) / 1000.0; };
  for (const Vec2 p : line.vertices_m) places.push_back({mm(p.x), mm(p.y)});
  return {{"line_m", std::move(places)}, {"closed", line.closed}};
}

json record_of(const PageContent& content) {
  const Grid& g = content.plan.grid;
  const PageValues values = page_values(g);
  json left_out = json::object();
  for (const PageFlights& group : content.flights) {
    if (group.flights.size() > group.most)
      left_out[group.group] = group.flights.size() - group.most;
  }
  json record = {
      {"format_version", 2},
      {"title", content.title},
      {"grid",
       {{"nx", g.nx}, {"ny", g.ny}, {"x0_m", g.x0_m}, {"y0_m", g.y0_m}, {"cell_m", g.cell_m}}},
      {"values",
       {{"nx", values.nx}, {"ny", values.ny}, {"cells_per_value", values.cells_per_value}}},
      {"frame", page_frame_json(g, frame_in(content.plan.record), content.lon_lat)},
      {"vehicle", json_of(content.plan.vehicle)},
      {"mission", json_of(content.mission)},
      {"cost_step_m", page_cost_step_m(content.plan)},
      {"styles", styles_json()},
      {"codes", codes_json()},
      {"verdicts", content.verdicts != nullptr && content.verdicts->samples() > 0
                       ? json::parse(page_verdicts_json(*content.verdicts))
                       : json()},
      {"flights", flights_json(content.flights)},
      {"flights_left_out", std::move(left_out)},
      {"words", content.words},
      {"assumptions", content.assumptions},
      {"summary", json::parse(content.summary_json)}};
  if (content.verdicts != nullptr && !content.verdicts->mode.empty()) {
    json looks = json::array();
    for (const ModeLook& look : mode_looks(content.verdicts->modes, content.plan.record.modes)) {
      looks.push_back(style_json(look.name.c_str(), look.style));
    }
    record["styles"]["mode"] = std::move(looks);
    record["styles"]["no_mode"] = style_json("no mode is proved to reach", no_mode_style());
    record["codes"]["no_mode"] = no_mode;
  }
  if (content.contract_verdicts != nullptr) {
    record["contract_verdicts"] =
        json::parse(page_verdicts_json(*content.contract_verdicts, content.witnesses));
    if (content.exact_contract) record["exact_contract"] = true;
    if (content.follow != nullptr) record["follow"] = line_json(content.follow->path);
    if (content.witnesses != nullptr) {
      record["styles"]["at_risk"] = style_json("at risk", at_risk_style());
      record["codes"]["at_risk"] = page_at_risk;
    }
  }
  return record;
}

/// JSON that is safe in a script element.
std::string inert(const json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', true, json::error_handler_t::replace)) {
    switch (c) {
      case '<':
        text += "\\u003c";
        break;
      case '>':
        text += "\\u003e";
        break;
      case '&':
        text += "\\u0026";
        break;
      default:
        text += c;
    }
  }
  return text;
}

}  // namespace

std::string page_html(const PageContent& content, std::string_view html) {
  PagePayload payload;
  add_plan_arrays(content.plan, payload);
  if (content.verdicts != nullptr) {
    add_verdict_arrays(*content.verdicts, payload);
    add_mode_arrays(*content.verdicts, content.plan, payload);
  }
  if (content.contract_verdicts != nullptr) {
    const VerdictMap& map = *content.contract_verdicts;
    add_verdict_arrays(map, payload, "contract_verdict", content.witnesses);
    if (content.witnesses != nullptr) add_witness_arrays(map, *content.witnesses, payload);
    if (content.follow != nullptr) add_tube_arrays(*content.follow, content.plan.grid, payload);
  }
  add_flight_arrays(content, payload);
  const std::array<std::pair<std::string_view, std::string>, 3> marks{
      {{"@FAIRWAY_TITLE@", markup_text(content.title)},
       {"@FAIRWAY_RECORD@", inert(record_of(content))},
       {"@FAIRWAY_ARRAYS@", base64(payload.bytes())}}};
  std::string page;
  std::size_t done = 0;
  for (const auto& [mark, text] : marks) {  // in the template's order
    const std::size_t at = html.find(mark, done);
    require(at != std::string_view::npos, "a page template has all marks, in order");
    page += html.substr(done, at - done);
    page += text;
    done = at + mark.size();
  }
  page += html.substr(done);
  return page;
}

std::string page_html(const PageContent& content) {
  require(has_page_template(), "this build has the page's template");
  return page_html(content, page_template());
}

}  // namespace fairway
