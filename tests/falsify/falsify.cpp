// Falsification: certifies plans and looks for a state whose proved verdict an exact flight
// contradicts. None is expected; docs/trust.md.
//
//   fairway-falsify [PLAN.safetensors ...] [--random-plans N] [--states N] [--seed S]
//                   [--undecided-max F] [--time-limit S] [--last-level L] [--odd-plans N]
//                   [--modes CERT.safetensors]... [--mode-plans N] [--hand-overs N]
//                   [--contract FILE.toml] [--contract-plans N] [--contract-mode-plans N]
//                   [--flights N] [--parts K]
//
// --modes: attacks certificates of plans with modes (mode_attack.hpp), until --hand-overs flights
// have changed modes on the way. --mode-plans: does the same to random plans with random modes. A
// PLAN with modes is certified with them, and attacked so after its first mode alone.
//
// --contract: proves the plans under this vehicle contract instead, and attacks those verdicts with
// --flights behaviours that keep it (contract_attack.hpp). --contract-plans: does the same to
// random plans with random contracts. Every other random plan, and the plans for even seeds, answer
// as a vehicle's queries do (inclusion/quick_lookup.hpp). A PLAN with modes is proved with them
// under the contract, and attacked through hand-overs (contract_mode_attack.hpp);
// --contract-mode-plans: so are random plans with modes.
//
// Attacks under a contract tell how far they are on stderr, and after an interrupt their totals so
// far.
//
// --odd-plans: certifies this many plans at the limits of what a plan may be, measures them with
// few and with many samples, and checks them: fairway-check must accept everything verify makes.
//
// Half of the states of a plan are drawn at random, including degenerate ones; half lie where the
// verdict or the flight's outcome changes, found by bisection between two states. States whose
// verdict differs from the flight in double are flown again in 237 bits, both ways where the model
// leaves a choice. Exit code 1 on any contradiction.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/core.h>

#include "check/proof.hpp"
#include "check/testing/sample_certificate.hpp"
#include "fairway/base/random.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/wide_flight.hpp"
#include "tests/falsify/contract_runs.hpp"
#include "tests/falsify/follow_attack.hpp"
#include "tests/falsify/mode_attack.hpp"
#include "tests/falsify/progress.hpp"

namespace fairway {
namespace {

struct Settings {
  std::vector<std::string> plans;
  std::uint64_t random_plans = 0;
  std::uint64_t odd_plans = 0;
  std::size_t states = 100000;
  std::uint64_t seed = 1;
  CertifyOptions certify;
  std::string contract;
  std::vector<std::string> follow;  ///< certificates
  std::vector<std::string> modes;   ///< the same
  std::uint64_t mode_plans = 0;
  std::uint64_t hand_overs = 10000;
  std::uint64_t contract_plans = 0;
  std::uint64_t contract_mode_plans = 0;
  std::uint64_t flights = 100000;
  int parts = 2;
};

struct Totals {
  std::size_t states = 0;
  std::size_t aimed = 0;
  std::size_t undecided = 0;
  std::size_t contradictions = 0;
  std::size_t late = 0;     // flown longer than the bound
  std::size_t refuted = 0;  // the flight in double was wrong; the one in 237 bits agrees
  std::size_t unknown = 0;  // not settled in 237 bits either
  std::array<std::size_t, verdict_count> by_verdict{};

