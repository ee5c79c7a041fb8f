// fairway query: looks up states in a certificate or a bitmap.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/states_asked.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/bitmap/sample_bitmap.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/map/earth_frame.hpp"
#include "fairway/run/ask_contract.hpp"
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
  fs::path witness;
};

/// What is printed for a state.
struct Answer {
  const char* word = "";
  std::optional<double> time_bound_s;
  std::optional<int> mode = {};  ///< where the plan has several
};

std::vector<Answer> answers_of(const runtime::Certificate& certificate,
                               const std::vector<State>& states) {
  std::vector<Answer> answers(states.size());
  for_ranges(states.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const State& s = states[i];
      const auto found = certificate.query(s.position_m.x, s.position_m.y, s.heading.rad());
      answers[i].word = name_of(found.verdict);
      if (found.verdict == Verdict::reach) answers[i].time_bound_s = found.time_bound_s;
      if (certificate.modes() > 1) answers[i].mode = found.mode;
    }
  });
  return answers;
}

std::vector<Answer> answers_of(const Bitmap& bitmap, const std::vector<State>& states) {
  std::vector<Answer> answers;
  for (const Sampled found : sampled_answers(bitmap, states)) {
    answers.push_back({name_of(found), {}});
  }
  return answers;
}

void tell(const QueryArguments& a, const char* kind, const Frame& frame,
          const std::vector<State>& states, const std::vector<Answer>& answers,
          const Session& session, bool has_modes = false) {
  if (session.json) {
    json all = json::array();
    std::optional<EarthFrame> earth;
    if (frame.is_on_earth()) earth.emplace(frame, a.certificate.string());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto& bound_s = answers[i].time_bound_s;
      all.push_back({{"x_m", states[i].position_m.x},
                     {"y_m", states[i].position_m.y},
                     {"heading_rad", states[i].heading.rad()},
                     {"verdict", answers[i].word},
                     {"time_bound_s", bound_s ? json(*bound_s) : json()}});
      if (answers[i].mode) all.back()["mode"] = *answers[i].mode;
      if (earth) add_degrees(all.back(), states[i], *earth);
    }
    session.tell({{kind, a.certificate.string()}, {"states", std::move(all)}}, "");
    return;
  }
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "x_m,y_m,heading_rad,verdict,time_bound_s{}\n",
                 has_modes ? ",mode" : "");
  for (std::size_t i = 0; i < states.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},", states[i].position_m.x,
                   states[i].position_m.y, states[i].heading.rad(), answers[i].word);
    if (const auto& bound_s = answers[i].time_bound_s) {
      fmt::format_to(std::back_inserter(text), "{}", *bound_s);
    }
    if (has_modes) fmt::format_to(std::back_inserter(text), ",{}", answers[i].mode.value_or(0));
    text.push_back('\n');
  }
  print({text.data(), text.size()});
}

/// The states asked for; warns of those that look like degrees typed as metres.
std::vector<State> states_of(const QueryArguments& a, const Grid& grid, const Frame& frame,
                             const Session& session) {
  std::vector<State> states = states_of(a.asked, frame, a.certificate);
  for (const std::string& warning : degree_warnings(states, grid, frame)) session.warn(warning);
  return states;
}

/// Under a contract: with the behaviour that fails, where one is known.
int query_contract(const QueryArguments& a, const Session& session) {
  require_places({a.witness}, files_of({a.certificate}), session.existing());
  const ContractCertificate certificate = read_contract_certificate(a.certificate);
  const Frame frame = certificate.frame.value_or(Frame{});
  const std::vector<State> states = states_of(a, certificate.grid, frame, session);
  if (!a.witness.empty() && states.size() != 1) {
    throw InputError("--witness", fmt::format("goes with a single state, found {}", states.size()));
  }
  const std::vector<ContractReply> replies = ask(certificate, states);
  std::vector<Answer> answers;
  for (const ContractReply& reply : replies) {
    answers.push_back({reply.word(), {}});
    if (reply.verdict == Verdict::reach) answers.back().time_bound_s = reply.time_bound_s;
  }
  tell(a, "certificate", frame, states, answers, session);
  if (a.witness.empty()) return exit_done;
  if (!replies.front().witness) {
    session.warn(
        fmt::format("no witness was written: the verdict is {}, and no behaviour that "
                    "fails is known",
                    replies.front().word()));
    return exit_no;
  }
  write_whole(a.witness, session.existing(), witness_csv(certificate, *replies.front().witness));
  return exit_done;
}

int query_command(const QueryArguments& a, const Session& session) {
  const MappedFile file(a.certificate);
  if (kind_of_bytes(file.bytes()) == FileKind::contract_certificate) {
    return query_contract(a, session);
  }
  if (!a.witness.empty()) {
    throw InputError(
        a.certificate.string(),
        "is not a contract certificate: only under a contract is a state at risk, with a "
        "witness");
  }
  if (kind_of_bytes(file.bytes()) == FileKind::bitmap) {
    const Bitmap bitmap = read_bitmap(a.certificate);
    const Frame frame = bitmap.frame.value_or(Frame{});
    const std::vector<State> states = states_of(a, bitmap.grid(), frame, session);
    tell(a, "bitmap", frame, states, answers_of(bitmap, states), session);
    return exit_done;
  }
  // Reading the whole file checks its digests and order; the answers then come from the mapped
  // file.
  Frame frame;
  if (!a.trust_file || a.asked.may_be_in_degrees()) {
    frame = read_certificate(a.certificate).frame.value_or(Frame{});
  }
  runtime::Certificate certificate;
  if (certificate.open(file.bytes().data(), file.bytes().size()) != runtime::Status::ok) {
    refuse_other_kind(file.bytes(), FileKind::certificate, a.certificate.string());
    throw InputError(a.certificate.string(), "is not a certificate");
  }
  const std::vector<State> states = states_of(a, certificate.flow().grid, frame, session);
  tell(a, "certificate", frame, states, answers_of(certificate, states), session,
       certificate.modes() > 1);
  return exit_done;
}

}  // namespace

Action declare_query(CLI::App& options) {
  auto arguments = std::make_shared<QueryArguments>();
  QueryArguments& a = *arguments;
  options
      .add_option("certificate", a.certificate,
                  "the certificate, of the exact vehicle or under a contract, or a bitmap")
      ->required()
      ->type_name("CERT|BITMAP");
  declare_states(options, a.asked, "state");
  options.add_flag("--trust-file", a.trust_file,
                   "skip checking the certificate's digests: faster for a few states of a large "
                   "certificate");
  options
      .add_option("--witness", a.witness,
                  "under a contract: write the behaviour that fails from this state, if it is at "
                  "risk, step by step")
      ->type_name("CSV");
  options.final_callback([&a] {
    if (a.asked.empty()) throw CLI::RequiredError("--state, --state-deg or --states");
  });
  options.footer(
      "Prints CSV x_m,y_m,heading_rad,verdict,time_bound_s (the bound is empty unless the verdict\n"
      "is reach). A certificate gives proved verdicts; if its plan has further modes, a sixth\n"
      "column, mode, names the one to fly: the first that is proved to reach, 0 where none is.\n"
      "A bitmap gives what its samples show at the first border that the state's flight meets:\n"
      "sampled_reach, sampled_other, or undecided where they disagree. That is a picture, not a\n"
      "proof.\n"
      "Example: fairway query demo.cert.safetensors --state 100,100,90deg");
  return [arguments](const Session& session) { return query_command(*arguments, session); };
}

}  // namespace fairway
