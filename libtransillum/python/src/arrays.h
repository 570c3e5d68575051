// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <pybind11/numpy.h>

#include <cstring>
#include <string>
#include <vector>

#include "transillum/transillum.h"

namespace transillum::python {

namespace py = pybind11;

/// An array of numbers as Python passes it: converted where its type differs.
template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// A copy as an array (n,).
template <class T>
py::array_t<T> to_array(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A copy as an array (n, 3) or (n, 2): of a struct of doubles.
template <int columns, class T>
py::array_t<double> to_table(const std::vector<T>& values) {
  static_assert(sizeof(T) == columns * sizeof(double));
  py::array_t<double> table({static_cast<py::ssize_t>(values.size()), py::ssize_t{columns}});
  if (!values.empty()) {
    std::memcpy(table.mutable_data(), values.data(), values.size() * sizeof(T));
  }
  return table;
}

inline py::tuple to_tuple(const Vec3& v) { return py::make_tuple(v.x, v.y, v.z); }
inline py::tuple to_tuple(const Rgb& c) { return py::make_tuple(c.r, c.g, c.b); }

/// A direction or point as three numbers, in one row.
/// @throws InputError
inline Vec3 to_vec3(const py::handle& value, const std::string& name) {
  const auto array = Array<double>::ensure(value);
  if (!array || array.ndim() != 1 || array.size() != 3) {
    PyErr_Clear();
    throw InputError(name + ": expected three numbers");
  }
  return {array.data()[0], array.data()[1], array.data()[2]};
}

/// The unit vector along three numbers.
/// @throws InputError
inline Vec3 to_direction(const py::handle& value, const std::string& name) {
  const Vec3 direction = to_vec3(value, name);
  if (!is_finite(direction) || max_abs(direction) == 0) {
    throw InputError(name + ": expected three finite numbers, not all 0");
  }
  return unit_vector(direction);
}

}  // namespace transillum::python
