// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "scene/build/closed_parts.h"
#include "scene/build/joining.h"
#include "scene/build/point_table.h"
#include "scene/build/polygon_shape.h"
#include "scene/build/precision.h"
#include "scene/build/rounding_repair.h"
#include "transillum/at.h"
#include "transillum/solids.h"

namespace transillum {
namespace {

namespace mesh_processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using MeshFace = Mesh::Face_index;
using FaceNumbers = Mesh::Property_map<MeshFace, std::int32_t>;

constexpr const char* face_property = "f:face";

/// The face of the description that each face of the mesh is a part of.
FaceNumbers face_numbers(Mesh& mesh) {
  return mesh.add_property_map<MeshFace, std::int32_t>(face_property, -1).first;
}

/// Keeps the numbers of faces while a mesh is triangulated.
struct TriangleNumbers : mesh_processing::Triangulate_faces::Default_visitor<Mesh> {
  explicit TriangleNumbers(FaceNumbers map) : numbers(map) {}
  void before_subface_creations(MeshFace old) { current = numbers[old]; }
  void after_subface_created(MeshFace made) { numbers[made] = current; }

  FaceNumbers numbers;
  std::int32_t current = -1;
};

/// Keeps the numbers of faces while meshes cut each other.
struct CutNumbers : mesh_processing::Corefinement::Default_visitor<Mesh> {
  void before_subface_creations(MeshFace old, Mesh& mesh) { current = face_numbers(mesh)[old]; }
  void after_subface_created(MeshFace made, Mesh& mesh) { face_numbers(mesh)[made] = current; }
  void after_face_copy(MeshFace old, const Mesh& from, MeshFace made, Mesh& to) {
    face_numbers(to)[made] = from.property_map<MeshFace, std::int32_t>(face_property).first[old];
  }

