#include "fairway/run/ask_contract.hpp"

#include <algorithm>
#include <mutex>

#include "fairway/base/parallel.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/explain_behaviour.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/behaviour/witness_csv.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {

/// For searches, which take seconds to prepare on large plans.
struct SearchTools {
  explicit SearchTools(const ContractCertificate& certificate)
      : choices(certificate.flow(), certificate.contract), guide(choices) {}
  BehaviourChoices choices;
  FailureGuide guide;
};

struct ContractQueries::Parts {
  explicit Parts(const ContractCertificate& asked) : certificate(asked), parts(asked.parts()) {
    const double speed_mps = asked.least_speed_mps();
    lookup.push_back(std::make_unique<QuickLookup>(parts, asked.verdicts, speed_mps));
    for (int mode = 1; mode <= asked.further_modes(); ++mode) {
      further.push_back(std::make_unique<fairway::Parts>(asked.parts_of_mode(mode)));
      lookup.push_back(
          std::make_unique<QuickLookup>(*further.back(), asked.verdicts_of_mode(mode), speed_mps));
    }
  }

  ContractAnswer answer(const State& state, int mode) const {
    return lookup[static_cast<std::size_t>(mode)]->answer(certificate.grid, state.position_m,
                                                          state.heading.rad());
  }

  const SearchTools& tools() {
    std::call_once(made, [this] { made_tools = std::make_unique<SearchTools>(certificate); });
    return *made_tools;
  }

  const ContractCertificate& certificate;
  fairway::Parts parts;
  std::vector<std::unique_ptr<fairway::Parts>> further;  ///< of further modes
  std::vector<std::unique_ptr<QuickLookup>> lookup;      ///< [modes]
  std::once_flag made;
  std::unique_ptr<SearchTools> made_tools;
};

ContractQueries::ContractQueries(const ContractCertificate& certificate)
    : parts_(std::make_unique<Parts>(certificate)) {}
ContractQueries::~ContractQueries() = default;

ContractReply ContractQueries::proved(const State& state) const {
  const ContractCertificate& certificate = parts_->certificate;
  ContractAnswer answer = parts_->answer(state, 0);
  ContractReply reply;
  for (int mode = 1; mode <= certificate.further_modes() && answer.verdict != Verdict::reach;
       ++mode) {
    const ContractAnswer other = parts_->answer(state, mode);
    if (other.verdict != Verdict::reach) continue;
    answer = other;
    reply.mode = mode;
  }
  reply.verdict =
      certificate.flow().told(answer.verdict, certificate.grid.cell_of(state.position_m));
  reply.follows =
      certificate.follow && !certificate.follow->hold && answer.verdict == Verdict::reach;
  reply.time_bound_s = answer.worst_time_s;
  return reply;
}

void ContractQueries::prepare_searches() const { parts_->tools(); }

WitnessSearch ContractQueries::search() const {
  const SearchTools& tools = parts_->tools();
  return WitnessSearch(tools.choices, tools.guide);
}

ExplainedBehaviour ContractQueries::explained(const BehaviourFlight& flight) const {
  const ContractCertificate& certificate = parts_->certificate;
  return fairway::explained(certificate.flow(), parts_->tools().choices.commands(),
                            certificate.contract, flight);
}

std::vector<ContractReply> ask(const ContractCertificate& certificate,
                               std::span<const State> states) {
  return ask(ContractQueries(certificate), states);
}

std::vector<ContractReply> ask(const ContractQueries& queries, std::span<const State> states,
                               bool search) {
  std::vector<ContractReply> replies(states.size());
  for_ranges(states.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) replies[i] = queries.proved(states[i]);
  });
  const auto is_open = [](const ContractReply& r) { return r.verdict == Verdict::undecided; };
  if (!search || std::none_of(replies.begin(), replies.end(), is_open)) return replies;
  queries.prepare_searches();
  for_ranges(states.size(), 4, [&](std::size_t begin, std::size_t end) {
    WitnessSearch witnesses = queries.search();
    for (std::size_t i = begin; i < end; ++i) {
      if (is_open(replies[i])) replies[i].witness = witnesses.find(states[i]);
    }
  });
  return replies;
}

std::vector<ContractLayer> contract_layers(const ContractCertificate& certificate,
                                           std::span<const Heading> headings) {
  std::vector<ContractLayer> layers;
  for (const Heading heading : headings) {
    ContractLayer& layer = layers.emplace_back();
    layer.heading = heading;
    for (const ContractReply& reply :
         ask(certificate, states_asked_at(certificate.grid, heading))) {
      layer.code.push_back(reply.code());
    }
  }
  return layers;
}

std::string witness_csv(const ContractCertificate& certificate, const BehaviourFlight& witness) {
  const std::vector<float> commands =
      filled_commands(certificate.grid, certificate.heading_rad.data());
  return witness_csv(certificate.flow(), commands, certificate.contract, witness);
}

}  // namespace fairway
