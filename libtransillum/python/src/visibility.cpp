// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <sstream>

#include "arrays.h"
#include "bindings.h"
#include "interrupt.h"

namespace transillum::python {
namespace {

using ScenePtr = std::shared_ptr<Scene>;

py::dict transfers(const ScenePtr& scene, const py::handle& direction, const py::dict& keywords) {
  refuse(keywords, {"engine", "resolution", "order", "seed"}, false, "transfers()");
  const SolveOptions options = options_from(keywords, Goal::none);
  const Vec3 omega = to_direction(direction, "direction");
  const Transfers found = run_cancelably([&](const Cancellation& cancellation) {
    const auto tree = std::make_shared<const BspTree>(*scene, cancellation);
    EngineOptions engine_options = options.engine_options;
    engine_options.seed = options.seed;
    return make_engine(options.engine, scene, tree, engine_options)(omega, cancellation);
  });
  std::vector<PatchId> receivers, sources;
  std::vector<double> areas;
  for (const Transfer& t : found.exchanges) {
    receivers.push_back(t.receiver);
    sources.push_back(t.source);
    areas.push_back(t.area);
  }
  py::dict dict;
  dict["direction"] = to_tuple(found.direction);
  dict["receiver"] = to_array(receivers);
  dict["source"] = to_array(sources);
  dict["area"] = to_array(areas);
  const auto coverage = [&](const char* name, const std::vector<Coverage>& list) {
    std::vector<double> projected, covered;
    for (const Coverage& c : list) {
      projected.push_back(c.projected);
      covered.push_back(c.covered);
    }
    dict[name] = py::make_tuple(to_array(projected), to_array(covered));
  };
  coverage("forward", found.forward);
  coverage("backward", found.backward);
  dict["closure_defect"] = closure_defect(found, *scene).relative;
  return dict;
}

/// A map with the scene that its pictures name.
struct Map {
  ScenePtr scene;
  VisibilityMap map;
};

py::list polygons(const VisibilityMap& map) {
  py::list list;
  for (const VisibilityMap::Polygon& polygon : map.polygons) {
    const auto outline = map.outline(polygon);
    list.append(py::make_tuple(polygon.patch, polygon.front_facing, polygon.area,
                               to_table<2>(std::vector<Vec2>(outline.begin(), outline.end()))));
  }
  return list;
}

std::string svg(const Map& map, int size) {
  const py::gil_scoped_release released;
  std::ostringstream out;
  MapPictureOptions options;
  options.size = size;
  write_map_svg(out, *map.scene, map.map, options);
  return out.str();
}

Map visibility_map(const ScenePtr& scene, const py::handle& direction,
                   std::optional<PatchId> patch) {
  const Vec3 omega = to_direction(direction, "direction");
  if (patch && (*patch < 0 || *patch >= scene->patch_count())) {
    throw InputError("patch: there is no patch " + std::to_string(*patch) + "; the scene has " +
                     std::to_string(scene->patch_count()));
  }
  return run_cancelably([&](const Cancellation& cancellation) {
    const BspTree tree(*scene, cancellation);
    const RecordedDirection recorded = record_local_map(*scene, tree, omega, cancellation);
    return Map{scene, patch ? map_of_receiver(recorded, *patch) : map_from_below(recorded)};
  });
}

}  // namespace

void bind_visibility(py::module_& module) {
  module.def("transfers", &transfers);
  py::class_<Map>(module, "VisibilityMap")
      .def_property_readonly("scene", [](const Map& m) { return m.scene; })
      .def_property_readonly("frame",
                             [](const Map& m) {
                               const PlaneFrame& f = m.map.frame;
                               return py::make_tuple(to_tuple(f.origin), to_tuple(f.u),
                                                     to_tuple(f.v), to_tuple(f.omega));
                             })
      .def_property_readonly("polygons", [](const Map& m) { return polygons(m.map); })
      .def("svg", &svg, py::arg("size"));
  module.def("visibility_map", &visibility_map);
}

}  // namespace transillum::python
