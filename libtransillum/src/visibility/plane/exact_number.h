// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Exact numbers. Includes CGAL, so only the few files that compute with them should include this.
#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>

#include <utility>

#include "visibility/plane/map_number.h"

namespace transillum {

/// Rational number of the exact maps, always in lowest terms. Copies share their digits without
/// synchronization: each number must stay in one thread.
using Rational = CGAL::Gmpq;

/// From now on GMP throws std::bad_alloc where it would end the program: when there is no memory.
/// Call it before numbers are computed in other threads; again it does nothing.
void let_exact_numbers_throw();

/// A sum of exact areas, m²: an integer multiple of 2^-1200, which is finer than any double. (The
/// denominator of a sum of fractions would be the product of theirs.)
class ExactArea {
 public:
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
  /// The nearest double.
  friend double nearest_double(const ExactArea& area);

 private:
  CGAL::Gmpz units_;
};

template <>
struct MapNumber<Rational> {
  using Area = ExactArea;
  using Moment = double;

  static Moment moment(const Rational& number) { return CGAL::to_double(number); }
  static Area area(const Rational& number) { return ExactArea(number); }
  static std::pair<double, double> around(const Rational& number) {
    return CGAL::to_interval(number);
  }
};

}  // namespace transillum
