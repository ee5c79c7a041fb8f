// What `fairway verify` is asked: its options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

struct VerifyArguments {
  std::filesystem::path plan;
  std::filesystem::path output;
  std::filesystem::path resume;
  std::filesystem::path failures;
  std::filesystem::path pictures;
  std::filesystem::path summary;
  std::string method;  // empty: contract if there is one, else certified
  std::filesystem::path contract;
  int parts_per_cell = 0;
  std::string region = "goal";
  VerifyLimits limits;
  bool ceiling = false;
  std::size_t volume_samples = CertifyOptions{}.samples;
  std::uint64_t seed = CertifyOptions{}.seed;
  int samples_per_border = usual_border_samples;
};

/// Fills `arguments`, which must outlive the options, when they are parsed.
void declare_verify_arguments(CLI::App& options, VerifyArguments& arguments);

}  // namespace fairway
