// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Undoing the rounding of a file. Unknowns are the moves of points and planes; each incidence of a
// point and a plane is an equation. Newton's method takes the smallest moves that solve them. Where
// a point would move farther than rounding explains, what it touches was a coincidence: those
// incidences are given up, and the rest is solved again.
#include "scene/build/rounding_repair.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "scene/build/plane_incidences.h"
#include "scene/build/point_table.h"
#include "scene/build/precision.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr int most_steps = 8;        ///< of Newton's method
constexpr int most_attempts = 6;     ///< of giving up incidences
constexpr double farthest_move = 8;  ///< of a point, relative to the rounding of a coordinate
constexpr double solver_tolerance = 1e-4;
constexpr int most_solver_iterations = 300;
/// Bounds of the iterations of all rounds: 60,000 incidences need about 450. Fine round meshes,
/// bent by no more than rounding, would need thousands.
constexpr std::int64_t fewest_iterations = 500, most_work = 100'000'000;

bool is_corner(const PlaneIncidence& i) { return i.corner; }
bool is_corner(const EdgeIncidence&) { return false; }

/// One equation: a linear combination of moves that changes the residual to 0.
struct Equation {
  double residual = 0;            ///< m
  std::vector<PointId> points;    ///< whose moves occur
  std::vector<Vec3> weights;      ///< of their moves
  std::int32_t plane = no_plane;  ///< whose move occurs
  Vec3 plane_weight;
  static constexpr std::int32_t no_plane = -1;
};

/// The smallest least squares solution, by conjugate gradients. (As Eigen's solver, which cannot be
/// interrupted.)
/// @param iterations_left decreased by those made; if it reaches 0, the solution is unfinished.
Eigen::VectorXd least_squares(const Eigen::SparseMatrix<double>& matrix,
                              const Eigen::VectorXd& right, std::int64_t& iterations_left,
                              const Cancellation& cancellation) {
  Eigen::VectorXd scale(matrix.cols());
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    const double size = matrix.col(k).squaredNorm();
    scale[k] = size > 0 ? 1 / size : 1;
  }
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(matrix.cols());
  Eigen::VectorXd rest = right;
  Eigen::VectorXd gradient = matrix.transpose() * rest;
  Eigen::VectorXd direction = scale.cwiseProduct(gradient);
  const double enough = solver_tolerance * gradient.norm();
  double size = gradient.dot(direction);
  for (int k = 0; k < most_solver_iterations && iterations_left > 0 && gradient.norm() > enough;
       ++k, --iterations_left) {
    cancellation.throw_if_canceled();
    const Eigen::VectorXd change = matrix * direction;
    const double step = size / change.squaredNorm();
    solution += step * direction;
    rest -= step * change;
    gradient = matrix.transpose() * rest;
    const Eigen::VectorXd scaled = scale.cwiseProduct(gradient);
    const double before = size;
    size = gradient.dot(scaled);
    direction = scaled + (size / before) * direction;
  }
  return solution;
}

/// Newton's method for points on planes and edges.
class Adjustment {
 public:
  /// @param original positions
  Adjustment(const std::vector<Vec3>& original, const PlaneIncidences& found)
      : points(original), found_(found), planes_(found.planes) {}

  /// Solves the equations to within `goal`, m, as far as possible with moves of at most `reach`, m.
  /// Returns the largest residual.
  double solve(double goal, double reach, std::int64_t& iterations_left,
               const Cancellation& cancellation) {
    number_unknowns();
    double worst = set_up(), before = HUGE_VAL;
    for (int step = 0;
         step < most_steps && iterations_left > 0 && worst > goal && worst < 0.5 * before; ++step) {
      cancellation.throw_if_canceled();
      before = worst;
      move(smallest_moves(iterations_left, cancellation), reach);
      worst = set_up();
    }
    return worst;
  }
  double residual(const PlaneIncidence& i) const {
    const RoundedPlane& plane = at(planes_, i.plane);
    return dot(plane.normal, at(points, i.point) - plane.center);
  }
  double residual(const EdgeIncidence& i) const {
    const double t = along(i);
    return dot(i.across,
               at(points, i.point) - ((1 - t) * at(points, i.from) + t * at(points, i.to)));
  }

  std::vector<Vec3> points;

 private:
  /// The fraction of an edge from its start to where a point is nearest.
  double along(const EdgeIncidence& i) const {
    if (i.from == i.to) {
      return 0;
    }
    const Vec3 from = at(points, i.from), edge = at(points, i.to) - from;
    return dot(at(points, i.point) - from, edge) / dot(edge, edge);
  }

  void number_unknowns() {
    point_column_.assign(points.size(), -1);
    plane_column_.assign(planes_.size(), -1);
    columns_ = 0;
    const auto number = [&](PointId p) {
      if (found_.movable[static_cast<std::size_t>(p)] && at(point_column_, p) < 0) {
        at(point_column_, p) = columns_;
        columns_ += 3;
      }
    };
    for (const PlaneIncidence& i : found_.incidences) {
      number(i.point);
    }
    for (const EdgeIncidence& i : found_.on_edges) {
      number(i.point);
      number(i.from);
      number(i.to);
    }
  }

