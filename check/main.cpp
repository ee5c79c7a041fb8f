// fairway-check: re-proves a certificate, with no code of the program that made it.
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>

#include "check/proof.hpp"

namespace fairway_check {
namespace {

constexpr const char* help =
    R"(fairway-check: re-proves a certificate of "fairway verify" independently.

Usage: fairway-check CERT.safetensors [options]

  --plan PLAN    also refuse unless CERT is of this plan
  --samples N    states that measure the claimed shares of volume (default 20000, 0: none)
  --seed S       of these (default 1)
  --threads N    default: all cores; the answer does not depend on it
  --json         print one JSON object
  --quiet        print nothing but the answer
  --help, --version

Exit codes: 0 accepted, 1 refused, 64 wrong usage, 65 no readable certificate, 70 our fault.
)";

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Arguments {
  std::string certificate;
  std::string plan;
  std::size_t samples = 20000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool json = false;
  bool quiet = false;
};

template <typename T>
T whole_number(std::string_view word, std::string_view option, T least, T most) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < least || value > most) {
    throw UsageError(
        fmt::format("{}: \"{}\" is not a whole number from {} to {}", option, word, least, most));
  }
  return value;
}

Arguments arguments_of(int count, char** words) {
  Arguments a;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    const auto value = [&]() -> std::string_view {
      if (i + 1 == count) throw UsageError(fmt::format("{} lacks its value", word));
      return words[++i];
    };
    if (word == "--json") {
      a.json = true;
    } else if (word == "--quiet") {
      a.quiet = true;
    } else if (word == "--plan") {
      a.plan = value();
    } else if (word == "--samples") {
      a.samples = whole_number<std::size_t>(value(), word, 0, 1'000'000'000);
    } else if (word == "--seed") {
      a.seed = whole_number<std::uint64_t>(value(), word, 0, ~std::uint64_t{0});
    } else if (word == "--threads") {
      a.threads = whole_number<int>(value(), word, 1, 1024);
    } else if (word.starts_with("-") || !a.certificate.empty()) {
      throw UsageError(fmt::format("\"{}\" is not understood", word));
    } else {
      a.certificate = word;
    }
  }
  if (a.certificate.empty()) throw UsageError("expected a certificate");
  return a;
}

struct Report {
  std::string reason;  ///< "" when accepted
  std::array<std::size_t, verdict_count> leaves{};
  std::size_t failed = 0;
  Measured measured;
};

/// THE check: read, structure, rule, shares.
Report check(const Arguments& a) {
  Report report;
  try {
    Certificate c;
    read_certificate(a.certificate, c);
    if (!a.plan.empty()) require_plan(a.plan, a.certificate);
    take_directions(c, a.threads);
    require_good_leaves(c);
    for (const std::uint8_t verdict : c.verdict) ++report.leaves[verdict];
    const std::vector<Failure> failed = failures(c, a.threads);
    report.failed = failed.size();
    if (!failed.empty()) {
      const Failure& f = failed.front();
      throw Refused(fmt::format("{} could not be re-proved to be {}: {}",
                                c.name_of(f.section, f.leaf), verdict_name[c.verdict[f.leaf]],
                                f.reason));
    }
    report.measured = measure(c, a.samples, a.seed, a.threads);
    report.reason = defect_of_claims(c, report.measured);
  } catch (const Refused& refused) {
    report.reason = refused.what();
  }
  return report;
}

void print_json(const Arguments& a, const Report& report, double wall_s) {
  nlohmann::ordered_json out;
  out["certificate"] = a.certificate;
  out["accepted"] = report.reason.empty();
  if (!report.reason.empty()) out["reason"] = report.reason;
  for (int v = 0; v < verdict_count; ++v) {
    out["leaves"][verdict_name[v]] = report.leaves[static_cast<std::size_t>(v)];
    if (report.measured.states > 0) {
      out["measured_fraction"][verdict_name[v]] = report.measured.all[static_cast<std::size_t>(v)];
    }
  }
  out["leaves_not_reproved"] = report.failed;
  out["samples"] = report.measured.states;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  out["wall_s"] = wall_s;
  out["peak_rss_bytes"] = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_words(const Arguments& a, const Report& report, double wall_s) {
  if (!report.reason.empty()) {
    fmt::print("{}: REFUSED: {}\n", a.certificate, report.reason);
    if (report.failed > 1) fmt::print("{} leaves in all could not be re-proved.\n", report.failed);
    return;
  }
  fmt::print("{}: accepted\n", a.certificate);
  if (a.quiet) return;
  const auto& n = report.leaves;
  fmt::print("Re-proved {} leaves: {} reach, {} collide, {} leave, {} trapped; {} claim nothing.\n",
             n[reach] + n[collide] + n[leave] + n[trapped], n[reach], n[collide], n[leave],
             n[trapped], n[undecided]);
  if (report.measured.states > 0) {
    const Shares& share = report.measured.all;
    fmt::print("Of {} sampled states {:.2f} % reach, {:.2f} % are undecided, as claimed.\n",
               report.measured.states, 100.0 * share[reach], 100.0 * share[undecided]);
  }
  fmt::print("{:.2f} s on {} threads.\n", wall_s, a.threads);
}

int run(int count, char** words) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word == "--help" || word == "-h") return fmt::print("{}", help), 0;
    if (word == "--version") return fmt::print("fairway-check {}\n", FAIRWAY_VERSION), 0;
  }
  const Arguments a = arguments_of(count, words);
  const auto began = std::chrono::steady_clock::now();
  const Report report = check(a);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (a.json) {
    print_json(a, report, wall_s);
  } else {
    print_words(a, report, wall_s);
  }
  return report.reason.empty() ? 0 : 1;
}

}  // namespace
}  // namespace fairway_check

int main(int count, char** words) {
  const auto fail = [](const char* what, int code) {
    fmt::print(stderr, "fairway-check: {}\n", what);
    return code;
  };
  try {
    return fairway_check::run(count, words);
  } catch (const fairway_check::UsageError& error) {
    return fail(fmt::format("{}\nSee fairway-check --help.", error.what()).c_str(), 64);
  } catch (const fairway_check::Malformed& error) {
    return fail(error.what(), 65);
  } catch (const std::exception& error) {
    return fail(error.what(), 70);
  }
}