  void add(const Totals& other) {
    states += other.states;
    aimed += other.aimed;
    undecided += other.undecided;
    contradictions += other.contradictions;
    late += other.late;
    refuted += other.refuted;
    unknown += other.unknown;
    for (std::size_t v = 0; v < by_verdict.size(); ++v) by_verdict[v] += other.by_verdict[v];
  }
  std::string line() const {
    std::string text = fmt::format("{} states ({} aimed), {} undecided", states, aimed, undecided);
    for (const Verdict verdict : verdicts_in_order) {
      if (verdict == Verdict::undecided) continue;
      text +=
          fmt::format(", {} {}", by_verdict[static_cast<std::size_t>(verdict)], name_of(verdict));
    }
    return text + fmt::format("; {} contradictions, {} late, {} refuted in 237 bits, {} unknown",
                              contradictions, late, refuted, unknown);
  }
};

class Falsifier {
 public:
  Falsifier(std::string name, const Plan& plan, const Settings& settings)
      : name_(std::move(name)),
        plan_flow_(plan),
        flow_(plan_flow_.flow()),
        settings_(settings),
        flights_(plan),
        random_(Random::stream(settings.seed, 77)) {
    CertifyOptions options = settings.certify;
    options.samples = std::min<std::size_t>(200000, 20 * flow_.grid.size());
    certified_ = certify(flow_, plan_flow_.is_free, options);
  }

  Totals run() {
    fmt::print("{}: {} x {} cells, cell / radius {:.6g}, undecided {:.5f}, {} leaves\n", name_,
               flow_.grid.nx, flow_.grid.ny, flow_.grid.cell_m / flow_.vehicle.turn_radius_m,
               certified_.volume.all[0], certified_.sections.leaves());
    constexpr std::size_t batch = 20000;
    ProgressLines progress(name_);
    while (totals_.states < settings_.states &&
           progress(totals_.states, totals_.contradictions + totals_.late)) {
      std::vector<Place> states;
      for (std::size_t i = 0; i < batch / 2; ++i) states.push_back(random_state());
      remember(states, check(states));
      aim(batch / 2);
    }
    fmt::print("  {}\n", totals_.line());
    std::fflush(stdout);
    return totals_;
  }

 private:
  double degenerate_place(double free, double cell_m) {
    static constexpr std::array<double, 9> shares{0.0,   1.0,  0.5,     1e-8,         1.0 - 1e-8,
                                                  1e-15, 0.25, 0x1p-34, 1.0 - 0x1p-33};
    return random_.below(3) != 0 ? free * cell_m : shares[random_.below(shares.size())] * cell_m;
  }
  double degenerate_heading(std::size_t cell) {
    static constexpr std::array<double, 6> axes{0.0, pi / 2, pi, -pi / 2, pi / 4, -3 * pi / 4};
    static constexpr std::array<double, 7> near{0.0, 1e-16, -1e-16, 1e-8, -1e-8, 1e-12, -1e-4};
    const auto command = [&](std::size_t c) {
      const auto h = static_cast<double>(flow_.heading_rad[c]);
      return std::isnan(h) ? 0.0 : h;
    };
    const double free = random_.uniform(-pi, pi);
    double h = free;
    switch (random_.below(6)) {
      case 0:
        h = axes[random_.below(axes.size())];
        break;
      case 1:
        h = command(cell);
        break;
      case 2:
        h = command(cell) + pi;
        break;
      case 3:
        h = command(random_.below(flow_.grid.size()));
        break;
      default:
        return free;
    }
    return Heading::from_rad(h + near[random_.below(near.size())]).rad();
  }
  Place random_state() {
    const double d = flow_.grid.cell_m;
    for (;;) {
      const std::size_t cell = random_.below(flow_.grid.size());
      if (flow_.kind[cell] != CellKind::ordinary && random_.below(50) != 0) continue;
      const double x =
          flow_.grid.x0_m + d * static_cast<double>(cell % static_cast<std::size_t>(flow_.grid.nx));
      const double y =
          flow_.grid.y0_m + d * static_cast<double>(cell / static_cast<std::size_t>(flow_.grid.nx));
      if (random_.below(4) != 0) {
        return {x + d * random_.unit(), y + d * random_.unit(), random_.uniform(-pi, pi)};
      }
      return {x + degenerate_place(random_.unit(), d), y + degenerate_place(random_.unit(), d),
              degenerate_heading(cell)};
    }
  }
  Place near(const Place& s) {
    const double scale = std::exp(-12.0 * random_.unit());
    const double d = flow_.grid.cell_m;
    Place t{s.x_m + scale * d * random_.uniform(-1.0, 1.0),
            s.y_m + scale * d * random_.uniform(-1.0, 1.0),
            Heading::from_rad(s.heading_rad + scale * pi * random_.uniform(-1.0, 1.0)).rad()};
    t.x_m = std::clamp(t.x_m, flow_.grid.x0_m, flow_.grid.x0_m + flow_.grid.nx * d);
    t.y_m = std::clamp(t.y_m, flow_.grid.y0_m, flow_.grid.y0_m + flow_.grid.ny * d);
    return t;
  }

