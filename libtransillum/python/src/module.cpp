// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The module transillum._core: what the Python package `transillum` is written on.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "transillum/transillum.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  using namespace transillum;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  module.attr("__version__") = TRANSILLUM_VERSION;
  module.def("options", &python::option_list);
  module.def("built_in_scenes", [] {
    py::list list;
    for (const BuiltInScene& scene : built_in_scenes()) {
      list.append(py::make_tuple(scene.name, scene.summary, scene.parameters));
    }
    return list;
  });
  python::bind_scene(module);
  python::bind_solve(module);
  python::bind_visibility(module);
}
