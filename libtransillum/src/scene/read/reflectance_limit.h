// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "scene/build/warnings.h"
#include "transillum/scene.h"

namespace transillum {

/// Lowers the channels that ReadOptions::max_reflectance does not allow.
/// @return the value that they were lowered to; 0 if none was
double lower_reflectance(Rgb& reflectance, const ReadOptions& options);

/// The same, with a warning if any was lowered. `place` begins it, as "a.ply: face 3: ".
void lower_reflectance(Rgb& reflectance, const ReadOptions& options, const std::string& place,
                       Warnings& notes);

}  // namespace transillum