  std::vector<VerdictSet> query(const std::vector<Place>& states) const {
    const ImageStore images =
        state_images(flow_, states, settings_.certify.most_crossings, [] { return true; });
    std::vector<VerdictSet> found;
    for (std::size_t i = 0; i < states.size(); ++i) {
      found.push_back(verdicts_of(images[i], certified_.sections.view()));
    }
    return found;
  }
  std::vector<FlightRun> fly(const std::vector<Place>& states) const {
    std::vector<State> starts;
    for (const Place& s : states) {
      starts.push_back({{s.x_m, s.y_m}, Heading::from_rad(s.heading_rad)});
    }
    return flights_.run_all(starts);
  }

  struct Checked {
    std::vector<VerdictSet> verdicts;
    std::vector<FlightRun> runs;
  };

  /// Two states between which the verdict or the flight's outcome changes.
  struct Pair {
    Place a, b;
    Verdict verdict;  // of a, like the outcome
    Outcome outcome;
    bool by_verdict;
  };
  static constexpr std::size_t halvings = 44;

  /// Some states of every combination of verdict and outcome, to form pairs.
  void remember(const std::vector<Place>& states, const Checked& checked) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto verdict = static_cast<std::size_t>(checked.verdicts[i].only());
      const auto outcome = static_cast<std::size_t>(checked.runs[i].result.outcome);
      std::vector<Place>& pool = pools_[verdict * outcomes + outcome];
      if (pool.size() < 1000) {
        pool.push_back(states[i]);
      } else {
        pool[random_.below(pool.size())] = states[i];
      }
    }
  }

  /// Neighbours that differ: few when most states share one verdict.
  void add_near_pairs(std::size_t most, std::vector<Pair>& pairs) {
    std::vector<Place> a;
    std::vector<Place> b;
    for (std::size_t i = 0; i < 8 * most; ++i) {
      a.push_back(random_state());
      b.push_back(near(a.back()));
    }
    const Checked ca{query(a), fly(a)};
    const Checked cb{query(b), fly(b)};
    for (std::size_t i = 0; i < a.size() && pairs.size() < most; ++i) {
      const bool differ = ca.verdicts[i].only() != cb.verdicts[i].only();
      const Outcome outcome = ca.runs[i].result.outcome;
      if (!differ && outcome == cb.runs[i].result.outcome) continue;
      pairs.push_back({a[i], b[i], ca.verdicts[i].only(), outcome, differ && i % 2 == 0});
    }
  }

  /// Any two states that differ, wherever they are: some boundary lies between them.
  void add_far_pairs(std::size_t most, std::vector<Pair>& pairs) {
    std::vector<std::size_t> kinds;
    for (std::size_t k = 0; k < pools_.size(); ++k) {
      if (!pools_[k].empty()) kinds.push_back(k);
    }
    if (kinds.size() < 2) return;
    while (pairs.size() < most) {
      const std::size_t a = random_.below(kinds.size());
      const std::size_t b = (a + 1 + random_.below(kinds.size() - 1)) % kinds.size();
      const auto draw = [&](std::size_t k) {
        const std::vector<Place>& pool = pools_[kinds[k]];
        return pool[random_.below(pool.size())];
      };
      const bool verdicts_differ = kinds[a] / outcomes != kinds[b] / outcomes;
      const bool outcomes_differ = kinds[a] % outcomes != kinds[b] % outcomes;
      pairs.push_back({draw(a), draw(b), static_cast<Verdict>(kinds[a] / outcomes),
                       static_cast<Outcome>(kinds[a] % outcomes),
                       verdicts_differ && (!outcomes_differ || random_.below(2) == 0)});
    }
  }

