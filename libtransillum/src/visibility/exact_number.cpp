// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/exact_number.h"

#include <cmath>

namespace transillum {
namespace {

using Fraction = CGAL::Fraction_traits<ExactArea::Rational>;

/// 2^1200.
const ExactArea::Integer& units_of_one() {
  static const ExactArea::Integer units = [] {
    ExactArea::Integer power = 1;
    for (int k = 0; k < 40; ++k) power *= 1 << 30;
    return power;
  }();
  return units;
}

}  // namespace

ExactArea::ExactArea(const Rational& area) {
  Integer numerator, denominator;
  Fraction::Decompose()(area, numerator, denominator);
  units_ = numerator * units_of_one() / denominator;
}

double nearest_double(const ExactArea& area) {
  const ExactArea::Rational exact = Fraction::Compose()(area.units_, units_of_one());
  const auto error = [&exact](double candidate) {
    const ExactArea::Rational difference = exact - ExactArea::Rational(candidate);
    return difference < 0 ? ExactArea::Rational(-difference) : difference;
  };
  // The interval holds one or two doubles.
  const auto [low, high] = CGAL::to_interval(exact);
  return error(low) <= error(high) ? low : high;
}

}  // namespace transillum
