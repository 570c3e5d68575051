// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Input: the pieces of a scene. SubtreeBuilder orders them. Which part of the tree is built by one
// task depends only on the sizes of sets, and parts are joined in the order of a traversal of the
// tree, so the numbers of nodes, fragments, points and lines are the same for any number of
// threads.
#include "visibility/bsp/bsp_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/for_each_index.h"
#include "transillum/at.h"
#include "visibility/bsp/edge_key.h"

namespace transillum {
namespace {

/// Larger sets are split node by node, others are each built by one task.
constexpr std::size_t largest_part = 2048;

/// a·d − b·c, right to a few units in the last place of the result, however much cancels (Kahan).
double difference_of_products(double a, double d, double b, double c) {
  const double bc = b * c;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

/// cross(a, b) for vectors that are nearly parallel.
Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

}  // namespace

BspBuilder::BspBuilder(const Scene& scene, BspTree& tree, const Cancellation& cancellation,
                       const std::function<void(double)>& progress)
    : scene_(scene),
      tree_(tree),
      cancellation_(cancellation),
      progress_(progress),
      thickness_(BspTree::thickness(scene)) {}

void BspBuilder::build(int threads) {
  add_pieces();
  if (polygons_.empty()) {
    return;
  }
  BuildProgress progress(polygons_.size(), progress_);
  first_new_point_ = static_cast<PointId>(tree_.points_.size());
  first_new_line_ = static_cast<LineId>(tree_.lines_.size());
  TreeInput input{scene_,   planes_,          thickness_,     cancellation_,
                  progress, first_new_point_, first_new_line_};
  build_parts(input, threads);
  join_parts(input);
}

/// All polygons as one set.
PolygonSet BspBuilder::take_polygons() {
  PolygonSet set;
  set.polygons.reserve(polygons_.size());
  set.places.reserve(corners_.size());
  for (const Polygon& polygon : polygons_) {
    check_cancellation();
    set.polygons.push_back({polygon.patch, polygon.plane, polygon.begin, polygon.end});
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      set.places.push_back(at(tree_.points_, corners_[c].point));
    }
  }
  set.corners = std::move(corners_);
  polygons_ = {};
  return set;
}

/// Splits large sets node by node, all nodes of one level in parallel; then builds the many
/// subtrees of
/// the small ones.
void BspBuilder::build_parts(TreeInput& input, int threads) {
  std::vector<SubtreeTask> tasks(1);
  tasks[0].set = take_polygons();
  open_subtrees_.resize(1);
  if (tasks[0].set.size() <= largest_part) {
    open_subtrees_[0].subtree = SubtreeBuilder(input).build(std::move(tasks[0]));
    return;
  }

  WorkerThreads workers(thread_count(threads));
  std::vector<std::size_t> level{0}, small;  // numbers of tasks
  const auto run = [&](const std::vector<std::size_t>& numbers, auto method) {
    for_each_index(workers, std::size_t{0}, numbers.size(), [&](std::size_t k) {
      SubtreeBuilder builder(input);
      open_subtrees_[numbers[k]].subtree = (builder.*method)(std::move(tasks[numbers[k]]));
    });
  };
  while (!level.empty()) {
    cancellation_.throw_if_canceled();
    run(level, &SubtreeBuilder::build_root);
    std::vector<std::size_t> next;
    for (const std::size_t number : level) {
      open_subtrees_[number].first_child = tasks.size();
      for (SubtreeTask& open : open_subtrees_[number].subtree.open) {
        (open.set.size() > largest_part ? next : small).push_back(tasks.size());
        tasks.push_back({std::move(open.set), BspTree::no_node, true, open.depth, open.peeled});
      }
    }
    open_subtrees_.resize(tasks.size());
    level = std::move(next);
  }
  run(small, &SubtreeBuilder::build);
}

/// Appends all parts to the tree, each before its children.
void BspBuilder::join_parts(const TreeInput& input) {
  point_numbers_.resize(static_cast<std::size_t>(input.next_point - first_new_point_));
  line_numbers_.resize(static_cast<std::size_t>(input.next_line - first_new_line_));
  struct Open {
    std::size_t subtree_part;
    std::int32_t parent;
    bool front;
  };
  std::vector<Open> open{{0, BspTree::no_node, true}};
  while (!open.empty()) {
    cancellation_.throw_if_canceled();
    const Open next = open.back();
    open.pop_back();
    const auto root = static_cast<std::int32_t>(tree_.nodes_.size());
    if (next.parent != BspTree::no_node) {
      BspTree::Node& parent = at(tree_.nodes_, next.parent);
      (next.front ? parent.front : parent.back) = root;
    }
    OpenSubtree& subtree_part = open_subtrees_[next.subtree_part];
    join(subtree_part.subtree);
    for (std::size_t k = 0; k < subtree_part.subtree.open.size(); ++k) {
      const SubtreeTask& child = subtree_part.subtree.open[k];
      open.push_back({subtree_part.first_child + k, root + child.parent, child.front});
    }
    subtree_part.subtree = {};
  }
}

/// Appends one part to the tree, and gives its points and lines their numbers.
void BspBuilder::join(Subtree& subtree_part) {
  const auto point = [&](PointId p) {
    return p < first_new_point_ ? p : at(point_numbers_, p - first_new_point_);
  };
  for (const Subtree::NewPoint& made : subtree_part.points) {
    at(point_numbers_, made.id - first_new_point_) = static_cast<PointId>(tree_.points_.size());
    tree_.points_.push_back(made.place);
    tree_.cut_points_.push_back({point(made.cut.a), point(made.cut.b), made.cut.t});
  }
  for (const Subtree::NewLine& made : subtree_part.lines) {
    at(line_numbers_, made.id - first_new_line_) =
        line_between(point(made.line.a), point(made.line.b));
  }

  const auto first_corner = static_cast<std::uint32_t>(tree_.corners_.size());
  for (const BspTree::Corner& corner : subtree_part.corners) {
    const LineId line = corner.line < first_new_line_
                            ? corner.line
                            : at(line_numbers_, corner.line - first_new_line_);
    tree_.corners_.push_back({point(corner.point), line, corner.forward});
  }
  const auto first_fragment = static_cast<FragmentId>(tree_.fragments_.size());
  for (const BspTree::Fragment& f : subtree_part.fragments) {
    tree_.fragments_.push_back({f.patch, first_corner + f.begin, first_corner + f.end});
  }
  const auto first_node = static_cast<std::int32_t>(tree_.nodes_.size());
  for (BspTree::Node node : subtree_part.nodes) {
    for (std::int32_t* child : {&node.front, &node.back}) {
      *child += *child == BspTree::no_node ? 0 : first_node;
    }
    for (FragmentId* f : {&node.begin, &node.middle, &node.end}) {
      *f += first_fragment;
    }
    tree_.nodes_.push_back(node);
  }
  tree_.depth_ = std::max(tree_.depth_, subtree_part.depth);
}

/// All patches of a divided face have the plane of the face. The corners of one small patch are
/// rounded by much for its size: a plane through them would miss the far end of the face, or a face
/// that touches it, by more than the thickness of planes. Patches that are bent by more than the
/// rounding of their corners keep their own planes: by a common plane, strips of the bend's width
/// could be lost.
void BspBuilder::add_pieces() {
  tree_.points_ = scene_.points();
  const std::vector<Piece>& pieces = scene_.pieces();
  planes_.reserve(pieces.size());
  const auto face_of = [&](const Piece& piece) { return scene_.patch(piece.patch).face; };
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    while (end < pieces.size() && face_of(pieces[end]) == face_of(pieces[begin])) {
      ++end;
    }
    const std::span<const Piece> face(pieces.data() + begin, end - begin);
    const BspTree::Plane front = plane_of(face);
    for (const Piece& piece : face) {
      check_cancellation();
      const auto points = scene_.corners(piece);
      const BspTree::Plane own = plane_of(points);
      const bool is_flat = face.size() > 1 && contains(front, points, thickness_ / 16);
      const double side = dot(own.normal, front.normal) >= 0 ? 1 : -1;
      const BspTree::Plane common{side * front.normal, side * front.offset};
      add_piece(piece, is_flat ? common : own);
    }
  }
}