  /// Bisects between the states of pairs; every midpoint is checked.
  void aim(std::size_t count) {
    std::vector<Pair> pairs;
    add_near_pairs(count / (2 * halvings), pairs);
    add_far_pairs(count / halvings, pairs);
    for (int halving = 0; halving < static_cast<int>(halvings) && !pairs.empty(); ++halving) {
      std::vector<Place> middle;
      for (const Pair& p : pairs) {
        const double turn =
            Heading::from_rad(p.a.heading_rad).turn_to(Heading::from_rad(p.b.heading_rad));
        middle.push_back({0.5 * (p.a.x_m + p.b.x_m), 0.5 * (p.a.y_m + p.b.y_m),
                          Heading::from_rad(p.a.heading_rad + 0.5 * turn).rad()});
      }
      const auto [verdicts, runs] = check(middle);
      totals_.aimed += middle.size();
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const bool like_a = pairs[i].by_verdict ? verdicts[i].only() == pairs[i].verdict
                                                : runs[i].result.outcome == pairs[i].outcome;
        (like_a ? pairs[i].a : pairs[i].b) = middle[i];
      }
    }
  }

  Checked check(const std::vector<Place>& states) {
    Checked checked{query(states), fly(states)};
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Verdict verdict = checked.verdicts[i].only();
      const FlightResult& flown = checked.runs[i].result;
      ++totals_.states;
      ++totals_.by_verdict[static_cast<std::size_t>(verdict)];
      if (verdict == Verdict::undecided) {
        ++totals_.undecided;
      } else if (static_cast<int>(verdict) != static_cast<int>(flown.outcome)) {
        judge(states[i], verdict, flown, infinite, static_cast<int>(checked.runs[i].ended_by));
      } else if (verdict == Verdict::reach &&
                 checked.verdicts[i].time_s < flown.time_s * (1.0 - 1e-9)) {
        judge(states[i], verdict, flown, checked.verdicts[i].time_s, 0);
      }
    }
    return checked;
  }

  /// In 237 bits, from every cell the state belongs to, with several draws of the choices.
  void judge(const Place& s, Verdict verdict, const FlightResult& flown, double bound_s, int by) {
    if (!commands_) commands_ = std::make_unique<WideCommands<Wide>>(flow_);
    const double d = flow_.grid.cell_m;
    bool contradicted = false;
    bool late = false;
    bool unknown = false;
    std::string ends;
    const auto fly_from = [&](int ix, int iy) {
      const WideVec<Wide> p{Wide(s.x_m) - (Wide(flow_.grid.x0_m) + Wide(ix) * Wide(d)),
                            Wide(s.y_m) - (Wide(flow_.grid.y0_m) + Wide(iy) * Wide(d))};
      const WideVec<Wide> u = wide_unit<Wide>(s.heading_rad);
      if (p.x < 0 || p.x > d || p.y < 0 || p.y > d) return;
      const CellKind kind = flow_.kind_at({ix, iy});
      ends += fmt::format(" [{},{}:{} at {:.17g},{:.17g}]", ix, iy, static_cast<int>(kind),
                          static_cast<double>(p.x / d), static_cast<double>(p.y / d));
      if (kind == CellKind::obstacle) contradicted = contradicted || verdict != Verdict::collide;
      if ((p.x == 0 && u.x < 0) || (p.x == d && u.x > 0)) return;
      if ((p.y == 0 && u.y < 0) || (p.y == d && u.y > 0)) return;
      if (kind != CellKind::ordinary) {
        contradicted = contradicted || verdict != (kind == CellKind::target     ? Verdict::reach
                                                   : kind == CellKind::obstacle ? Verdict::collide
                                                                                : Verdict::leave);
        return;
      }
      for (int draw = 0; draw < 2; ++draw) {
        Random picks(static_cast<std::uint64_t>(draw));
        WideFlight<Wide> flight(*commands_, ix, iy, p, u, [&](std::size_t n) {
          return draw == 0 ? std::size_t{0} : static_cast<std::size_t>(picks.below(n));
        });
        const auto end = flight.fly_to_end(40000);
        ends += fmt::format(" {}@{:.9g}s", name_of(end.end),
                            static_cast<double>(end.length_m) / flow_.vehicle.speed_mps);
        if (end.end == Verdict::undecided) {
          unknown = true;
        } else if (end.end != verdict) {
          contradicted = true;
        } else if (static_cast<double>(end.length_m) / flow_.vehicle.speed_mps > bound_s) {
          late = true;
        }
      }
    };
    const int cx = static_cast<int>(std::floor((s.x_m - flow_.grid.x0_m) / d));
    const int cy = static_cast<int>(std::floor((s.y_m - flow_.grid.y0_m) / d));
    for (int iy = cy - 1; iy <= cy + 1; ++iy) {
      for (int ix = cx - 1; ix <= cx + 1; ++ix) fly_from(ix, iy);
    }
    (contradicted ? totals_.contradictions
     : late       ? totals_.late
     : unknown    ? totals_.unknown
                  : totals_.refuted) += 1;
    if (++told_ <= 3 || ((contradicted || late) && told_ <= 40)) {
      fmt::print(
          "  {} {} state {:.17g},{:.17g},{:.17g}: proved {} (bound {:.9g} s), flown {} in "
          "{:.9g} s ({}); in 237 bits:{}\n",
          contradicted ? "CONTRADICTION"
          : late       ? "LATE"
          : unknown    ? "unknown"
                       : "refuted",
          name_, s.x_m, s.y_m, s.heading_rad, name_of(verdict), bound_s, name_of(flown.outcome),
          flown.time_s, by, ends);
    }
  }

  static constexpr std::size_t outcomes = outcome_codes;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  std::string name_;
  PlanFlow plan_flow_;
  Flow flow_;
  const Settings& settings_;
  ExactFlights flights_;
  Random random_;
  Certified certified_;
  std::unique_ptr<WideCommands<Wide>> commands_;
  std::array<std::vector<Place>, verdict_count * outcomes> pools_;
  Totals totals_;
  int told_ = 0;
};

