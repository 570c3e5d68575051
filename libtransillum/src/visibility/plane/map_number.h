// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <utility>

namespace transillum {

/// The number of the local visibility map. A patch seen at 1e-6 of its area is a needle whose
/// width takes 1e-10 of itself only with more than a double's 53 bits; x86's 64 bits are enough
/// and cost little here (decisions/0003-extended-precision.md).
using Real = long double;

/// What the maps ask of a number besides arithmetic and signs; Rational has one too
/// (decisions/0008-exact-numbers.md).
template <class Number>
struct MapNumber;

template <>
struct MapNumber<Real> {
  using Area = double;  ///< what areas are summed in

  static Area area(Real number) { return static_cast<double>(number); }
  /// Two doubles with the number between them, but for a rounding.
  static std::pair<double, double> around(Real number) {
    return {static_cast<double>(number), static_cast<double>(number)};
  }
};

/// The double next to an area.
inline double nearest_double(double area) { return area; }

}  // namespace transillum
