// fairway query: what a certificate says of a state.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/states_asked.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/run/flight_summary.hpp"
#include "fairway/run/start_warnings.hpp"
#include "fairway/runtime.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct QueryArguments {
  fs::path certificate;
  StatesAsked asked;
  bool trust_file = false;
};

int query_command(const QueryArguments& a, const Session& session) {
  // Reading it whole checks digests and order; the answers then come from the mapped file.
  Frame frame;
  if (!a.trust_file || a.asked.may_be_in_degrees())
    frame = read_certificate(a.certificate).frame.value_or(Frame{});
  const MappedFile file(a.certificate);
  runtime::Certificate certificate;
  if (certificate.open(file.bytes().data(), file.bytes().size()) != runtime::Status::ok) {
    refuse_other_kind(file.bytes(), FileKind::certificate, a.certificate.string());
    throw InputError(a.certificate.string(), "is not a certificate");
  }
  const std::vector<State> states = states_of(a.asked, frame, a.certificate);
  for (const std::string& warning : degree_warnings(states, certificate.flow().grid, frame))
    session.warn(warning);
  std::vector<runtime::Answer> answers(states.size());
  for_ranges(states.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const State& s = states[i];
      answers[i] = certificate.query(s.position_m.x, s.position_m.y, s.heading.rad());
    }
  });
  if (session.json) {
    json all = json::array();
    std::optional<EarthFrame> earth;
    if (frame.is_on_earth()) earth.emplace(frame, a.certificate.string());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const bool reaches = answers[i].verdict == Verdict::reach;
      all.push_back({{"x_m", states[i].position_m.x},
                     {"y_m", states[i].position_m.y},
                     {"heading_rad", states[i].heading.rad()},
                     {"verdict", name_of(answers[i].verdict)},
                     {"time_bound_s", reaches ? json(answers[i].time_bound_s) : json()}});
      if (earth) add_degrees(all.back(), states[i], *earth);
    }
    session.tell({{"certificate", a.certificate.string()}, {"states", std::move(all)}}, "");
    return exit_done;
  }
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "x_m,y_m,heading_rad,verdict,time_bound_s\n");
  for (std::size_t i = 0; i < states.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},", states[i].position_m.x,
                   states[i].position_m.y, states[i].heading.rad(), name_of(answers[i].verdict));
    if (answers[i].verdict == Verdict::reach) {
      fmt::format_to(std::back_inserter(text), "{}", answers[i].time_bound_s);
    }
    text.push_back('\n');
  }
  print({text.data(), text.size()});
  return exit_done;
}

}  // namespace

Action declare_query(CLI::App& options) {
  auto arguments = std::make_shared<QueryArguments>();
  QueryArguments& a = *arguments;
  options.add_option("certificate", a.certificate, "the certificate")
      ->required()
      ->type_name("CERT");
  declare_states(options, a.asked, "state");
  options.add_flag("--trust-file", a.trust_file,
                   "do not check digests first: faster for a few states of a large certificate");
  options.final_callback([&a] {
    if (a.asked.empty()) throw CLI::RequiredError("--state, --state-deg or --states");
  });
  options.footer(
      "Prints CSV x_m,y_m,heading_rad,verdict,time_bound_s (the bound for reach, else empty).\n"
      "Example: fairway query demo.cert.safetensors --state 100,100,90deg");
  return [arguments](const Session& session) { return query_command(*arguments, session); };
}

}  // namespace fairway
