// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The module transillum._core: what the Python package `transillum` is written on.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "transillum/transillum.h"

namespace py = pybind11;

namespace {

constexpr const char* pybind11_version =
    PYBIND11_TOSTRING(PYBIND11_VERSION_MAJOR) "." PYBIND11_TOSTRING(PYBIND11_VERSION_MINOR);

/// Before 2.12, pybind11 reads arrays of NumPy 2 wrongly and without an error.
void check_numpy() {
  constexpr bool reads_numpy_2 =
      PYBIND11_VERSION_MAJOR > 2 || (PYBIND11_VERSION_MAJOR == 2 && PYBIND11_VERSION_MINOR >= 12);
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (!reads_numpy_2 && std::stoi(version) >= 2) {
    throw py::import_error(std::string("transillum was built with pybind11 ") + pybind11_version +
                           ", which reads NumPy " + version +
                           " wrongly: use NumPy 1, or build it with pybind11 2.12 or later");
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  using namespace transillum;
  check_numpy();
  module.attr("pybind11_version") = pybind11_version;
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
