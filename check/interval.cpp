#include "check/interval.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <mpfr.h>

namespace fairway_check {
namespace {

/// Operations whose exact results lie strictly between two doubles.
void require_outward_rounding() {
  const volatile double unfolded[3]{1.0, 3.0, 0x1p-80};  // that no compiler can compute in advance
  const double one = unfolded[0];
  const double three = unfolded[1];
  const double tiny = unfolded[2];
  const auto is_around = [](const Real& a, double low, double high) {
    return a.lower() == low && a.upper() == high;
  };
  const double next = std::nextafter(1.0, 2.0);
  const Real third = Real(one) / Real(three);
  const Real product = third * Real(three);
  const Real two_root = root(Real(one + one));
  const bool right =
      std::fegetround() == FE_UPWARD && is_around(Real(one) + Real(tiny), 1.0, next) &&
      is_around(Real(-one) - Real(tiny), -next, -1.0) &&
      is_around(Real(next) * Real(next), 1.0 + 0x1p-51, 1.0 + 0x1.8p-51) &&
      third.lower() < third.upper() && std::nextafter(third.lower(), 1.0) == third.upper() &&
      product.lower() < 1.0 && product.upper() >= 1.0 && two_root.lower() < two_root.upper() &&
      (Real(two_root.lower()) * Real(two_root.lower())).upper() <= 2.0 &&
      (Real(two_root.upper()) * Real(two_root.upper())).lower() >= 2.0;
  if (!right) throw std::runtime_error("the processor does not honour the rounding mode");
}

}  // namespace

Upwards::Upwards() : before_(std::fegetround()) {
  if (std::fesetround(FE_UPWARD) != 0) throw std::runtime_error("the rounding mode cannot be set");
  require_outward_rounding();
}
Upwards::~Upwards() { std::fesetround(before_); }

Real root(const Real& a) {
  const double high = a.upper() > 0.0 ? std::sqrt(a.upper()) : 0.0;
  if (a.lower() <= 0.0) return {0.0, high};
  const double low_root = Rounding::force_rounding(std::sqrt(a.lower()));
  return {-Rounding::force_rounding(a.lower() / -low_root), high};
}

Vec unit_vector(double angle_rad) {
  MPFR_DECL_INIT(angle, 53);
  MPFR_DECL_INIT(sine, 53);
  MPFR_DECL_INIT(cosine, 53);
  mpfr_set_d(angle, angle_rad, MPFR_RNDN);  // exact: a double has 53 bits
  const bool exact = mpfr_sin_cos(sine, cosine, angle, MPFR_RNDD) == 0;
  const auto around = [exact](double low) {
    return Real(low, exact ? low : std::nextafter(low, std::numeric_limits<double>::infinity()));
  };
  return {around(mpfr_get_d(cosine, MPFR_RNDD)), around(mpfr_get_d(sine, MPFR_RNDD))};
}

}  // namespace fairway_check
