// For tests: records what is reported for a followed set, and compares exact flights with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/section_flight.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway {

/// A visitor that remembers.
struct Told {
  struct Arrival {
    std::size_t section;
    Interval along_m;
    double length_m;
    bool hop;
  };
  struct End {
    Verdict verdict;
    double length_m;
  };
  std::vector<Arrival> arrivals;
  std::vector<End> ends;
  bool gave_up = false;

  void arrive(std::size_t section, Interval along_m, double length_m, bool hop) {
    arrivals.push_back({section, along_m, length_m, hop});
  }
  void end(Verdict verdict, double length_m) { ends.push_back({verdict, length_m}); }
  void give_up() { gave_up = true; }

  bool nothing() const { return arrivals.empty() && ends.empty() && !gave_up; }

  /// Whether an exact flight met one of the things reported, within its length.
  bool has(const WideMeeting<Wide>& met) const {
    const auto long_enough = [&](double length_m) {
      return met.length_m <= static_cast<long double>(length_m) * (1 + 1e-15L) + 1e-20L;
    };
    if (met.section == WideMeeting<Wide>::none) {
      for (const End& end : ends) {
        if (end.verdict != met.end) continue;
        if (end.verdict == Verdict::trapped || long_enough(end.length_m)) return true;
      }
      return false;
    }
    const Wide own(1e-30);
    for (const Arrival& a : arrivals) {
      if (a.section == met.section && Wide(a.along_m.lo) - own <= met.along_m &&
          met.along_m <= Wide(a.along_m.hi) + own && long_enough(a.length_m)) {
        return true;
      }
    }
    return false;
  }

  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    for (const Arrival& a : arrivals) {
      out << "\n  told: section " << a.section << " [" << a.along_m.lo << ", " << a.along_m.hi
          << "] after " << a.length_m << (a.hop ? " hop" : "");
    }
    for (const End& e : ends) out << "\n  told: " << name_of(e.verdict) << " after " << e.length_m;
    return out.str();
  }
};

inline std::string text_of(const WideMeeting<Wide>& met) {
  std::ostringstream out;
  out.precision(20);
  if (met.section == WideMeeting<Wide>::none) {
    out << name_of(met.end);
  } else {
    out << "section " << met.section << " at " << met.along_m;
  }
  out << " after " << met.length_m << " and " << met.crossings << " crossings";
  return out.str();
}

}  // namespace fairway
