#include "fairway/run/ask_contract.hpp"

#include <algorithm>

#include "fairway/base/parallel.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/failure_guide.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/behaviour/witness_csv.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
std::vector<ContractReply> ask(const ContractCertificate& certificate,
                               std::span<const State> states) {
  const Parts parts = certificate.parts();
  std::vector<ContractReply> replies(states.size());
  for_ranges(states.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ContractAnswer answer = contract_answer(certificate.grid, parts, certificate.verdicts,
                                                    certificate.least_speed_mps(),
                                                    states[i].position_m, states[i].heading.rad());
      replies[i].verdict = answer.verdict;
      replies[i].time_bound_s = answer.worst_time_s;
    }
  });
  const auto is_open = [](const ContractReply& r) { return r.verdict == Verdict::undecided; };
  if (std::none_of(replies.begin(), replies.end(), is_open)) return replies;
  const BehaviourChoices choices(certificate.flow(), certificate.contract);
  const FailureGuide guide(choices);
  for_ranges(states.size(), 4, [&](std::size_t begin, std::size_t end) {
    WitnessSearch search(choices, guide);
    for (std::size_t i = begin; i < end; ++i) {
      if (is_open(replies[i])) replies[i].witness = search.find(states[i]);
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
      layer.code.push_back(reply.witness ? at_risk_code : static_cast<std::uint8_t>(reply.verdict));
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
