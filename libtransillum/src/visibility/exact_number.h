// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// For the few files that compute in exact numbers: this draws in CGAL.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Fraction_traits.h>

#include <utility>

#include "visibility/map_number.h"

namespace transillum {

/// A rational number whose sign is mostly told by an interval: a CGAL lazy number. It remembers
/// how it was made, so what others are built on must be settled, or histories grow without end
/// and their evaluation overflows the stack. None may pass from one thread to another.
using ExactReal = CGAL::Epeck::FT;

/// A sum of exact areas, m²: an integer multiple of 2^-1200, which is finer than any double. A sum
/// of fractions would have all their denominators multiplied together.
class ExactArea {
 public:
  using Rational = ExactReal::ET;
  using Integer = CGAL::Fraction_traits<Rational>::Numerator_type;

  ExactArea() = default;
  explicit ExactArea(const Rational& area);

  ExactArea& operator+=(const ExactArea& other) {
    units_ += other.units_;
    return *this;
  }
  friend ExactArea operator-(const ExactArea& a, const ExactArea& b) {
    ExactArea difference;
    difference.units_ = a.units_ - b.units_;
    return difference;
  }
  friend bool operator==(const ExactArea& a, const ExactArea& b) { return a.units_ == b.units_; }
  /// The double nearest to it.
  friend double nearest_double(const ExactArea& area);

 private:
  Integer units_ = 0;
};

template <>
struct MapNumber<ExactReal> {
  using Area = ExactArea;

  static ExactReal settled(const ExactReal& number) {
    number.exact();
    return number;
  }
  static ExactArea area(const ExactReal& number) { return ExactArea(number.exact()); }
  static std::pair<double, double> around(const ExactReal& number) {
    return CGAL::to_interval(number);
  }
};

}  // namespace transillum
