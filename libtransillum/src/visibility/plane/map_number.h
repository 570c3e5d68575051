// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <utility>

namespace transillum {

/// Number type of the local visibility map. The projection of a patch at 1e-6 of its area is a
/// needle whose width has a relative precision of 1e-10 only with more than a double's 53 bits;
/// x86's 64 bits suffice at little cost (decisions/0003-extended-precision.md).
using Real = long double;

/// The functions that the maps require of a number type besides arithmetic and signs; also
/// specialized for
/// Rational (decisions/0008-exact-numbers.md).
template <class Number>
struct MapNumber;

template <>
struct MapNumber<Real> {
  using Area = double;  ///< type of sums of areas

  using Moment = Real;  ///< type in which basis functions are integrated

  static Area area(Real number) { return static_cast<double>(number); }
  static Moment moment(Real number) { return number; }
  /// Bounds of the number, up to rounding.
  static std::pair<double, double> around(Real number) {
    return {static_cast<double>(number), static_cast<double>(number)};
  }
};

/// The double nearest to an area.
inline double nearest_double(double area) { return area; }

}  // namespace transillum
