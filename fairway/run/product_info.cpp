#include "fairway/run/product_info.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/findings.hpp"
#include "fairway/run/map_survey.hpp"
#include "fairway/run/path_follower.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/verify/region_of_interest_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

/// Lines of words, and the same as members.
class Description {
 public:
  Description(const std::filesystem::path& file, const char* kind, const char* says) {
    info_.words = fmt::format("{}\n", file.string());
    info_.report = {{"file", file.string()}, {"kind", kind}};
    line("kind", says);
  }

  void line(const char* key, const std::string& words) {
    info_.words += fmt::format("  {:<20}{}\n", key, words);
  }
  json& report() { return info_.report; }

  void grid(const Grid& g, const Frame& frame) {
    line("size", fmt::format("{} m x {} m: {} x {} cells of {} m", length_text(g.width_m()),
                             length_text(g.height_m()), g.nx, g.ny, length_text(g.cell_m)));
    line("frame", fmt::format("x from {} to {}, y from {} to {}", coordinate_text(g.x0_m),
                              coordinate_text(g.x0_m + g.width_m()), coordinate_text(g.y0_m),
                              coordinate_text(g.y0_m + g.height_m())));
    line("on Earth", earth_words(frame));
    info_.report["cells"] = {g.nx, g.ny};
    info_.report["cell_m"] = g.cell_m;
    info_.report["origin_m"] = {g.x0_m, g.y0_m};
    info_.report["on_earth"] = frame.is_on_earth();
  }
  void vehicle(const Vehicle& v, const VehicleContract* contract) {
    line("vehicle",
         fmt::format("turning radius {} m, {:g} m/s", length_text(v.turn_radius_m), v.speed_mps));
    info_.report["vehicle"] = {{"turn_radius_m", v.turn_radius_m}, {"speed_mps", v.speed_mps}};
    info_.report["contract"] = contract != nullptr ? json_of(*contract) : json();
    if (contract != nullptr) line("", contract_words(*contract));
  }
  void region(const RegionOfInterest& region) {
    const json asked = json_of(region);
    info_.report["region_of_interest"] = asked;
    line("to be reached", asked.is_string()
                              ? "the " + asked.get<std::string>()
                              : fmt::format("the cells wholly inside {} m", asked.dump()));
  }
  void follow(const FollowProof& proof) {
    if (proof.hold) {
      line("to hold at", fmt::format("({:g}, {:g}), within {:g} m for ever", proof.hold->goal_m.x,
                                     proof.hold->goal_m.y, rounded_up(proof.hold->radius_m, 3)));
      info_.report["hold_radius_m"] = proof.hold->radius_m;
      return;
    }
    const float tube_m = widest_of(proof.tube).distance_m;
    line("to be followed",
         fmt::format("a{} path, within {:g} m; {}", proof.path.closed ? " closed" : "n open",
                     rounded_up(static_cast<double>(tube_m), 3), lap_words(proof)));
    info_.report["follow"] = {{"closed", proof.path.closed},
                              {"tube_m", tube_m},
                              {"lap_time_s", {proof.stages.lap_least_s, proof.stages.lap_most_s}}};
  }
  /// What the file's own record says, which anybody may have written.
  void evidence(const json& record) {
    const auto& known = record.is_object() ? record : json::object();
    for (const char* key : {"volume_fraction", "volume_fraction_free", "at_risk", "at_risk_free",
                            "samples", "stopped_by", "program"}) {
      if (known.contains(key)) info_.report[key] = known[key];
    }
    const bool some = tell_shares(known, "of all states", "volume_fraction", "at_risk");
    tell_shares(known, "of safe starts", "volume_fraction_free", "at_risk_free");
    if (!some) line("shares", "none are stored");
    line("checked", "no; `fairway check` proves it again");
    if (const auto by = known.find("stopped_by"); by != known.end() && by->is_string()) {
      line("ended by", by->get<std::string>());
    }
    made_by(known);
  }
  /// The share of all states that each mode serves, if the record says it.
  void modes(const json& record) {
    const auto shares = record.find("reach_by_mode");
    if (shares == record.end() || !shares->is_array()) return;
    std::string words;
    std::size_t mode = 0;
    for (const json& share : *shares) {
      if (!share.is_number()) return;
      words += fmt::format("{}{} by mode {}", words.empty() ? "" : ", ",
                           percent_text(share.get<double>(), decimals_in(record)), mode++);
    }
    if (words.empty()) return;
    line("reach", words);
    info_.report["reach_by_mode"] = *shares;
  }
  void made_by(const json& record) {
    if (const auto by = record.find("program"); by != record.end() && by->is_string()) {
      line("made by", by->get<std::string>());
    }
  }
  ProductInfo info() {
    info_.words.pop_back();
    return std::move(info_);
  }

 private:
  /// False when there are none.
  bool tell_shares(const json& known, const char* title, const char* key, const char* risk_key) {
    const auto shares = known.find(key);
    if (shares == known.end() || !shares->is_object()) return false;
    const int decimals = decimals_in(known);
    std::string words;
    const auto add = [&](const char* name, double share) {
      if (!(share > 0.0)) return;
      words += words.empty() ? "" : ", ";
      words += percent_text(share, decimals) + " " + name;
    };
    const double risk = number_in(known, risk_key);
    for (const Verdict verdict : verdicts_in_order) {
      const bool open = verdict == Verdict::undecided;
      if (open) add("at risk", risk);
      add(name_of(verdict), number_in(*shares, name_of(verdict)) - (open ? risk : 0.0));
    }
    if (!words.empty()) line(title, words);
    return !words.empty();
  }
  static int decimals_in(const json& record) {
    const auto samples = record.find("samples");
    const bool sampled = samples != record.end() && samples->is_number_unsigned();
    return sampled ? decimals_of_sample(samples->get<std::size_t>()) : 0;
  }
  /// 0 when there is none.
  static double number_in(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
  }

