#include "check/proof.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <numbers>
#include <random>
#include <thread>

#include <fmt/format.h>

namespace fairway_check {
namespace {

/// Calls `body(chunk)` for every chunk once, on some thread.
void for_chunks(std::size_t chunks, int threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex guard;
  const auto work = [&] {
    try {
      for (std::size_t chunk = next++; chunk < chunks; chunk = next++) body(chunk);
    } catch (...) {
      const std::scoped_lock lock(guard);
      error = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

/// What is claimed of the places a flight arrives at.
class Arrivals : public Listener {
 public:
  explicit Arrivals(const Certificate& c)
      : c_(c), seconds_per_cell_((Real(c.cell_m) / c.speed_mps).upper()) {}

 protected:
  double seconds(double length) const { return (Real(length) * seconds_per_cell_).upper(); }

  /// Calls `body(leaf)` for every leaf that `place` touches; false when the section has none.
  template <typename Body>
  bool for_leaves(std::size_t section, const Real& place, const Body& body) const {
    const std::uint32_t* const low = c_.begin.data() + c_.first[section];
    const std::uint32_t* const high = c_.begin.data() + c_.first[section + 1];
    if (low == high) return false;
    // Places run upwards and to the right; in the frames of top and left the other way round.
    const bool backwards = section % 4 == 1 || section % 4 == 2;
    const Real along = (0.5 + (backwards ? -place : place)) * 0x1p32;
    const std::uint32_t* leaf = std::lower_bound(low, high, along.lower());
    if (leaf != low) --leaf;  // reaches up to the place, or ends there
    for (; leaf != high && !(*leaf > along.upper()); ++leaf) {
      body(static_cast<std::size_t>(leaf - c_.begin.data()));
    }
    return true;
  }

  const Certificate& c_;

 private:
  double seconds_per_cell_;
};

/// The rule for one leaf.
class LeafRule : public Arrivals {
 public:
  LeafRule(const Certificate& c, std::size_t section, std::size_t leaf)
      : Arrivals(c),
        section_(section),
        leaf_(leaf),
        verdict_(static_cast<Verdict>(c.verdict[leaf])) {}

  std::string judge() {
    const double begin = c_.begin[leaf_];
    const double end = c_.end_of(section_, leaf_);
    const bool backwards = section_ % 4 == 1 || section_ % 4 == 2;
    const Real along = Real(begin, end) * 0x1p-32 - 0.5;  // exact
    // Lemma 5: a hop moves every state on by 4 R sin n, n the angle of the heading to the side.
    const Vec heading = into_frame(static_cast<int>(section_ % 4), c_.loop.direction[section_ / 4]);
    least_hop_ = (4.0 * c_.loop.radius * heading.x * 0x1p32).lower();
    hops_one_way_ = least_hop_ > 0.0 && (positive(heading.y) || negative(heading.y));
    follow_section(c_.loop, section_, backwards ? -along : along, *this);
    if (!defect_.empty()) return defect_;
    if (!told_) return "nothing was told of its states";
    if (verdict_ == trapped) return {};
    if (hop_s_ > 0.0) {
      const double hops = std::floor((Real(end - begin) / least_hop_).upper());
      worst_s_ = (worst_s_ + Real(hops) * hop_s_).upper();
    }
    return worst_s_ <= static_cast<double>(c_.time_s[leaf_])
               ? ""
               : fmt::format("takes up to {:.9g} s, but {:.9g} s are claimed", worst_s_,
                             c_.time_s[leaf_]);
  }

  void arrive(std::size_t section, const Real& place, double length, bool hop) override {
    told_ = true;
    const double flown_s = seconds(length);
    const bool any = for_leaves(section, place, [&](std::size_t other) {
      if (hop && hops_one_way_ && other == leaf_) {
        hop_s_ = std::max(hop_s_, flown_s);
      } else if (c_.verdict[other] != verdict_) {
        object("{}, is {}", other, section, verdict_name[c_.verdict[other]]);
      } else if (verdict_ != trapped && c_.rank[other] >= c_.rank[leaf_]) {
        object("{}, has rank {}, which is not lower", other, section, c_.rank[other]);
      } else {
        worst_s_ =
            std::max(worst_s_, (Real(flown_s) + static_cast<double>(c_.time_s[other])).upper());
      }
    });
    if (!any) object("it may come to section {}, of which nothing is claimed", section);
  }
  void end(Verdict verdict, double length) override {
    told_ = true;
    worst_s_ = std::max(worst_s_, seconds(length));
    if (verdict != verdict_) object("some of its states may end with {}", verdict_name[verdict]);
  }
  void give_up() override { object("its states are too many ways to follow"); }

 private:
  template <typename What>
  void object(const char* words, std::size_t other, std::size_t section, const What& what) {
    if (defect_.empty()) {
      defect_ =
          "it may come to " + fmt::format(fmt::runtime(words), c_.name_of(section, other), what);
    }
  }
  template <typename... What>
  void object(const char* words, const What&... what) {
    if (defect_.empty()) defect_ = fmt::format(fmt::runtime(words), what...);
  }

  std::size_t section_;
  std::size_t leaf_;
  Verdict verdict_;
  double least_hop_ = 0.0;
  bool hops_one_way_ = false;
  bool told_ = false;
  double hop_s_ = 0.0;    // of one hop that may come down on the leaf itself
  double worst_s_ = 0.0;  // from the last state on the leaf
  std::string defect_;
};

/// The verdict of a state, as a query gives it.
class StateVerdict : public Arrivals {
 public:
  using Arrivals::Arrivals;

  void arrive(std::size_t section, const Real& place, double length, bool) override {
    const double flown_s = seconds(length);
    const bool any = for_leaves(section, place, [&](std::size_t leaf) {
      add(c_.verdict[leaf], (Real(flown_s) + static_cast<double>(c_.time_s[leaf])).upper());
    });
    if (!any) add(undecided, 0.0);
  }
  void end(Verdict verdict, double length) override { add(verdict, seconds(length)); }
  void give_up() override { add(undecided, 0.0); }

  std::uint8_t verdict() const { return verdict_; }
  double time_s() const { return time_s_; }

 private:
  void add(std::uint8_t verdict, double time_s) {
    if (!none_ && verdict != verdict_) verdict = undecided;
    verdict_ = verdict;
    none_ = false;
    time_s_ = std::max(time_s_, time_s);
  }

  bool none_ = true;
  std::uint8_t verdict_ = undecided;
  double time_s_ = 0.0;
};

}  // namespace

void take_directions(Certificate& c, int threads) {
  constexpr std::size_t chunk = 1024;
  c.loop.direction.assign(c.cells(), {Real(0.0), Real(0.0)});
  for_chunks(c.cells() / chunk + 1, threads, [&](std::size_t k) {
    for (std::size_t i = k * chunk; i < std::min(c.cells(), (k + 1) * chunk); ++i) {
      if (c.kind[i] != ordinary || std::isnan(c.command_rad[i])) continue;
      c.loop.direction[i] = unit_vector(static_cast<double>(c.command_rad[i]));
    }
  });
  const Upwards upwards;
  c.loop.radius = Real(c.turn_radius_m) / c.cell_m;
  if (!(c.loop.radius.lower() > 1.0))
    throw Refused("geometry: the cells are as large as the turns");
}

std::string defect_of(const Certificate& c, std::size_t section, std::size_t leaf) {
  return c.verdict[leaf] == undecided ? "" : LeafRule(c, section, leaf).judge();
}

std::vector<Failure> failures(const Certificate& c, int threads) {
  constexpr std::size_t chunk = 512;
  const std::size_t sections = c.first.size() - 1;
  std::vector<std::vector<Failure>> found(sections / chunk + 1);
  for_chunks(found.size(), threads, [&](std::size_t k) {
    const Upwards upwards;
    for (std::size_t s = k * chunk; s < std::min(sections, (k + 1) * chunk); ++s) {
      for (std::size_t leaf = c.first[s]; leaf < c.first[s + 1]; ++leaf) {
        std::string defect = defect_of(c, s, leaf);
        if (!defect.empty()) found[k].push_back({s, leaf, std::move(defect)});
      }
    }
  });
  std::vector<Failure> all;
  for (std::vector<Failure>& some : found)
    std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

Measured measure(const Certificate& c, std::size_t samples, std::uint64_t seed, int threads) {
  Measured measured;
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < c.cells(); ++i) {
    if (c.kind[i] == ordinary) cells.push_back(i);
  }
  if (cells.empty()) return measured;
  constexpr std::size_t chunk = 256;
  std::vector<Measured> parts(samples / chunk + 1);
  for_chunks(parts.size(), threads, [&](std::size_t k) {
    std::mt19937_64 random(seed + k);
    const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    Measured& part = parts[k];
    for (std::size_t i = k * chunk; i < std::min(samples, (k + 1) * chunk); ++i) {
      const std::size_t cell = cells[random() % cells.size()];
      const double x = unit() - 0.5;
      const double y = unit() - 0.5;
      const Vec heading = unit_vector(std::numbers::pi * (2.0 * unit() - 1.0));
      const Upwards upwards;
      StateVerdict state(c);
      const std::size_t nx = static_cast<std::size_t>(c.loop.nx);
      follow_states(c.loop, static_cast<int>(cell % nx), static_cast<int>(cell / nx),
                    {Real(x), Real(y)}, heading, state);
      const std::uint8_t verdict = state.verdict();
      const bool is_free = c.region[cell] == 0;
      ++part.states;
      part.free_states += is_free ? 1 : 0;
      part.all[verdict] += 1.0;
      (is_free ? part.free : part.buffer)[verdict] += 1.0;
      part.slower_than_claimed += verdict == reach && state.time_s() > c.worst_time_s ? 1 : 0;
    }
  });
  for (const Measured& part : parts) {
    measured.states += part.states;
    measured.free_states += part.free_states;
    measured.slower_than_claimed += part.slower_than_claimed;
    for (std::size_t v = 0; v < verdict_count; ++v) {
      measured.all[v] += part.all[v];
      measured.free[v] += part.free[v];
      measured.buffer[v] += part.buffer[v];
    }
  }
  const auto divide = [](Shares& counts, std::size_t of) {
    for (double& count : counts) count /= of == 0 ? 1.0 : static_cast<double>(of);
  };
  divide(measured.all, measured.states);
  divide(measured.free, measured.free_states);
  divide(measured.buffer, measured.states - measured.free_states);
  return measured;
}

std::string defect_of_claims(const Certificate& c, const Measured& m) {
  const double of_free =
      m.states == 0 ? 0.0 : static_cast<double>(m.free_states) / static_cast<double>(m.states);
  const auto compare = [&](const char* name, const Shares& claimed, const Shares& found,
                           double portion) -> std::string {
    const double here = portion * static_cast<double>(m.states);
    const double there = portion * c.samples;
    if (here < 100.0 || there < 1.0) return {};
    for (std::size_t v = 0; v < verdict_count; ++v) {
      const double p = (claimed[v] * there + found[v] * here) / (there + here);
      const double error = std::sqrt(p * (1.0 - p) * (1.0 / here + 1.0 / there));
      // A share that is almost none is not known better than to a few states.
      if (std::abs(claimed[v] - found[v]) <= 5.0 * error + 5.0 / here) continue;
      return fmt::format(
          "{}: {} is claimed to be {:.6f}, measured {:.6f} +- {:.6f} on {:.0f} states", name,
          verdict_name[v], claimed[v], found[v], error, here);
    }
    return {};
  };
  std::string defect = compare("volume_fraction", c.all, m.all, 1.0);
  if (defect.empty()) defect = compare("volume_fraction_free", c.free, m.free, of_free);
  if (defect.empty()) defect = compare("volume_fraction_buffer", c.buffer, m.buffer, 1.0 - of_free);
  // Of so many more states than here none was slower: hardly a handful can be.
  if (defect.empty() && m.slower_than_claimed > 5 + m.states / 1000) {
    defect = fmt::format("worst_time_s: {} of {} sampled states are slower", m.slower_than_claimed,
                         m.states);
  }
  return defect;
}

}  // namespace fairway_check