  /// Sets up the equations for the present positions. Returns the largest residual.
  double set_up() {
    equations_.clear();
    const auto& all = found_.incidences;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      while (end < all.size() && all[end].plane == all[begin].plane) {
        ++end;
      }
      if (end - begin == 4 && !at(planes_, all[begin].plane).fixed) {
        add_quadrilateral(&all[begin]);
      } else {
        add_plane(&all[begin], end - begin);
      }
    }
    for (const EdgeIncidence& i : found_.on_edges) {
      const double t = along(i);
      equations_.push_back({residual(i),
                            {i.point, i.from, i.to},
                            {i.across, (t - 1) * i.across, -t * i.across},
                            Equation::no_plane,
                            {}});
    }
    double worst = 0;
    for (const Equation& e : equations_) {
      worst = std::max(worst, std::abs(e.residual));
    }
    return worst;
  }

  /// Four points are in one plane: their combination that eliminates the plane.
  void add_quadrilateral(const PlaneIncidence* four) {
    const std::array<Vec3, 4> p{at(points, four[0].point), at(points, four[1].point),
                                at(points, four[2].point), at(points, four[3].point)};
    RoundedPlane& plane = at(planes_, four[0].plane);
    const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
      return dot(plane.normal, cross(p[b] - p[a], p[c] - p[a]));
    };
    const std::array<double, 4> areas{area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2)};
    double size = 0;
    for (const double a : areas) {
      size += std::abs(a);
    }
    Equation e;
    Vec3 sum;
    for (std::size_t k = 0; k < 4; ++k) {
      e.points.push_back(four[k].point);
      e.weights.push_back((areas[k] / size) * plane.normal);
      sum = sum + (areas[k] / size) * (p[k] - p[0]);
    }
    e.residual = dot(plane.normal, sum);
    equations_.push_back(std::move(e));
  }

  void add_plane(const PlaneIncidence* first, std::size_t count) {
    RoundedPlane& plane = at(planes_, first->plane);
    if (!plane.fixed && at(plane_column_, first->plane) < 0) {
      at(plane_column_, first->plane) = columns_;
      columns_ += 3;
    }
    const Vec3 u = plane.across / plane.breadth;
    const Vec3 v = cross(plane.normal, plane.across) / plane.length;
    for (std::size_t k = 0; k < count; ++k) {
      const PointId p = first[k].point;
      const Vec3 arm = at(points, p) - plane.center;
      equations_.push_back({residual(first[k]),
                            {p},
                            {plane.normal},
                            plane.fixed ? Equation::no_plane : first->plane,
                            {dot(u, arm), dot(v, arm), -1}});
    }
  }

  /// The smallest moves that solve the equations; of points, then planes.
  Eigen::VectorXd smallest_moves(std::int64_t& iterations_left,
                                 const Cancellation& cancellation) const {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(static_cast<Eigen::Index>(equations_.size()));
    for (std::size_t row = 0; row < equations_.size(); ++row) {
      const Equation& e = equations_[row];
      const auto add = [&](int column, const Vec3& v) {
        if (column >= 0) {
          const auto r = static_cast<int>(row);
          entries.emplace_back(r, column, v.x);
          entries.emplace_back(r, column + 1, v.y);
          entries.emplace_back(r, column + 2, v.z);
        }
      };
      for (std::size_t k = 0; k < e.points.size(); ++k) {
        add(at(point_column_, e.points[k]), e.weights[k]);
      }
      if (e.plane != Equation::no_plane) {
        add(at(plane_column_, e.plane), e.plane_weight);
      }
      right[static_cast<Eigen::Index>(row)] = -e.residual;
    }
    Eigen::SparseMatrix<double> matrix(right.size(), columns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return least_squares(matrix, right, iterations_left, cancellation);
  }

  void move(const Eigen::VectorXd& moves, double reach) {
    const auto triple = [&](int column) {
      const Vec3 v{moves[column], moves[column + 1], moves[column + 2]};
      const double size = norm(v);
      return size > reach ? (reach / size) * v : v;
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (point_column_[k] >= 0) {
        points[k] = points[k] + triple(point_column_[k]);
      }
    }
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (plane_column_[k] < 0) {
        continue;
      }
      RoundedPlane& plane = planes_[k];
      const Vec3 turn = triple(plane_column_[k]);
      plane.center = plane.center + turn.z * plane.normal;
      plane.normal = normalized(plane.normal + (turn.x / plane.breadth) * plane.across +
                                (turn.y / plane.length) * cross(plane.normal, plane.across));
      plane.across = normalized(plane.across - dot(plane.across, plane.normal) * plane.normal);
    }
    refit_quadrilaterals();
  }

  /// Planes of four points have no unknowns of their own.
  void refit_quadrilaterals() {
    const auto& all = found_.incidences;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      while (end < all.size() && all[end].plane == all[begin].plane) {
        ++end;
      }
      RoundedPlane& plane = at(planes_, all[begin].plane);
      if (plane_column_[static_cast<std::size_t>(all[begin].plane)] >= 0 || plane.fixed ||
          end - begin != 4) {
        continue;
      }
      Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
      Vec3 center;
      for (std::size_t k = begin; k < end; ++k) {
        center = center + 0.25 * at(points, all[k].point);
      }
      for (std::size_t k = begin; k < end; ++k) {
        const Vec3 d = at(points, all[k].point) - center;
        const Eigen::Vector3d e(d.x, d.y, d.z);
        products += e * e.transpose();
      }
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(products);
      const auto n = axes.eigenvectors().col(0);
      const Vec3 normal{n[0], n[1], n[2]};
      plane.normal = dot(normal, plane.normal) < 0 ? -normal : normal;
      plane.center = center;
    }
  }

  const PlaneIncidences& found_;
  std::vector<RoundedPlane> planes_;
  std::vector<int> point_column_, plane_column_;  ///< first of three, or -1
  int columns_ = 0;
  std::vector<Equation> equations_;
};