Settings settings_of(int argc, char** argv) {
  Settings settings;
  settings.certify.undecided_max = 0.01;
  settings.certify.time_limit_s = 60.0;
  settings.certify.last_level = 22;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--contract" && i + 1 < argc) {
      settings.contract = argv[++i];
      continue;
    }
    if (word == "--follow" && i + 1 < argc) {
      settings.follow.emplace_back(argv[++i]);
      continue;
    }
    if (word == "--modes" && i + 1 < argc) {
      settings.modes.emplace_back(argv[++i]);
      continue;
    }
    if (word.rfind("--", 0) != 0) {
      settings.plans.push_back(word);
      continue;
    }
    if (i + 1 == argc) {
      fmt::print(stderr, "{}: expected a number after it\n", word);
      std::exit(64);
    }
    const double number = std::strtod(argv[++i], nullptr);
    const auto whole = static_cast<std::uint64_t>(number);
    if (word == "--random-plans") {
      settings.random_plans = whole;
    } else if (word == "--odd-plans") {
      settings.odd_plans = whole;
    } else if (word == "--states") {
      settings.states = whole;
    } else if (word == "--contract-plans") {
      settings.contract_plans = whole;
    } else if (word == "--contract-mode-plans") {
      settings.contract_mode_plans = whole;
    } else if (word == "--mode-plans") {
      settings.mode_plans = whole;
    } else if (word == "--hand-overs") {
      settings.hand_overs = whole;
    } else if (word == "--flights") {
      settings.flights = whole;
    } else if (word == "--parts") {
      settings.parts = static_cast<int>(whole);
    } else if (word == "--seed") {
      settings.seed = whole;
    } else if (word == "--undecided-max") {
      settings.certify.undecided_max = number;
    } else if (word == "--time-limit") {
      settings.certify.time_limit_s = number;
    } else if (word == "--last-level") {
      settings.certify.last_level = static_cast<int>(number);
    } else {
      fmt::print(stderr, "{}: unknown option\n", word);
      std::exit(64);
    }
  }
  return settings;
}