/// A piece that is planar only within the rounding of a file becomes triangles.
void BspBuilder::add_piece(const Piece& piece, const BspTree::Plane& plane) {
  const auto points = scene_.corners(piece);
  if (points.size() == 3) {
    add_triangle(piece.patch, {points[0], points[1], points[2]}, plane);
    return;
  }
  if (contains(plane, points, thickness_)) {
    add_polygon(piece.patch, points);
    planes_.push_back(plane);
    return;
  }
  // A fan from the corner that makes the first fold a ridge: surfaces seen from outside stay
  // convex.
  const Vec3& origin = scene_.point(points[0]);
  const Vec3 normal = cross(scene_.point(points[1]) - origin, scene_.point(points[2]) - origin);
  const std::size_t start = dot(normal, scene_.point(points[3]) - origin) > 0 ? 1 : 0;
  const auto corner = [&](std::size_t k) { return points[(start + k) % points.size()]; };
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const std::array<PointId, 3> triangle{corner(0), corner(k), corner(k + 1)};
    add_triangle(piece.patch, triangle, plane_of(triangle));
  }
}

/// A long needle's own corners may miss its plane, when its normal has lost the digits that cancel
/// in the vector product. Another triangle with the same corners would then be cut by that plane,
/// and parts of both would face each other.
void BspBuilder::add_triangle(PatchId patch, const std::array<PointId, 3>& points,
                              BspTree::Plane plane) {
  add_polygon(patch, points);
  if (!contains(plane, points, thickness_)) {
    const Vec3 &a = scene_.point(points[0]), &b = scene_.point(points[1]),
               &c = scene_.point(points[2]);
    plane.normal = normalized(accurate_cross(b - a, c - a));
    plane.offset = dot(plane.normal, a + (b - a) / 3 + (c - a) / 3);
  }
  planes_.push_back(plane);
}

