// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

class Picker;

/// Whether backs of faces surround a point: most rays from it meet one first.
bool is_inside_solid(const Picker& picker, const Vec3& eye);

}  // namespace transillum