/// The faces of a description as outlines over its distinct points.
struct WeldedFaces {
  PointTable table;
  std::vector<PointId> welded;  ///< per point of the description, or -1: not used
  std::vector<std::vector<PointId>> faces;
  double largest = 0;  ///< coordinate of a used point, m

  explicit WeldedFaces(const SceneDescription& description)
      : welded(description.points.size(), -1) {
    for (std::size_t f = 0; f < description.face_count(); ++f) {
      faces.push_back(welded_outline(description.outline(f), description.points, welded, table));
    }
    for (const Vec3& p : table.points()) {
      largest = std::max(largest, max_abs(p));
    }
  }
};

/// Removes the incidences that `drop` selects. Returns how many.
template <class Drop>
std::size_t give_up(PlaneIncidences& found, const Drop& drop) {
  return std::erase_if(found.incidences, drop) + std::erase_if(found.on_edges, drop);
}

/// Points on planes along two axes keep the coordinate that they share.
void keep_exact_coordinates(const std::vector<Vec3>& original, const PlaneIncidences& found,
                            std::vector<Vec3>& points) {
  for (const PlaneIncidence& i : found.incidences) {
    const RoundedPlane& plane = at(found.planes, i.plane);
    if (plane.fixed) {
      Vec3& p = at(points, i.point);
      const Vec3& q = at(original, i.point);
      p = {plane.normal.x != 0 ? q.x : p.x, plane.normal.y != 0 ? q.y : p.y,
           plane.normal.z != 0 ? q.z : p.z};
    }
  }
}

/// The points moved so that they are on their planes and edges; the original ones if that fails.
std::vector<Vec3> adjusted(const std::vector<Vec3>& original, PlaneIncidences found,
                           double rounding, double goal, const Cancellation& cancellation) {
  const double reach = farthest_move * rounding;
  const std::size_t count = found.incidences.size() + found.on_edges.size();
  std::int64_t iterations_left =
      std::max(fewest_iterations, most_work / static_cast<std::int64_t>(count + 1));
  for (int attempt = 0; attempt < most_attempts && iterations_left > 0; ++attempt) {
    Adjustment adjustment(original, found);
    const double worst = adjustment.solve(goal, reach, iterations_left, cancellation);
    const auto is_far = [&](PointId p) {
      return norm(at(adjustment.points, p) - at(original, p)) > reach;
    };
    const auto moves_far = [&](const auto& i) {
      if constexpr (std::is_same_v<decltype(i), const EdgeIncidence&>) {
        return is_far(i.point) || is_far(i.from) || is_far(i.to);
      } else {
        return is_far(i.point);
      }
    };
    const double limit = std::max(goal, 0.25 * worst);
    const std::size_t all = found.incidences.size() + found.on_edges.size();
    const auto contradicts = [&](const auto& i) {
      return moves_far(i) || std::abs(adjustment.residual(i)) > limit;
    };
    PlaneIncidences kept = found;
    const std::size_t dropped = give_up(kept, contradicts);
    if (dropped == 0) {
      keep_exact_coordinates(original, found, adjustment.points);
      return std::move(adjustment.points);
    }
    if (10 * dropped > all) {
      // Too coarse to tell what touches from what is near.
      give_up(kept, [](const auto& i) { return !is_corner(i); });
    }
    found = std::move(kept);
  }
  return original;
}

}  // namespace

std::vector<Vec3> without_rounding(const SceneDescription& description, double rounding,
                                   const Cancellation& cancellation) {
  WeldedFaces welded(description);
  const double goal = 16 * epsilon * welded.largest;
  std::vector<Vec3> result = description.points;
  if (rounding <= 4 * goal) {
    return result;
  }
  const std::vector<Vec3> original = welded.table.take();
  const std::vector<Vec3> points =
      adjusted(original, find_plane_incidences(original, welded.faces, rounding, cancellation),
               rounding, goal, cancellation);
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (welded.welded[k] >= 0) {
      result[k] = at(points, welded.welded[k]);
    }
  }
  return result;
}

}  // namespace transillum