  ProductInfo info_;
};

std::string mission_words(const std::optional<Mission>& mission) {
  if (!mission) return "not recorded";
  if (const auto* path = std::get_if<PathMission>(&*mission)) {
    return fmt::format("a{} path of {}", path->closed ? " closed" : "n open",
                       plural(path->vertices_m.size(), "waypoint"));
  }
  const Vec2 at = std::get<GoalMission>(*mission).goal_m;
  return fmt::format("a goal at ({:g}, {:g})", at.x, at.y);
}

/// "12 further ones: 8 on towards 0, 45, ... degrees, 4 by turning_places".
std::string mode_words(const std::vector<ModeRecord>& modes) {
  std::vector<double> degrees;
  std::map<std::string, std::size_t> others;
  for (const ModeRecord& mode : modes) {
    const bool directed = mode.rule == "direction" && mode.direction_rad.has_value();
    if (directed) degrees.push_back(std::round(*mode.direction_rad * 1800.0 / pi) / 10.0);
    if (!directed) ++others[mode.rule];
  }
  std::string words = plural(modes.size(), "further one") + ":";
  if (!degrees.empty()) {
    words += fmt::format(" {} on towards {:g} degrees", degrees.size(), fmt::join(degrees, ", "));
  }
  for (const auto& [rule, count] : others) {
    words += fmt::format("{} {} by {}", words.back() == ':' ? "" : ";", count,
                         rule.empty() ? "a rule without name" : rule);
  }
  return words;
}

ProductInfo describe(const std::filesystem::path& file, const Plan& plan) {
  Description d(file, "plan", "a plan: a command for each cell; nothing is proved of it");
  d.grid(plan.grid, frame_in(plan.record));
  d.vehicle(plan.vehicle, plan.record.contract ? &*plan.record.contract : nullptr);
  d.line("mission", mission_words(plan.record.mission));
  const RegionCells cells = count_regions(plan);
  const std::size_t all = plan.grid.size();
  d.line("cells", fmt::format("{} free, {} buffer, {} obstacle, {}", percent_text(cells.free, all),
                              percent_text(cells.buffer, all), percent_text(cells.obstacle, all),
                              plural(cells.goal, "goal cell")));
  for (const Finding& f : plan_findings(plan)) {
    d.line("", fmt::format("{} of {} {}", f.share, f.of, f.what));
  }
  d.report()["region_cells"] = {{"free", cells.free},
                                {"buffer", cells.buffer},
                                {"obstacle", cells.obstacle},
                                {"goal", cells.goal}};
  d.report()["unreachable_free_cells"] = cells.unreachable;
  const json record = json::parse(json_text(plan.record));
  if (plan.further_modes() > 0) {
    d.line("modes", mode_words(plan.record.modes));
    d.report()["modes"] = record.at("modes");
  }
  if (plan.record.program) d.report()["program"] = *plan.record.program;
  d.made_by(record);
  return d.info();
}

ProductInfo describe(const std::filesystem::path& file, const Certificate& c) {
  Description d(file, "certificate", "a certificate of the exact vehicle");
  d.grid(c.grid, c.frame.value_or(Frame{}));
  d.vehicle(c.vehicle, nullptr);
  d.region(c.region_of_interest);
  d.line("leaves", grouped(c.sections.verdict.size()));
  d.report()["leaves"] = c.sections.verdict.size();
  const json record = json::parse(record_text(c));
  if (c.further_modes() > 0) {
    const auto further = static_cast<std::size_t>(c.further_modes());
    d.line("modes", fmt::format("{}, of {} leaves", plural(further, "further one"),
                                grouped(c.mode_sections.leaves())));
    d.report()["further_modes"] = further;
    d.report()["mode_leaves"] = c.mode_sections.leaves();
    d.modes(record);
  }
  d.evidence(record);
  return d.info();
}

ProductInfo describe(const std::filesystem::path& file, const ContractCertificate& c) {
  Description d(file, "contract_certificate",
                "a contract certificate: it holds for every vehicle that keeps the contract");
  d.grid(c.grid, c.frame.value_or(Frame{}));
  d.vehicle(c.vehicle, &c.contract);
  if (c.follow) {
    d.follow(*c.follow);
  } else {
    d.region(c.region_of_interest);
  }
  d.line("leaves", fmt::format("{}; cells of {} x {} parts", grouped(c.verdicts.leaves()),
                               c.parts_per_cell, c.parts_per_cell));
  d.report()["leaves"] = c.verdicts.leaves();
  d.report()["parts_per_cell"] = c.parts_per_cell;
  d.evidence(json::parse(record_text(c)));
  return d.info();
}

ProductInfo describe(const std::filesystem::path& file, const Bitmap& b) {
  Description d(file, "bitmap", "a bitmap: a picture drawn from samples, not a proof");
  d.grid(b.grid(), b.frame.value_or(Frame{}));
  d.vehicle(b.vehicle, nullptr);
  d.region(b.region_of_interest);
  d.made_by(json::parse(record_text(b)));
  return d.info();
}

}  // namespace

ProductInfo describe_product(const std::filesystem::path& file, ProductKind kind) {
  switch (kind) {
    case ProductKind::certificate:
      return describe(file, read_certificate(file));
    case ProductKind::contract_certificate:
      return describe(file, read_contract_certificate(file));
    case ProductKind::bitmap:
      return describe(file, read_bitmap(file));
    case ProductKind::plan:
      break;
  }
  return describe(file, read_plan(file));
}

}  // namespace fairway