/// How many certificates of odd plans the checker refuses.
std::size_t refused_odd_plans(const Settings& settings) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     fmt::format("fairway-falsify-{}.safetensors", ::getpid());
  std::size_t refused = 0;
  for (std::uint64_t k = 0; k < settings.odd_plans && !is_interrupted(); ++k) {
    const std::uint64_t number = 1000003 * settings.seed + k;
    CertifyOptions options = settings.certify;
    options.samples = k % 2 == 0 ? 1 : 20000;
    options.seed = number;
    options.last_level = std::min(options.last_level, 4 + static_cast<int>(k % 6));
    std::string why;
    try {
      fairway_check::write_sample(odd_plan(number), file, options);
      nlohmann::ordered_json report;
      why = fairway_check::judge(file, "", 20000, report);
    } catch (const std::exception& error) {
      why = error.what();
    }
    if (why.empty()) continue;
    ++refused;
    fmt::print("REFUSED odd plan {}: {}\n", number, why);
  }
  std::filesystem::remove(file);
  if (settings.odd_plans > 0) fmt::print("{} odd plans, {} refused\n", settings.odd_plans, refused);
  return refused;
}

/// How many flights contradict that a path is followed.
std::uint64_t contradicted_following(const Settings& settings) {
  std::uint64_t wrong = 0;
  for (const std::string& path : settings.follow) {
    const FollowAttackTotals totals = attack_following(
        read_contract_certificate(path), settings.flights, settings.seed, ProgressLines(path));
    for (const std::string& story : totals.stories) fmt::print("  {}\n", story);
    fmt::print("{}: {}\n", path, totals.line());
    wrong += totals.wrong();
  }
  return wrong;
}

ModeAttackTotals attack_proof(const std::string& name, const ProofView& proof, std::uint64_t states,
                              const Settings& settings) {
  ModeAttackOptions options;
  options.hand_overs = settings.hand_overs;
  options.states = states;
  options.seed = settings.seed;
  options.progress = ProgressLines(name);
  const auto begun = std::chrono::steady_clock::now();
  const ModeAttackTotals totals = attack_modes(proof, options);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  fmt::print("{}: {} x {} cells, {} modes, {:.1f} s\n", name, proof.flow.grid.nx,
             proof.flow.grid.ny, proof.modes(), wall_s);
  for (const std::string& story : totals.stories) fmt::print("  {}\n", story);
  fmt::print("  {}\n", totals.line());
  std::fflush(stdout);
  return totals;
}

/// Certifies a plan with its modes, and attacks that. `states`: the most asked about; 0: no limit.
ModeAttackTotals attack_plan_with_modes(const std::string& name, const Plan& plan,
                                        std::uint64_t states, const Settings& settings) {
  const PlanFlow held(plan);
  CertifyOptions options = settings.certify;
  options.samples = std::min<std::size_t>(200000, 20 * plan.grid.size());
  const Certified certified =
      certify(held.flow(), held.is_free, options, {}, {}, plan.further_rad());
  const ProofView proof{held.flow(), certified.sections.view(),
                        static_cast<int>(plan.further_modes()), plan.mode_heading_rad.data(),
                        certified.further.view()};
  return attack_proof(name, proof, states, settings);
}