  std::int32_t current = -1;
};

/// A closed surface.
struct Solid {
  Mesh mesh;
  CGAL::Bbox_3 box;
  bool outward = true;
  bool united = false;  ///< cut by another one, or united with it
};

double size_of(const CGAL::Bbox_3& box) {
  return (box.xmax() - box.xmin()) + (box.ymax() - box.ymin()) + (box.zmax() - box.zmin());
}

bool contains(const CGAL::Bbox_3& outer, const CGAL::Bbox_3& inner) {
  return CGAL::do_overlap(outer, inner) && (outer + inner) == outer;
}

/// None where the faces make no surface, or cross one another.
std::optional<Solid> solid_of(const ConnectedFaces& part, const std::vector<Vec3>& points,
                              const std::vector<std::vector<PointId>>& outlines) {
  Solid solid;
  std::map<PointId, Mesh::Vertex_index> vertices;
  const FaceNumbers numbers = face_numbers(solid.mesh);
  for (const std::int32_t f : part.faces) {
    std::vector<Mesh::Vertex_index> corners;
    for (const PointId p : at(outlines, f)) {
      const auto [found, added] = vertices.try_emplace(p);
      if (added) {
        const Vec3& point = at(points, p);
        found->second = solid.mesh.add_vertex({point.x, point.y, point.z});
      }
      corners.push_back(found->second);
    }
    const MeshFace made = solid.mesh.add_face(corners);
    if (made == Mesh::null_face()) {
      return std::nullopt;
    }
    numbers[made] = f;
  }
  TriangleNumbers visitor(numbers);
  if (!mesh_processing::triangulate_faces(solid.mesh, CGAL::parameters::visitor(visitor)) ||
      !CGAL::is_closed(solid.mesh) || mesh_processing::does_self_intersect(solid.mesh)) {
    return std::nullopt;
  }
  solid.outward = mesh_processing::is_outward_oriented(solid.mesh);
  solid.box = mesh_processing::bbox(solid.mesh);
  return solid;
}

using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

/// Holes become a part of the smallest solid around them.
void join_holes(std::list<Solid>& solids) {
  for (auto hole = solids.begin(); hole != solids.end();) {
    Solid* around = nullptr;
    for (Solid& solid : solids) {
      const bool smaller = !around || size_of(solid.box) < size_of(around->box);
      if (!hole->outward && solid.outward && smaller && contains(solid.box, hole->box) &&
          Side(solid.mesh)(hole->mesh.point(*hole->mesh.vertices_begin())) ==
              CGAL::ON_BOUNDED_SIDE) {
        around = &solid;
      }
    }
    if (around) {
      const FaceNumbers from = face_numbers(hole->mesh), to = face_numbers(around->mesh);
      std::vector<std::pair<MeshFace, MeshFace>> copied;
      CGAL::copy_face_graph(
          hole->mesh, around->mesh,
          CGAL::parameters::face_to_face_output_iterator(std::back_inserter(copied)));
      for (const auto& [old, made] : copied) {
        to[made] = from[old];
      }
      hole = solids.erase(hole);
    } else {
      ++hole;
    }
  }
}

/// Whether two solids cross, touch or contain one another.
bool meet(const Solid& a, const Solid& b) {
  if (!CGAL::do_overlap(a.box, b.box)) {
    return false;
  }
  return mesh_processing::do_intersect(
      a.mesh, b.mesh, CGAL::parameters::do_overlap_test_of_bounded_sides(a.outward && b.outward));
}

/// The union of both in `a`; false if no surface bounds it, such as where two only share an edge.
bool unite(Solid& a, const Solid& b) {
  Mesh first = a.mesh, second = b.mesh;
  face_numbers(first);
  try {
    if (!mesh_processing::corefine_and_compute_union(first, second, first,
                                                     CGAL::parameters::visitor(CutNumbers()))) {
      return false;
    }
  } catch (const CGAL::Failure_exception&) {
    return false;
  }
  a.mesh = std::move(first);
  a.mesh.collect_garbage();
  a.box = mesh_processing::bbox(a.mesh);
  a.united = true;
  return true;
}

/// Unites what meets, in the order of the list.
/// @return how many could not be united with one that they meet
std::int64_t unite_all(std::list<Solid>& solids, SolidsReport& report,
                       const Cancellation& cancellation) {
  std::list<Solid> done;
  std::int64_t refused = 0;
  for (Solid& next : solids) {
    bool is_refused = false;
    for (auto other = done.begin(); other != done.end();) {
      cancellation.throw_if_canceled();
      if (!meet(*other, next)) {
        ++other;
      } else if (Solid both = *other; unite(both, next)) {
        report.united += (other->united ? 0 : 1) + (next.united ? 0 : 1);
        both.outward = other->outward && next.outward;
        next = std::move(both);
        other = done.erase(other);
      } else {
        is_refused = true;
        ++other;
      }
    }
    refused += is_refused ? 1 : 0;
    done.push_back(std::move(next));
  }
  solids = std::move(done);
  return refused;
}

Vec3 rounded(const Kernel::Point_3& point) {
  return {CGAL::to_double(CGAL::exact(point.x())), CGAL::to_double(CGAL::exact(point.y())),
          CGAL::to_double(CGAL::exact(point.z()))};
}

/// The description with what remains of its faces.
class RemainingFaces {
 public:
  RemainingFaces(const SceneDescription& description, const std::vector<Vec3>& points,
                 const std::vector<std::vector<PointId>>& outlines)
      : original_(description), points_(points), outlines_(outlines) {}

  /// The face is in no solid that was cut.
  void keep(std::int32_t face) { whole_.push_back(face); }
  /// Takes the triangles of a solid. A face is whole if it has the corners of its outline and no
  /// others, and as many triangles as its outline gives.
  void add(Solid& solid) {
    const FaceNumbers numbers = face_numbers(solid.mesh);
    std::map<std::int32_t, std::vector<std::array<Vec3, 3>>> triangles;
    for (const MeshFace face : solid.mesh.faces()) {
      std::array<Vec3, 3> corners;
      auto corner = corners.begin();
      for (const auto v : solid.mesh.vertices_around_face(solid.mesh.halfedge(face))) {
        *corner++ = rounded(solid.mesh.point(v));
      }
      triangles[numbers[face]].push_back(corners);
    }
    for (auto& [face, all] : triangles) {
      if (is_whole(face, all)) {
        whole_.push_back(face);
      } else {
        auto& parts = cut_[face];
        parts.insert(parts.end(), all.begin(), all.end());
      }
    }
  }