void BspBuilder::add_polygon(PatchId patch, std::span<const PointId> points) {
  Polygon polygon{patch, static_cast<std::int32_t>(planes_.size()),
                  static_cast<std::uint32_t>(corners_.size()), 0};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PointId a = points[k];
    const PointId b = points[(k + 1) % points.size()];
    corners_.push_back({a, line_between(a, b), a < b});
  }
  polygon.end = static_cast<std::uint32_t>(corners_.size());
  polygons_.push_back(polygon);
}

BspTree::Plane BspBuilder::plane_of(std::span<const PointId> points) const {
  const Vec3& origin = scene_.point(points[0]);
  Vec3 twice_area, sum;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& a = scene_.point(points[k]);
    const Vec3& b = scene_.point(points[(k + 1) % points.size()]);
    twice_area = twice_area + cross(a - origin, b - origin);
    sum = sum + (a - origin);
  }
  const Vec3 normal = normalized(twice_area);
  return {normal, dot(normal, origin + sum / static_cast<double>(points.size()))};
}

/// The plane through the pieces of one face. Sums over many thousands of pieces are relative to a
/// corner, in long double, so that they are as exact as the coordinates of a corner.
BspTree::Plane BspBuilder::plane_of(std::span<const Piece> pieces) const {
  if (pieces.size() == 1) {
    return plane_of(scene_.corners(pieces[0]));
  }
  using Sum = std::array<long double, 3>;
  const auto add = [](Sum& sum, double factor, const Vec3& v) {
    sum[0] += factor * v.x;
    sum[1] += factor * v.y;
    sum[2] += factor * v.z;
  };
  const auto rounded = [](const Sum& sum, long double divisor) {
    return Vec3{static_cast<double>(sum[0] / divisor), static_cast<double>(sum[1] / divisor),
                static_cast<double>(sum[2] / divisor)};
  };
  const Vec3 start = scene_.point(scene_.corners(pieces[0])[0]);
  Vec3 first;
  Sum areas{}, moments{};
  long double weights = 0;
  for (const Piece& piece : pieces) {
    const auto points = scene_.corners(piece);
    const Vec3& origin = scene_.point(points[0]);
    Vec3 twice_area, corners;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3& a = scene_.point(points[k]);
      const Vec3& b = scene_.point(points[(k + 1) % points.size()]);
      twice_area = twice_area + cross(a - origin, b - origin);
      corners = corners + (a - start);
    }
    first = weights > 0 ? first : twice_area;
    const double weight = norm(twice_area);
    add(areas, dot(first, twice_area) >= 0 ? 1 : -1, twice_area);
    add(moments, weight / static_cast<double>(points.size()), corners);
    weights += weight;
  }
  const Vec3 normal = normalized(rounded(areas, weights));
  return {normal, dot(normal, start + rounded(moments, weights))};
}

bool BspBuilder::contains(const BspTree::Plane& plane, std::span<const PointId> points,
                          double distance) const {
  return std::all_of(points.begin(), points.end(), [&](PointId p) {
    return std::abs(dot(plane.normal, scene_.point(p)) - plane.offset) <= distance;
  });
}

/// To be called in loops over many polygons.
void BspBuilder::check_cancellation() {
  if (++polygons_since_check_ % 4096 == 0) {
    cancellation_.throw_if_canceled();
  }
}

LineId BspBuilder::line_between(PointId a, PointId b) {
  const auto [entry, is_new] =
      line_of_edge_.try_emplace(edge_key(a, b), static_cast<LineId>(tree_.lines_.size()));
  if (is_new) {
    tree_.lines_.push_back({std::min(a, b), std::max(a, b)});
  }
  return entry->second;
}

}  // namespace transillum
