// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum {

/// Lowers the channels that ReadOptions::max_reflectance does not allow.
/// @return the value that they were lowered to; 0 if none was
double lower_reflectance(Rgb& reflectance, const ReadOptions& options);

}  // namespace transillum