  SceneDescription description(const Cancellation& cancellation) {
    SceneDescription made = original_;
    made.points.clear();
    made.corners.clear();
    made.face_begin.clear();
    made.face_material.clear();
    made.face_line.clear();
    made.face_number.clear();
    made.face_group.clear();
    made.face_two_sided.clear();
    std::vector<std::pair<std::int32_t, std::vector<PointId>>> faces;
    for (const std::int32_t f : whole_) {
      std::vector<PointId> outline;
      for (const PointId p : at(outlines_, f)) {
        outline.push_back(table_.id_of(at(points_, p)));
      }
      faces.emplace_back(f, std::move(outline));
    }
    add_cut(faces, cancellation);
    std::stable_sort(faces.begin(), faces.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [f, outline] : faces) {
      made.add_face(outline, at(original_.face_material, f), at(original_.face_line, f),
                    original_.group_of(f));
      made.face_number.push_back(original_.number_of(f));
      if (original_.is_two_sided(f)) {
        made.face_two_sided.resize(made.face_count(), 0);
        made.face_two_sided.back() = 1;
      }
    }
    if (!made.face_two_sided.empty()) {
      made.face_two_sided.resize(made.face_count(), 0);
    }
    made.points = table_.take();
    return made;
  }

 private:
  bool is_whole(std::int32_t face, const std::vector<std::array<Vec3, 3>>& triangles) const {
    const std::vector<PointId>& outline = at(outlines_, face);
    const auto is_corner = [&](const Vec3& p) {
      return std::any_of(outline.begin(), outline.end(),
                         [&](PointId c) { return at(points_, c) == p; });
    };
    return triangles.size() + 2 == outline.size() &&
           std::all_of(triangles.begin(), triangles.end(), [&](const auto& corners) {
             return std::all_of(corners.begin(), corners.end(), is_corner);
           });
  }

  // The triangles of each face are joined to polygons; the material tells faces apart meanwhile.
  void add_cut(std::vector<std::pair<std::int32_t, std::vector<PointId>>>& faces,
               const Cancellation& cancellation) {
    SceneDescription triangles;
    PointTable table;
    std::vector<std::int32_t> face_of;
    for (const auto& [face, all] : cut_) {
      for (const std::array<Vec3, 3>& corners : all) {
        const std::array<PointId, 3> ids{table.id_of(corners[0]), table.id_of(corners[1]),
                                         table.id_of(corners[2])};
        if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0]) {
          triangles.add_face(ids, static_cast<int>(face_of.size()));
        }
      }
      face_of.push_back(face);
    }
    triangles.points = table.take();
    triangles.materials.resize(face_of.size());
    const SceneDescription joined = join_faces(triangles, cancellation).description;
    for (std::size_t f = 0; f < joined.face_count(); ++f) {
      std::vector<PointId> outline;
      for (const PointId p : joined.outline(f)) {
        outline.push_back(table_.id_of(at(joined.points, p)));
      }
      faces.emplace_back(at(face_of, at(joined.face_material, f)), std::move(outline));
    }
  }

  const SceneDescription& original_;
  const std::vector<Vec3>& points_;
  const std::vector<std::vector<PointId>>& outlines_;
  std::vector<std::int32_t> whole_;
  std::map<std::int32_t, std::vector<std::array<Vec3, 3>>> cut_;
  PointTable table_;
};

