// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Which points lay on a common plane before their coordinates were rounded. Faces are collected
// into planes from the largest to the smallest: a plane grows by the faces whose corners are as
// near to it as rounding explains, and is fitted again as it grows. Then the points that touch a
// face from elsewhere are added, found by an R-tree.
#include "scene/build/plane_incidences.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <numeric>
#include <tuple>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Largest rounding relative to the width of a face that takes part: thinner ones lose their shape.
constexpr double most_rounding_by_width = 0.005;
/// Width of a cell of normals.
constexpr double normal_cell = 0.02;
/// Faces compared with a growing plane, per face of the scene; then faces stay on their own.
constexpr std::size_t comparisons_per_face = 256;

/// Distance of two points in a plane by rounding, at most, relative to that of a coordinate.
const double touching = 2 * std::sqrt(3.0);

/// Distance of a point from a plane by rounding, at most: its own and the plane's. Half a unit more
/// or less: a whole unit is a feature.
double off_plane(const Vec3& normal, double rounding) {
  const double sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  return 2 * (1 - 1e-6) * sum * rounding;
}

/// Points and the plane that fits them.
class PlaneFit {
 public:
  void add(const Vec3& p) {
    if (count_ == 0) {
      origin_ = p;
    }
    const Eigen::Vector3d v(p.x - origin_.x, p.y - origin_.y, p.z - origin_.z);
    sum_ += v;
    products_ += v * v.transpose();
    ++count_;
  }
  std::size_t count() const { return count_; }
  void fit() {
    const auto n = static_cast<double>(count_);
    const Eigen::Vector3d mean = sum_ / n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(products_ / n -
                                                              mean * mean.transpose());
    const auto axis = [&](int k) {
      const auto v = axes.eigenvectors().col(k);
      return Vec3{v[0], v[1], v[2]};
    };
    normal = axis(0);
    across = axis(1);
    along = axis(2);
    breadth = std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
    length = std::sqrt(std::max(axes.eigenvalues()[2], 0.0));
    center = origin_ + Vec3{mean[0], mean[1], mean[2]};
  }
  /// How much farther off the plane a point may be than those that it was fitted to.
  double extrapolation(const Vec3& p) const {
    return 1 + std::abs(dot(across, p - center)) / (2 * breadth) +
           std::abs(dot(along, p - center)) / (2 * length);
  }

  Vec3 normal, across, along, center;
  double breadth = 0, length = 0;  ///< standard deviations along `across` and `along`, m

 private:
  Vec3 origin_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();
  std::size_t count_ = 0;
};

class IncidenceSearch {
 public:
  IncidenceSearch(std::span<const Vec3> points, const std::vector<std::vector<PointId>>& faces,
                  double rounding, const Cancellation& cancellation)
      : points_(points), faces_(faces), rounding_(rounding), cancellation_(cancellation) {}

