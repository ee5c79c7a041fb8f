// Looks up states in a contract certificate.
//
// Where nothing is proved, a behaviour within the contract that fails is searched for: found, the
// state is at risk, and the behaviour shows it. Answers do not depend on threads.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fairway/behaviour/behaviour_flight.hpp"
#include "fairway/behaviour/explained_behaviour.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct ContractReply {
  Verdict verdict = Verdict::undecided;
  double time_bound_s = 0.0;               ///< of every behaviour; only with reach
  int mode = 0;                            ///< the first that is proved to reach; else 0
  bool follows = false;                    ///< reach: joins the path and follows it
  std::optional<BehaviourFlight> witness;  ///< of an undecided state that is at risk

  /// The verdict's name, "follow" or "at_risk".
  const char* word() const {
    return witness ? "at_risk" : name_of(follows ? Verdict::follow : verdict);
  }
  /// The same as a number: that of the verdict, or at_risk_code.
  std::uint8_t code() const {
    return witness ? at_risk_code : static_cast<std::uint8_t>(follows ? Verdict::follow : verdict);
  }
};

/// What questions about one certificate have in common, made once; what searches for witnesses
/// have, when the first is made: on plans of a million cells, some seconds. Several threads may ask
/// at once.
class ContractQueries {
 public:
  /// `certificate` must outlive this.
  explicit ContractQueries(const ContractCertificate& certificate);
  ~ContractQueries();
  ContractQueries(const ContractQueries&) = delete;
  ContractQueries& operator=(const ContractQueries&) = delete;

  /// What is proved of a state, anywhere; never with a witness.
  [[nodiscard]] ContractReply proved(const State& state) const;

  /// To be called before a parallel loop in which searches are made: their preparation is parallel
  /// itself.
  void prepare_searches() const;

  /// To search for witnesses of states that are undecided; one for each thread.
  [[nodiscard]] WitnessSearch search() const;

  [[nodiscard]] ExplainedBehaviour explained(const BehaviourFlight& flight) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Reply [i] belongs to state [i]. Without a search no state is told to be at risk.
[[nodiscard]] std::vector<ContractReply> ask(const ContractQueries& queries,
                                             std::span<const State> states, bool search = true);
[[nodiscard]] std::vector<ContractReply> ask(const ContractCertificate& certificate,
                                             std::span<const State> states);

/// What is known near each cell's middle with (nearly) these headings (states_asked_at()), in an
/// obstacle and in the goal as verdicts_at() has it.
[[nodiscard]] std::vector<ContractLayer> contract_layers(const ContractCertificate& certificate,
                                                         std::span<const Heading> headings);

/// The flight as CSV (docs/formats.md, "Witness").
[[nodiscard]] std::string witness_csv(const ContractCertificate& certificate,
                                      const BehaviourFlight& witness);

}  // namespace fairway
