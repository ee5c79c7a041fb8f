// Plan files: safetensors (docs/formats.md), mapped into memory and checked down to the last byte.
//
// Properties that always hold:
//   1. read_plan(write_plan(p)) == p, and writing a plan that was read gives the same bytes.
//   2. A file that read_plan accepts satisfies every property of plan.hpp, and its arrays are those
//      whose SHA-256 is in its metadata.
//   3. The file does not depend on the time, its location or the number of threads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "fairway/base/atomic_file.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// Writes `plan` whole or not at all. Throws PreconditionViolation when `plan` lacks a property of
/// plan.hpp, InputError when the file cannot be written.
void write_plan(const Plan& plan, const std::filesystem::path& path, Existing existing);

/// Throws InputError{path, which field, what is expected} for anything but a whole, valid plan.
[[nodiscard]] Plan read_plan(const std::filesystem::path& path);

/// The same for bytes already in memory; `where` names them in errors.
[[nodiscard]] Plan plan_of_bytes(std::span<const std::byte> bytes, const std::string& where);

/// Which property of plan.hpp `plan` lacks, in one sentence; empty when it has them all.
[[nodiscard]] std::string plan_defect(const Plan& plan);

}  // namespace fairway
