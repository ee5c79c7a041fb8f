// Certificates that Python holds.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "fairway/certificate/certificate.hpp"
#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/run/ask_contract.hpp"

namespace fairway::python {

struct HeldCertificate {
  const Certificate certificate;
};

/// With what its queries need, made once.
class HeldContractCertificate {
 public:
  explicit HeldContractCertificate(ContractCertificate made) : certificate(std::move(made)) {}
  const ContractQueries& queries() const {
    std::call_once(once_, [this] { queries_ = std::make_unique<ContractQueries>(certificate); });
    return *queries_;
  }
  const ContractCertificate certificate;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<ContractQueries> queries_;
};

}  // namespace fairway::python