/// Areas of faces by their numbers, m².
/// @param outline_of indices into `points` by face
template <class OutlineOf>
std::map<std::int32_t, double> areas_of(const SceneDescription& description,
                                        const std::vector<Vec3>& points, OutlineOf outline_of) {
  std::map<std::int32_t, double> areas;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const auto& outline = outline_of(f);
    Vec3 twice{};
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
      twice = twice + cross(at(points, outline[k]) - at(points, outline[0]),
                            at(points, outline[k + 1]) - at(points, outline[0]));
    }
    areas[description.number_of(f)] += norm(twice) / 2;
  }
  return areas;
}

/// Sets what a report says of areas and faces.
void compare_areas(const std::map<std::int32_t, double>& before,
                   const std::map<std::int32_t, double>& after, SolidsReport& report) {
  constexpr double rounding = 1e-9;
  for (const auto& [face, area] : before) {
    const auto left = after.find(face);
    report.area_before += area;
    report.area_after += left == after.end() ? 0 : left->second;
    if (left == after.end()) {
      report.removed.push_back(face);
    } else if (left->second < (1 - rounding) * area) {
      report.cut.push_back(face);
    }
  }
}

/// A description's parts, on points without rounding.
struct Parts {
  std::vector<Vec3> points;
  std::vector<std::vector<PointId>> outlines;
  std::vector<ConnectedFaces> connected;

  Parts(const SceneDescription& description, const Cancellation& cancellation) {
    const double rounding = description.coordinate_rounding > 0
                                ? description.coordinate_rounding
                                : coordinate_rounding(description.points);
    const std::vector<Vec3> moved = without_rounding(description, rounding, cancellation);
    PointTable table;
    std::vector<PointId> welded(moved.size(), -1);
    for (std::size_t f = 0; f < description.face_count(); ++f) {
      outlines.push_back(welded_outline(description.outline(f), moved, welded, table));
    }
    points = table.take();
    connected = connected_faces(description, outlines);
  }
};

std::string count_of(std::int64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void add_sentences(SolidsReport& report, std::int64_t crossing) {
  if (report.united > 0) {
    report.sentences.push_back(fmt::format(
        "{} united; {:.3g} % of the area of all faces lay inside or against another one",
        count_of(report.united, "closed part"),
        100 * (1 - report.area_after / report.area_before)));
  } else {
    report.sentences.push_back("no closed parts cross or touch");
  }
  if (report.refused > 0) {
    report.sentences.push_back(fmt::format(
        "{} not united with another one: no surface bounds the union, as where they share an edge",
        count_of(report.refused, "closed part")));
  }
  if (crossing > 0) {
    report.sentences.push_back(
        fmt::format("the faces of {} cross one another: kept", count_of(crossing, "closed part")));
  }
  if (report.open > 0) {
    report.sentences.push_back(
        fmt::format("{} not closed, or two-sided: kept", count_of(report.open, "part")));
  }
  if (report.rooms > 1) {
    report.sentences.push_back(
        fmt::format("{} rooms keep their walls: only one is united with its solids", report.rooms));
  }
}

}  // namespace

SolidsReport unite_solids(SceneDescription& description, const Cancellation& cancellation) {
  const Parts parts(description, cancellation);
  SolidsReport report;
  const auto before = areas_of(description, parts.points,
                               [&](std::size_t f) -> auto& { return parts.outlines[f]; });
  RemainingFaces remaining(description, parts.points, parts.outlines);
  std::list<Solid> solids;
  std::int64_t crossing = 0;
  for (const ConnectedFaces& part : parts.connected) {
    cancellation.throw_if_canceled();
    auto solid = part.closed ? solid_of(part, parts.points, parts.outlines) : std::nullopt;
    if (solid) {
      report.solids += solid->outward ? 1 : 0;
      solids.push_back(std::move(*solid));
      continue;
    }
    (part.closed ? crossing : report.open) += 1;
    for (const std::int32_t f : part.faces) {
      remaining.keep(f);
    }
  }
  join_holes(solids);
  report.rooms = std::count_if(solids.begin(), solids.end(),
                               [](const Solid& solid) { return !solid.outward; });
  if (report.rooms > 1) {
    solids.remove_if([&](Solid& solid) {
      if (!solid.outward) {
        remaining.add(solid);
      }
      return !solid.outward;
    });
  }
  report.refused = unite_all(solids, report, cancellation);
  if (report.united > 0) {
    for (Solid& solid : solids) {
      remaining.add(solid);
    }
    description = remaining.description(cancellation);
  }
  const auto outline_after = [&](std::size_t f) { return description.outline(f); };
  compare_areas(
      before, report.united > 0 ? areas_of(description, description.points, outline_after) : before,
      report);
  add_sentences(report, crossing);
  return report;
}

