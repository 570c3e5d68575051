// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum {

/// part / whole; 0 where `whole` is not above 0.
inline double ratio_or_zero(double part, double whole) { return whole > 0 ? part / whole : 0.0; }

}  // namespace transillum
