// Continuing from an earlier contract certificate of the same proof.
//
// Its leaves say only where to cut: all that is claimed is proved again.
#pragma once

#include <optional>
#include <string>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/run/resume.hpp"

namespace fairway {

/// A certificate to continue from; `where` names it in errors.
struct EarlierContractProof {
  ContractCertificate certificate;
  std::string where;
};

/// What the earlier certificate is that `now` is not: "is of another contract: ..."; empty when
/// they are of the same proof.
[[nodiscard]] std::string difference(const ContractCertificate& earlier,
                                     const ContractCertificate& now);

/// Throws InputError{earlier.where, ...} that names what differs.
void require_same_proof(const EarlierContractProof& earlier, const ContractCertificate& now);

/// The level of the shortest leaf: it is a side / 2^level long, or longer than the next.
[[nodiscard]] int finest_level(const ContractVerdicts& verdicts);

/// What became of the earlier leaves that had a verdict: of how many it does not hold any more.
[[nodiscard]] Resumed taken_over(const EarlierContractProof& earlier, const ContractVerdicts& now,
                                 bool in_time);

}  // namespace fairway