/// A random plan with random modes: fields of its own styles, and fields that go on in a direction.
Plan random_plan_with_modes(std::uint64_t number) {
  Plan plan = random_plan(number);
  Random random = Random::stream(0x30de5, number);
  const std::uint64_t further = 1 + random.below(5);
  for (std::uint64_t k = 0; k < further; ++k) {
    std::vector<float> field(plan.grid.size());
    if (random.below(3) == 0) {
      field =
          direction_field(plan.grid, plan.region, random.uniform(-pi, pi), 2.0 * plan.grid.cell_m);
    } else {
      const auto style = static_cast<FieldStyle>(random.below(field_styles));
      const double twist = random.uniform(-pi, pi);
      const Vec2 goal{random.uniform(0.0, plan.grid.nx), random.uniform(0.0, plan.grid.ny)};
      for (std::size_t i = 0; i < field.size(); ++i) {
        const Cell c = plan.grid.cell_at(i);
        field[i] =
            Heading::stored(sample_heading(style, random, {c.ix + 0.5, c.iy + 0.5}, goal, twist));
      }
    }
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
  }
  return plan;
}

/// How many flights contradict what is proved of modes.
std::uint64_t contradicted_modes(const Settings& settings) {
  ModeAttackTotals totals;
  for (const std::string& path : settings.modes) {
    const Certificate certificate = read_certificate(path);
    if (certificate.further_modes() == 0) {
      fmt::print(stderr, "{}: its plan has one mode, expected several\n", path);
      std::exit(64);
    }
    totals.add(attack_proof(path, certificate.view(), 0, settings));
  }
  for (const std::string& path : settings.plans) {
    const Plan plan = read_plan(path);
    if (plan.further_modes() > 0) totals.add(attack_plan_with_modes(path, plan, 0, settings));
  }
  for (std::uint64_t k = 0; k < settings.mode_plans && !is_interrupted(); ++k) {
    const std::uint64_t number = 1000003 * settings.seed + k;
    totals.add(attack_plan_with_modes(fmt::format("random plan {} with modes", number),
                                      random_plan_with_modes(number), settings.states, settings));
  }
  if (totals.states > 0) fmt::print("with modes, in all: {}\n", totals.line());
  return totals.wrong();
}

int falsify(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  note_interrupts();
  if (!settings.follow.empty()) return contradicted_following(settings) == 0 ? 0 : 1;
  if (!settings.contract.empty() || settings.contract_plans + settings.contract_mode_plans > 0) {
    ContractRuns runs;
    runs.plans = settings.plans;
    runs.contract = settings.contract;
    runs.random_plans = settings.contract_plans;
    runs.random_plans_with_modes = settings.contract_mode_plans;
    runs.flights = settings.flights;
    runs.seed = settings.seed;
    runs.parts = settings.parts;
    runs.time_limit_s = settings.certify.time_limit_s;
    return contradicted_contracts(runs) == 0 ? 0 : 1;
  }
  Totals totals;
  for (const std::string& path : settings.plans) {
    totals.add(Falsifier(path, read_plan(path), settings).run());
  }
  for (std::uint64_t k = 0; k < settings.random_plans && !is_interrupted(); ++k) {
    const std::uint64_t number = 1000003 * settings.seed + k;
    const Plan plan = random_plan(number);
    totals.add(Falsifier(fmt::format("random plan {}", number), plan, settings).run());
  }
  const std::size_t refused = refused_odd_plans(settings);
  if (totals.states > 0) fmt::print("in all: {}\n", totals.line());
  const std::uint64_t with_modes = contradicted_modes(settings);
  return totals.contradictions + totals.late + refused + with_modes == 0 ? 0 : 1;
}

}  // namespace
}  // namespace fairway

int main(int argc, char** argv) { return fairway::falsify(argc, argv); }
