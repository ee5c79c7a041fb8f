// What is proved of a run's plan under a vehicle contract, for the live page: the verdict of a
// state and, where nothing is proved and a behaviour is found that fails, that behaviour.
//
// Properties that always hold: an answer is a pure function of the certificate and the state, the
// same as `fairway query` gives; several threads may ask at once. Cost: a tenth of a millisecond
// where something is proved, else some milliseconds for the search; what searches share is made in
// the background once the certificate is read, which the first search waits for.
#pragma once

#include <filesystem>
#include <future>

#include <nlohmann/json.hpp>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

class LiveContract {
 public:
  /// Throws InputError{file, ...} for anything but a whole contract certificate, and for one of
  /// another plan, or of another contract than that of the plan.
  LiveContract(const std::filesystem::path& file, const Plan& plan);

  /// The contract, as in its record.
  [[nodiscard]] nlohmann::json contract() const;

  /// `verdict` (or "at_risk"), `time_bound_s` (null unless reach), `witness` (null unless at risk):
  /// `end`, `time_s`, `length_m`, `steps`.
  [[nodiscard]] nlohmann::json state(const State& start) const;

 private:
  const ContractCertificate certificate_;
  const ContractQueries queries_;
  std::future<void> prepared_;  // last: it ends before what it uses
};

}  // namespace fairway
