#include "fairway/view/engine.hpp"

#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/final_legs.hpp"
#include "fairway/run/path_segments.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/version.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What a page can draw in a moment; a longer flight is cut, and says so.
constexpr std::size_t most_pieces = 20'000;

json pieces_json(const std::vector<FlightSegment>& segments) {
  json pieces = json::array();
  for (const FlightSegment& s : segments) {
    if (pieces.size() == most_pieces) break;
    pieces.push_back({s.start.position_m.x, s.start.position_m.y, s.start.heading.rad(), s.length_m,
                      s.curvature_per_m});
  }
  return pieces;
}

json finite_or_null(double value) { return std::isfinite(value) ? json(value) : json(); }

json leg_json(const FinalLeg& leg) {
  return {{"state", name_of(leg.state)},
          {"word", leg.word},
          {"length_m", leg.length_m},
          {"time_s", leg.time_s},
          {"pieces", pieces_json(leg.segments)}};
}

const Plan& with_mission(const Plan& plan, const std::string& where) {
  if (plan.record.mission) return plan;
  throw InputError(where, "its record names no mission: expected a plan made by fairway");
}

}  // namespace

LiveEngine::LiveEngine(const fs::path& folder)
    : plan_(read_plan(folder / product::plan)),
      flights_(with_mission(plan_, (folder / product::plan).string())) {
  const fs::path file = folder / product::certificate;
  if (!fs::exists(file)) return;
  // Once as a whole, which checks digests; the answers then come from the file's own bytes, read
  // rather than mapped: what becomes of the file while the page is open is then no matter.
  const Certificate whole = read_certificate(file);
  if (proof_identity(whole) != proof_identity(plan_, whole.region_of_interest)) {
    throw InputError(file.string(),
                     "is the certificate of another plan or vehicle than plan.safetensors");
  }
  file_ = std::make_unique<LoadedFile>(file);
  if (certificate_.open(file_->bytes().data(), file_->bytes().size()) != runtime::Status::ok) {
    throw InputError(file.string(), "is not a certificate");
  }
}

json LiveEngine::info() const {
  return {{"live", true},
          {"program", program_version},
          {"verdicts", file_ != nullptr},
          {"plan_sha256", json::parse(json_text(plan_digests(plan_)))}};
}

json LiveEngine::state(const State& start) const {
  json answer = {{"verdict", nullptr}, {"time_bound_s", nullptr}};
  if (file_ != nullptr) {
    const runtime::Answer found =
        certificate_.query(start.position_m.x, start.position_m.y, start.heading.rad());
    answer["verdict"] = name_of(found.verdict);
    answer["time_bound_s"] = finite_or_null(found.time_bound_s);
  }
  const Flight flight = flights_.record(start, 0, one_lap);
  answer["flight"] = {{"outcome", name_of(flight.result.outcome)},
                      {"time_s", finite_or_null(flight.result.time_s)},
                      {"length_m", finite_or_null(flight.result.length_m)},
                      {"cut", flight.segments.size() > most_pieces},
                      {"pieces", pieces_json(flight.segments)}};
  if (flight.final_leg.state != FinalLegState::not_asked) {
    answer["flight"]["leg"] = leg_json(flight.final_leg);
  }
  return answer;
}

json LiveEngine::steer(const State& from, const State& to) const {
  json answer = leg_json(FinalLegs(plan_, to).leg_from(from, 0.0));
  const DubinsPath shortest = shortest_path(from, to, plan_.vehicle.turn_radius_m);
  answer["shortest"] = {{"word", name_of(shortest.word)},
                        {"length_m", shortest.length_m()},
                        {"pieces", pieces_json(segments_of(shortest))}};
  return answer;
}

}  // namespace fairway
