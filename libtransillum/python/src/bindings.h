// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <pybind11/pybind11.h>

// Parts of the module `transillum._core`.
namespace transillum::python {

void bind_scene(pybind11::module_& module);
void bind_solve(pybind11::module_& module);
void bind_visibility(pybind11::module_& module);

}  // namespace transillum::python
