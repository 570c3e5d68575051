// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/plane/exact_number.h"

namespace transillum {
namespace {

CGAL::Gmpz in_units(CGAL::Gmpz number) {
  constexpr unsigned long unit_bits = 1200;
  number <<= unit_bits;
  return number;
}

}  // namespace

ExactArea::ExactArea(const Rational& area)
    : units_(in_units(area.numerator()) / area.denominator()) {}

double nearest_double(const ExactArea& area) {
  const Rational exact(area.units_, in_units(1));
  // The interval holds one or two doubles.
  const auto [low, high] = CGAL::to_interval(exact);
  return exact - Rational(low) <= Rational(high) - exact ? low : high;
}

}  // namespace transillum