namespace {

constexpr int probes = 4096;

/// About as many points on the faces as there are probes, each with its face, evenly by area: the
/// middle of triangles where these are many.
std::vector<std::pair<std::int32_t, Vec3>> probes_on(const Parts& parts) {
  std::vector<double> sums;
  std::vector<std::pair<std::int32_t, std::array<Vec3, 3>>> triangles;
  for (std::size_t f = 0; f < parts.outlines.size(); ++f) {
    const std::vector<PointId>& outline = parts.outlines[f];
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
      const std::array<Vec3, 3> corners{at(parts.points, outline[0]), at(parts.points, outline[k]),
                                        at(parts.points, outline[k + 1])};
      triangles.emplace_back(static_cast<std::int32_t>(f), corners);
      const double area = norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
      sums.push_back((sums.empty() ? 0 : sums.back()) + area);
    }
  }
  std::mt19937 random(1);
  const auto unit = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  std::vector<std::pair<std::int32_t, Vec3>> points;
  for (int n = 0; n < probes && !sums.empty(); ++n) {
    const double sought = (n + unit()) / probes * sums.back();
    const auto k = std::min<std::ptrdiff_t>(
        std::lower_bound(sums.begin(), sums.end(), sought) - sums.begin(), std::ssize(sums) - 1);
    const auto& [face, corners] = at(triangles, k);
    double s = unit(), t = unit();
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    points.emplace_back(face,
                        corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]));
  }
  return points;
}

}  // namespace

double share_inside_solids(const SceneDescription& description, const Cancellation& cancellation) {
  const Parts parts(description, cancellation);
  std::vector<std::size_t> part_of(parts.outlines.size());
  std::vector<CGAL::Bbox_3> boxes(parts.connected.size());
  for (std::size_t k = 0; k < parts.connected.size(); ++k) {
    for (const std::int32_t f : parts.connected[k].faces) {
      at(part_of, f) = k;
      for (const PointId p : at(parts.outlines, f)) {
        const Vec3& point = at(parts.points, p);
        boxes[k] += CGAL::Bbox_3(point.x, point.y, point.z, point.x, point.y, point.z);
      }
    }
  }
  struct Tested {
    std::optional<Solid> solid;
    std::unique_ptr<Side> side;
  };
  std::map<std::size_t, Tested> tested;
  int inside = 0;
  const auto points = probes_on(parts);
  for (const auto& [face, p] : points) {
    cancellation.throw_if_canceled();
    const CGAL::Bbox_3 box(p.x, p.y, p.z, p.x, p.y, p.z);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (k == at(part_of, face) || !parts.connected[k].closed ||
          !CGAL::do_overlap(boxes[k], box)) {
        continue;
      }
      const auto [found, added] = tested.try_emplace(k);
      if (added) {
        found->second.solid = solid_of(parts.connected[k], parts.points, parts.outlines);
        if (found->second.solid && found->second.solid->outward) {
          found->second.side = std::make_unique<Side>(found->second.solid->mesh);
        }
      }
      if (found->second.side && (*found->second.side)({p.x, p.y, p.z}) != CGAL::ON_UNBOUNDED_SIDE) {
        ++inside;
        break;
      }
    }
  }
  return points.empty() ? 0 : static_cast<double>(inside) / static_cast<double>(points.size());
}

}  // namespace transillum
