// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

/// Sum of the channels.
inline double sum(const Rgb& c) { return c.r + c.g + c.b; }
/// Square of the length of a color as a vector of its channels.
inline double sum_of_squares(const Rgb& c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

}  // namespace transillum