  PlaneIncidences run() {
    measure_faces();
    sort_by_normal();
    std::vector<std::int32_t> order(faces_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return at(shapes_, a).area > at(shapes_, b).area;
    });
    for (const std::int32_t face : order) {
      check();
      if (at(takes_part_, face) && at(plane_of_, face) < 0) {
        add_plane(face);
      }
    }
    add_touching_points();
    drop_planes_of_three();
    return std::move(found_);
  }

 private:
  /// A face in a cell of normals, with its distance from the origin along the cell's mean normal.
  struct Entry {
    std::array<int, 3> cell;
    double distance;
    std::int32_t face;
  };
  struct Cell {
    std::size_t begin, end;
    Vec3 mean;
  };

  void check() {
    if (++checks_ % 1024 == 0) {
      cancellation_.throw_if_canceled();
    }
  }

  void measure_faces() {
    plane_of_.assign(faces_.size(), -1);
    found_.movable.assign(points_.size(), true);
    for (const auto& outline : faces_) {
      check();
      const PolygonShape shape = measure(points_, outline);
      const double width = shape.area / shape.diameter;
      const bool wide = !shape.degenerate && rounding_ <= most_rounding_by_width * width;
      takes_part_.push_back(wide && shape.deviation <= off_plane(shape.normal, rounding_));
      if (!wide) {
        for (const PointId p : outline) {
          found_.movable[static_cast<std::size_t>(p)] = false;
        }
      }
      shapes_.push_back(shape);
      exact_axis_.push_back(exact_axis(outline));
    }
  }

  /// The axis along which all corners have the same coordinate, or -1.
  int exact_axis(const std::vector<PointId>& outline) const {
    if (outline.size() < 3) {
      return -1;
    }
    const Vec3& first = at(points_, outline[0]);
    std::array<bool, 3> same{true, true, true};
    for (const PointId p : outline) {
      const Vec3& q = at(points_, p);
      same[0] = same[0] && q.x == first.x;
      same[1] = same[1] && q.y == first.y;
      same[2] = same[2] && q.z == first.z;
    }
    return same[0] ? 0 : same[1] ? 1 : same[2] ? 2 : -1;
  }

  static std::array<int, 3> cell_of(const Vec3& normal) {
    const auto index = [](double v) { return static_cast<int>(std::floor(v / normal_cell)); };
    return {index(normal.x), index(normal.y), index(normal.z)};
  }

  /// Each face is in the cells of its normal and of the opposite one.
  void sort_by_normal() {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (takes_part_[f]) {
        entries_.push_back({cell_of(shapes_[f].normal), 0, static_cast<std::int32_t>(f)});
        entries_.push_back({cell_of(-shapes_[f].normal), 0, static_cast<std::int32_t>(f)});
      }
    }
    const auto by_cell = [](const Entry& a, const Entry& b) {
      return std::tie(a.cell, a.distance, a.face) < std::tie(b.cell, b.distance, b.face);
    };
    std::sort(entries_.begin(), entries_.end(), by_cell);
    for (std::size_t begin = 0, end = 0; begin < entries_.size(); begin = end) {
      Vec3 mean;
      for (end = begin; end < entries_.size() && entries_[end].cell == entries_[begin].cell;
           ++end) {
        const Vec3& n = at(shapes_, entries_[end].face).normal;
        mean = mean + (cell_of(n) == entries_[begin].cell ? 1.0 : -1.0) * n;
      }
      mean = normalized(mean);
      for (std::size_t k = begin; k < end; ++k) {
        entries_[k].distance = dot(mean, at(shapes_, entries_[k].face).center);
      }
      std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(begin),
                entries_.begin() + static_cast<std::ptrdiff_t>(end), by_cell);
      cells_.push_back({begin, end, mean});
    }
    for (const Vec3& p : points_) {
      extent_ = std::max(extent_, 2 * norm(p - points_[0]));
    }
  }

  /// The faces without a plane whose centers may lie on a plane, nearest first.
  std::vector<std::int32_t> near(const PlaneFit& plane) {
    std::vector<std::pair<double, std::int32_t>> sorted;
    const std::array<int, 3> cell = cell_of(plane.normal);
    for (int x = cell[0] - 1; x <= cell[0] + 1; ++x) {
      for (int y = cell[1] - 1; y <= cell[1] + 1; ++y) {
        for (int z = cell[2] - 1; z <= cell[2] + 1; ++z) {
          const std::array<int, 3> key{x, y, z};
          const auto found = std::lower_bound(cells_.begin(), cells_.end(), key,
                                              [&](const Cell& c, const std::array<int, 3>& k) {
                                                return entries_[c.begin].cell < k;
                                              });
          if (found != cells_.end() && entries_[found->begin].cell == key) {
            add_near(plane, *found, sorted);
          }
        }
      }
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int32_t> faces;
    for (const auto& [distance, face] : sorted) {
      faces.push_back(face);
    }
    return faces;
  }

  void add_near(const PlaneFit& plane, const Cell& cell,
                std::vector<std::pair<double, std::int32_t>>& sorted) {
    const double middle = dot(cell.mean, plane.center);
    const double reach = norm(cell.mean - plane.normal) * extent_ +
                         off_plane(plane.normal, rounding_) *
                             (1 + extent_ / (2 * plane.breadth) + extent_ / (2 * plane.length));
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(cell.begin);
    const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(cell.end);
    for (auto e = std::lower_bound(
             begin, end, middle - reach,
             [](const Entry& entry, double distance) { return entry.distance < distance; });
         e != end && e->distance <= middle + reach; ++e) {
      if (++comparisons_ > comparisons_per_face * faces_.size()) {
        return;
      }
      const Vec3& center = at(shapes_, e->face).center;
      if (at(plane_of_, e->face) < 0 && is_on(plane, center)) {
        sorted.emplace_back(norm(center - plane.center), e->face);
      }
    }
  }

  bool is_on(const PlaneFit& plane, const Vec3& p) const {
    return std::abs(dot(plane.normal, p - plane.center)) <=
           off_plane(plane.normal, rounding_) * plane.extrapolation(p);
  }

  void add_corners(std::int32_t face, PlaneFit& plane) const {
    for (const PointId p : at(faces_, face)) {
      plane.add(at(points_, p));
    }
  }

  /// Makes the plane of a face and all others on it.
  void add_plane(std::int32_t seed) {
    const auto number = static_cast<std::int32_t>(found_.planes.size());
    std::vector<std::int32_t> members{seed};
    if (at(exact_axis_, seed) >= 0) {
      add_exact_members(seed, members);
    } else {
      add_members(seed, members);
    }
    PlaneFit plane;
    for (const std::int32_t face : members) {
      at(plane_of_, face) = number;
      add_corners(face, plane);
      for (const PointId p : at(faces_, face)) {
        found_.incidences.push_back({p, number, true});
      }
    }
    plane.fit();
    RoundedPlane result{plane.normal,  plane.center, plane.across,
                        plane.breadth, plane.length, at(exact_axis_, seed) >= 0};
    if (result.fixed) {
      result.normal =
          Vec3{at(exact_axis_, seed) == 0 ? 1.0 : 0.0, at(exact_axis_, seed) == 1 ? 1.0 : 0.0,
               at(exact_axis_, seed) == 2 ? 1.0 : 0.0};
      result.center = at(points_, at(faces_, seed)[0]);
    }
    found_.planes.push_back(result);
  }

  static double coordinate(const Vec3& p, int axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }

  void add_exact_members(std::int32_t seed, std::vector<std::int32_t>& members) {
    const int axis = at(exact_axis_, seed);
    const auto height = [&](std::int32_t face) {
      return coordinate(at(points_, at(faces_, face)[0]), axis);
    };
    PlaneFit plane;
    add_corners(seed, plane);
    plane.fit();
    for (const std::int32_t face : near(plane)) {
      if (face != seed && at(exact_axis_, face) == axis && height(face) == height(seed)) {
        members.push_back(face);
      }
    }
  }

  void add_members(std::int32_t seed, std::vector<std::int32_t>& members) {
    PlaneFit plane;
    add_corners(seed, plane);
    plane.fit();
    std::size_t fitted = plane.count();
    for (const std::int32_t face : near(plane)) {
      const auto& outline = at(faces_, face);
      if (face == seed || at(exact_axis_, face) >= 0 ||
          !std::all_of(outline.begin(), outline.end(),
                       [&](PointId p) { return is_on(plane, at(points_, p)); })) {
        continue;
      }
      members.push_back(face);
      add_corners(face, plane);
      if (plane.count() >= fitted + fitted / 2) {
        plane.fit();
        fitted = plane.count();
      }
    }
    constexpr int most_attempts = 4;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      if (members.size() <= 1 || all_fit(members)) {
        break;
      }
    }
    if (!std::count(members.begin(), members.end(), seed) || !all_fit(members)) {
      members.assign(1, seed);
    }
  }

  /// Whether one plane fits all members within rounding. Removes those that it does not fit.
  bool all_fit(std::vector<std::int32_t>& members) const {
    PlaneFit plane;
    for (const std::int32_t face : members) {
      add_corners(face, plane);
    }
    plane.fit();
    const std::size_t before = members.size();
    const double limit = off_plane(plane.normal, rounding_);
    std::erase_if(members, [&](std::int32_t face) {
      const auto& outline = at(faces_, face);
      return std::any_of(outline.begin(), outline.end(), [&](PointId p) {
        return std::abs(dot(plane.normal, at(points_, p) - plane.center)) > limit;
      });
    });
    return members.size() == before;
  }

  void add_touching_points() {
    namespace bg = boost::geometry;
    namespace bgi = boost::geometry::index;
    using Point = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box = bg::model::box<Point>;
    std::vector<std::pair<Point, PointId>> values;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      values.emplace_back(Point(points_[k].x, points_[k].y, points_[k].z), static_cast<PointId>(k));
    }
    const bgi::rtree<std::pair<Point, PointId>, bgi::quadratic<16>> tree(values);
    known_on_.assign(points_.size(), -1);
    const std::size_t corners = found_.incidences.size();  // sorted by plane
    std::size_t corner = 0;
    for (const std::size_t f : faces_by_plane()) {
      check();
      for (; corner < corners && found_.incidences[corner].plane <= plane_of_[f]; ++corner) {
        at(known_on_, found_.incidences[corner].point) = found_.incidences[corner].plane;
      }
      Bounds bounds;
      for (const PointId p : faces_[f]) {
        bounds.add(at(points_, p));
      }
      const double margin = touching * rounding_;
      const Vec3 low = bounds.low, high = bounds.high;
      const Box box(Point(low.x - margin, low.y - margin, low.z - margin),
                    Point(high.x + margin, high.y + margin, high.z + margin));
      for (auto found = tree.qbegin(bgi::intersects(box)); found != tree.qend(); ++found) {
        check();
        if (touches(f, found->second)) {
          found_.incidences.push_back({found->second, plane_of_[f], false});
          at(known_on_, found->second) = plane_of_[f];
        }
      }
    }
    sort_incidences();
    drop_chance_touches();
  }

  /// All faces that have a plane, sorted by plane.
  std::vector<std::size_t> faces_by_plane() const {
    std::vector<std::size_t> faces;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (plane_of_[f] >= 0) {
        faces.push_back(f);
      }
    }
    std::stable_sort(faces.begin(), faces.end(),
                     [&](std::size_t a, std::size_t b) { return plane_of_[a] < plane_of_[b]; });
    return faces;
  }

  /// Corners first, so that they count where a point is also found to touch.
  void sort_incidences() {
    const auto by_plane = [](const PlaneIncidence& a, const PlaneIncidence& b) {
      return std::tuple(a.plane, a.point, !a.corner) < std::tuple(b.plane, b.point, !b.corner);
    };
    std::sort(found_.incidences.begin(), found_.incidences.end(), by_plane);
    found_.incidences.erase(std::unique(found_.incidences.begin(), found_.incidences.end(),
                                        [](const PlaneIncidence& a, const PlaneIncidence& b) {
                                          return a.plane == b.plane && a.point == b.point;
                                        }),
                            found_.incidences.end());
    const auto edge_of = [](const EdgeIncidence& i) {
      return std::tuple(i.point, std::min(i.from, i.to), std::max(i.from, i.to), i.direction);
    };
    // The first face counts that has the edge.
    std::stable_sort(on_edges_.begin(), on_edges_.end(), [&](const FaceEdge& a, const FaceEdge& b) {
      return std::tuple_cat(edge_of(a.edge), std::tuple(a.face)) <
             std::tuple_cat(edge_of(b.edge), std::tuple(b.face));
    });
    for (const FaceEdge& of : on_edges_) {
      if (found_.on_edges.empty() || edge_of(found_.on_edges.back()) != edge_of(of.edge)) {
        found_.on_edges.push_back(of.edge);
      }
    }
  }

  bool is_on_plane(PointId point, std::int32_t plane) const {
    const auto found = std::lower_bound(
        found_.incidences.begin(), found_.incidences.end(), std::pair(plane, point),
        [](const PlaneIncidence& i, const std::pair<std::int32_t, PointId>& key) {
          return std::pair(i.plane, i.point) < key;
        });
    return found != found_.incidences.end() && found->plane == plane && found->point == point;
  }

  /// Whether the edge from a point on a plane to another one may lie in the plane.
  bool stays_on_plane(PointId from, PointId to, const RoundedPlane& plane) const {
    const Vec3 edge = at(points_, to) - at(points_, from);
    const double off = plane.fixed ? 0 : off_plane(plane.normal, rounding_);
    return std::abs(dot(plane.normal, at(points_, to) - plane.center)) <=
           off * (1 + norm(edge) / (2 * plane.breadth));
  }

  /// Of what touches a face, at least an edge is in its plane: a single point may be by chance.
  void drop_chance_touches() {
    std::vector<std::vector<PointId>> neighbors(points_.size());
    for (const auto& outline : faces_) {
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const PointId a = outline[k], b = outline[k + 1 < outline.size() ? k + 1 : 0];
        at(neighbors, a).push_back(b);
        at(neighbors, b).push_back(a);
      }
    }
    std::vector<PlaneIncidence> kept;
    for (const PlaneIncidence& i : found_.incidences) {
      const auto& near = at(neighbors, i.point);
      if (i.corner || std::any_of(near.begin(), near.end(), [&](PointId p) {
            return stays_on_plane(i.point, p, at(found_.planes, i.plane));
          })) {
        kept.push_back(i);
      }
    }
    found_.incidences = std::move(kept);
    std::erase_if(found_.on_edges,
                  [&](const EdgeIncidence& i) { return !is_on_plane(i.point, i.plane); });
  }

  /// Whether a point that is not its corner lies on a face, and is not known to be on its plane;
  /// adds its place on the face's edges.
  bool touches(std::size_t face, PointId point) {
    const RoundedPlane& plane = at(found_.planes, plane_of_[face]);
    const Vec3& p = at(points_, point);
    const double limit = plane.fixed ? 0 : off_plane(plane.normal, rounding_);
    const auto& outline = faces_[face];
    if (!found_.movable[static_cast<std::size_t>(point)] ||
        std::abs(dot(plane.normal, p - plane.center)) > limit ||
        std::count(outline.begin(), outline.end(), point) > 0) {
      return false;
    }
    const bool on_edge = is_at_corner(face, point) || is_on_edge(face, point);
    return at(known_on_, point) != plane_of_[face] && (on_edge || is_inside(face, p));
  }

  bool is_at_corner(std::size_t face, PointId point) {
    for (const PointId corner : faces_[face]) {
      if (norm(at(points_, corner) - at(points_, point)) <= touching * rounding_) {
        const RoundedPlane& plane = at(found_.planes, plane_of_[face]);
        const Vec3 along = cross(plane.normal, plane.across);
        on_edges_.push_back({face, {point, corner, corner, 0, plane_of_[face], plane.across}});
        on_edges_.push_back({face, {point, corner, corner, 1, plane_of_[face], along}});
        return true;
      }
    }
    return false;
  }

  bool is_on_edge(std::size_t face, PointId point) {
    const auto& outline = faces_[face];
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[k + 1 < outline.size() ? k + 1 : 0];
      const Vec3 from = at(points_, a), edge = at(points_, b) - from;
      const Vec3 offset = at(points_, point) - from;
      const double t = std::clamp(dot(offset, edge) / dot(edge, edge), 0.0, 1.0);
      if (norm(offset - t * edge) <= touching * rounding_) {
        on_edges_.push_back(
            {face,
             {point, a, b, 0, plane_of_[face], normalized(cross(shapes_[face].normal, edge))}});
        return true;
      }
    }
    return false;
  }

  bool is_inside(std::size_t face, const Vec3& p) const {
    const Vec3& normal = shapes_[face].normal;
    const std::vector<PlanePoint> flat = drop_axis(points_, faces_[face], normal);
    // The point in the same coordinates.
    const std::vector<Vec3> one{p};
    const std::array<PointId, 1> first{0};
    const PlanePoint q = drop_axis(one, first, normal)[0];
    bool inside = false;
    for (std::size_t k = 0; k < flat.size(); ++k) {
      const PlanePoint &a = flat[k], &b = flat[k + 1 < flat.size() ? k + 1 : 0];
      if ((a[1] > q[1]) != (b[1] > q[1]) &&
          q[0] < (b[0] - a[0]) * (q[1] - a[1]) / (b[1] - a[1]) + a[0]) {
        inside = !inside;
      }
    }
    return inside;
  }

  /// Three points determine a plane: nothing is to be restored.
  void drop_planes_of_three() {
    std::vector<PlaneIncidence> kept;
    for (std::size_t begin = 0, end = 0; begin < found_.incidences.size(); begin = end) {
      for (end = begin; end < found_.incidences.size() &&
                        found_.incidences[end].plane == found_.incidences[begin].plane;
           ++end) {
      }
      if (end - begin > 3 || at(found_.planes, found_.incidences[begin].plane).fixed) {
        kept.insert(kept.end(), found_.incidences.begin() + static_cast<std::ptrdiff_t>(begin),
                    found_.incidences.begin() + static_cast<std::ptrdiff_t>(end));
      }
    }
    found_.incidences = std::move(kept);
  }

  const std::span<const Vec3> points_;
  const std::vector<std::vector<PointId>>& faces_;
  const double rounding_;
  const Cancellation& cancellation_;
  std::size_t checks_ = 0, comparisons_ = 0;
  double extent_ = 0;  ///< bound on the distance of two points, m
  // Per face.
  std::vector<PolygonShape> shapes_;
  std::vector<bool> takes_part_;
  std::vector<int> exact_axis_;
  std::vector<std::int32_t> plane_of_;

  /// Per point: the plane of the faces being searched, where the point is known to lie on it.
  std::vector<std::int32_t> known_on_;
  /// A point on an edge of a face.
  struct FaceEdge {
    std::size_t face;
    EdgeIncidence edge;
  };
  std::vector<FaceEdge> on_edges_;
  std::vector<Entry> entries_;  ///< sorted by cell, then distance
  std::vector<Cell> cells_;
  PlaneIncidences found_;
};

}  // namespace

PlaneIncidences find_plane_incidences(std::span<const Vec3> points,
                                      const std::vector<std::vector<PointId>>& faces,
                                      double rounding, const Cancellation& cancellation) {
  return IncidenceSearch(points, faces, rounding, cancellation).run();
}

}  // namespace transillum
