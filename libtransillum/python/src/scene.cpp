// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <tuple>

#include "arrays.h"
#include "bindings.h"
#include "interrupt.h"

namespace transillum::python {
namespace {

/// pybind11 knows no shared pointer to const.
using ScenePtr = std::shared_ptr<Scene>;
/// Whether faces are two-sided; max_patch_area; patches, 0: not asked for.
using Division = std::tuple<bool, double, std::int64_t>;
/// scale, join, default_reflectance
using Reading = std::tuple<double, std::optional<bool>, double>;

ScenePtr make_scene(const SceneDescription& description, const Division& division,
                    const Cancellation& cancellation) {
  const auto& [two_sided, max_patch_area, patches] = division;
  if (patches != 0 && max_patch_area != 0) {
    throw InputError("patches and max_patch_area exclude each other");
  }
  SceneOptions options;
  options.two_sided = two_sided;
  auto scene = std::make_shared<Scene>(description, options, cancellation);
  options.max_patch_area =
      patches != 0 ? max_patch_area_for(*scene, patches, cancellation) : max_patch_area;
  if (options.max_patch_area != 0) {
    scene = std::make_shared<Scene>(description, options, cancellation);
  }
  return scene;
}

ScenePtr load(const std::string& spec, const Division& division, const Reading& reading) {
  ReadOptions read;
  std::tie(read.scale, read.join, read.default_reflectance) = reading;
  read.validate();
  return run_cancelably([&](const Cancellation& cancellation) {
    return make_scene(describe_scene(spec, read, cancellation), division, cancellation);
  });
}

/// The rows of an array (n, 3) or of one row for all n.
std::vector<Rgb> colors(const Array<double>& values, std::size_t count, const std::string& name) {
  std::vector<Rgb> rows(count);
  const auto size = static_cast<std::size_t>(values.size());
  const double* data = values.data();
  const bool is_table = values.ndim() == 2 && values.shape(1) == 3 && size == 3 * count;
  if (values.ndim() <= 1 && (size == 1 || size == 3)) {
    const Rgb all = size == 1 ? Rgb{data[0], data[0], data[0]} : Rgb{data[0], data[1], data[2]};
    std::fill(rows.begin(), rows.end(), all);
  } else if (values.ndim() == 1 && size == count) {
    for (std::size_t i = 0; i < count; ++i) {
      rows[i] = {data[i], data[i], data[i]};
    }
  } else if (is_table) {
    for (std::size_t i = 0; i < count; ++i) {
      rows[i] = {data[3 * i], data[3 * i + 1], data[3 * i + 2]};
    }
  } else {
    throw InputError(name + ": expected one value, three, one for each face, or three for each");
  }
  return rows;
}

ScenePtr build(const Array<double>& points, const std::vector<std::vector<PointId>>& faces,
               const Array<double>& reflectance, const Array<double>& exitance,
               const Division& division, const std::string& name) {
  if (points.ndim() != 2 || points.shape(1) != 3) {
    throw InputError("points: expected an array (n, 3)");
  }
  SceneDescription description;
  description.name = name;
  description.points.resize(static_cast<std::size_t>(points.shape(0)));
  for (std::size_t i = 0; i < description.points.size(); ++i) {
    const double* p = points.data() + 3 * i;
    description.points[i] = {p[0], p[1], p[2]};
  }
  const std::vector<Rgb> rho = colors(reflectance, faces.size(), "reflectance");
  const std::vector<Rgb> given = colors(exitance, faces.size(), "exitance");
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool as_before = f > 0 && rho[f] == rho[f - 1] && given[f] == given[f - 1];
    if (!as_before) {
      description.materials.push_back({"", rho[f], given[f]});
    }
    description.add_face(faces[f], static_cast<int>(description.materials.size()) - 1);
  }
  return run_cancelably([&](const Cancellation& cancellation) {
    return make_scene(description, division, cancellation);
  });
}

/// Corners of all outlines, and where each begins.
py::tuple outlines(const Scene& scene) {
  std::vector<std::int64_t> begin{0};
  std::vector<PointId> corners;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    corners.insert(corners.end(), outline.begin(), outline.end());
    begin.push_back(static_cast<std::int64_t>(corners.size()));
  }
  return py::make_tuple(to_array(begin), to_array(corners));
}

template <class Value, class Get>
py::array_t<Value> of_patches(const Scene& scene, Get get) {
  py::array_t<Value> values(static_cast<py::ssize_t>(scene.patch_count()));
  Value* out = values.mutable_data();
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    out[i] = get(i);
  }
  return values;
}

template <class Get>
py::array_t<double> table_of_patches(const Scene& scene, Get get) {
  std::vector<decltype(get(0))> values;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    values.push_back(get(i));
  }
  return to_table<3>(values);
}

}  // namespace

void bind_scene(py::module_& module) {
  // Held as a pointer to const by all that C++ shares; Python sees no function that changes it.
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene")
      .def_property_readonly("name", &Scene::name)
      .def("__len__", &Scene::patch_count)
      .def_property_readonly("points", [](const Scene& s) { return to_table<3>(s.points()); })
      .def_property_readonly("outlines", &outlines)
      .def_property_readonly("area",
                             [](const Scene& s) {
                               return of_patches<double>(
                                   s, [&](PatchId i) { return s.patch(i).area; });
                             })
      .def_property_readonly("normal",
                             [](const Scene& s) {
                               return table_of_patches(
                                   s, [&](PatchId i) { return s.patch(i).normal; });
                             })
      .def_property_readonly("center",
                             [](const Scene& s) {
                               return table_of_patches(
                                   s, [&](PatchId i) { return s.patch(i).center; });
                             })
      .def_property_readonly("reflectance",
                             [](const Scene& s) {
                               return table_of_patches(s,
                                                       [&](PatchId i) { return s.reflectance(i); });
                             })
      .def_property_readonly("exitance",
                             [](const Scene& s) {
                               return table_of_patches(s, [&](PatchId i) { return s.exitance(i); });
                             })
      .def_property_readonly("face",
                             [](const Scene& s) {
                               return of_patches<std::int32_t>(
                                   s, [&](PatchId i) { return s.patch(i).face; });
                             })
      .def_property_readonly("group",
                             [](const Scene& s) {
                               return of_patches<std::int32_t>(
                                   s, [&](PatchId i) { return s.patch(i).group; });
                             })
      .def_property_readonly("groups", &Scene::groups)
      .def_property_readonly("warnings", [](const Scene& s) { return s.report().warnings; });
  module.def("load", &load);
  module.def("build", &build);
}

}  // namespace transillum::python
