// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "scene/built_in/scene_maker.h"
#include "scene/built_in/scene_parameters.h"

namespace transillum {

// The built-in scenes, in meters. Each is closed: from the lit side of any face, every ray hits a
// face.

void make_sphere_flake(SceneMaker& maker, const ParameterValues& values,
                       const Cancellation& cancellation);
void make_cornell_box(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_furnace(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_flatland(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_boards(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_rooms(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_gallery(SceneMaker& maker, const ParameterValues& values, const Cancellation&);
void make_stars(SceneMaker& maker, const ParameterValues& values, const Cancellation&);

}  // namespace transillum
