// What the file of a contract certificate has in addition when it proves that a path is followed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/safetensors.hpp"
#include "fairway/inclusion/follow_proof.hpp"

namespace fairway {

inline constexpr std::size_t follow_arrays = 7;

/// Views of the proof's arrays.
void add_tensors(const FollowProof& proof, std::vector<Tensor>& tensors);
/// The object "follow" of the record.
[[nodiscard]] nlohmann::json record_of(const FollowProof& proof);

/// Throws InputError{where, ...} for arrays that do not belong together.
[[nodiscard]] FollowProof follow_proof_of(const Safetensors& file, const nlohmann::json& record,
                                          std::size_t leaves, const std::string& where);

}  // namespace fairway
