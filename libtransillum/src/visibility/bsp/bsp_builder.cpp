// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Input: the pieces of a scene. Polygons in progress are kept in polygons_ and corners_, and become
// fragments of the tree when they lie in the plane of a node. Every edge refers to a line through
// two points of its input edge or cut, so that the engines can clip by the same line on both sides.
#include "visibility/bsp/bsp_builder.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/invariant.h"
#include "scene/build/cover_rank.h"
#include "transillum/at.h"

namespace transillum {
namespace {

std::uint64_t edge_key(PointId a, PointId b) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace

BspBuilder::BspBuilder(const Scene& scene, BspTree& tree, const Cancellation& cancellation,
                       const std::function<void(double)>& progress)
    : scene_(scene),
      tree_(tree),
      cancellation_(cancellation),
      progress_(progress),
      thickness_(BspTree::thickness(scene)),
      search_(thickness_) {}

void BspBuilder::build() {
  add_pieces();
  std::vector<Task> open;
  Task all{{}, BspTree::no_node, true, 1};
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    all.polygons.push_back(static_cast<std::int32_t>(p));
  }
  if (!all.polygons.empty()) {
    open.push_back(std::move(all));
  }

  std::size_t reported = 0;
  while (!open.empty()) {
    cancellation_.throw_if_canceled();
    Task task = std::move(open.back());
    open.pop_back();
    split_node(std::move(task), open);
    if (progress_ && tree_.fragments_.size() >= reported + 512) {
      reported = tree_.fragments_.size();
      progress_(
          std::min(1.0, static_cast<double>(reported) / static_cast<double>(polygons_.size())));
    }
  }
}

void BspBuilder::add_pieces() {
  tree_.points_ = scene_.points();
  piece_planes_.reserve(scene_.pieces().size());
  for (const Piece& piece : scene_.pieces()) {
    check_cancellation();
    const auto points = scene_.corners(piece);
    Polygon polygon{piece.patch, static_cast<std::int32_t>(piece_planes_.size()),
                    static_cast<std::uint32_t>(corners_.size()), 0};
    Vec3 twice_area, sum;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const PointId a = points[k];
      const PointId b = points[(k + 1) % points.size()];
      corners_.push_back({a, line_between(a, b), a < b});
      twice_area = twice_area + cross(scene_.point(a) - scene_.point(points[0]),
                                      scene_.point(b) - scene_.point(points[0]));
      sum = sum + (scene_.point(a) - scene_.point(points[0]));
    }
    polygon.end = static_cast<std::uint32_t>(corners_.size());
    polygons_.push_back(polygon);
    const Vec3 normal = normalized(twice_area);
    const Vec3 center = scene_.point(points[0]) + sum / static_cast<double>(points.size());
    piece_planes_.push_back({normal, dot(normal, center)});
  }
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

PlaneSearch::Choice BspBuilder::choose_plane(const PolygonList& polygons) {
  search_.clear();
  for (const std::int32_t p : polygons) {
    check_cancellation();
    const Polygon& polygon = at(polygons_, p);
    search_.add_polygon(at(piece_planes_, polygon.piece));
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      search_.add_point(at(tree_.points_, corners_[c].point));
    }
  }
  return search_.best();
}

void BspBuilder::split_node(Task task, std::vector<Task>& open) {
  const PlaneSearch::Choice choice = choose_plane(task.polygons);
  const std::int32_t own = choice.polygon < 0 ? -1 : at(task.polygons, choice.polygon);

  // Distribute the polygons to the plane and its sides, cutting those that cross it.
  PolygonList coplanar, front, back;
  cut_of_edge_.clear();
  for (const std::int32_t p : task.polygons) {
    check_cancellation();
    const Side side = p == own ? Side::coplanar : classify(at(polygons_, p), choice.plane);
    switch (side) {
      case Side::coplanar:
        coplanar.push_back(p);
        break;
      case Side::front:
        front.push_back(p);
        break;
      case Side::back:
        back.push_back(p);
        break;
      case Side::both:
        cut(p, front, back);
        break;
    }
  }
  TRANSILLUM_INVARIANT(front.size() < task.polygons.size() && back.size() < task.polygons.size(),
                       "a BSP node makes no progress");

  // Add the node, and leave its sides for later.
  const auto node_id = static_cast<std::int32_t>(tree_.nodes_.size());
  BspTree::Node node;
  node.plane = choice.plane;
  add_coplanar(std::move(coplanar), node);
  tree_.nodes_.push_back(node);
  tree_.depth_ = std::max(tree_.depth_, task.depth);
  if (task.parent != BspTree::no_node) {
    BspTree::Node& parent = at(tree_.nodes_, task.parent);
    (task.front ? parent.front : parent.back) = node_id;
  }
  if (!front.empty()) {
    open.push_back({std::move(front), node_id, true, task.depth + 1});
  }
  if (!back.empty()) {
    open.push_back({std::move(back), node_id, false, task.depth + 1});
  }
}

BspBuilder::Side BspBuilder::classify(const Polygon& polygon, const BspTree::Plane& plane) {
  distances_.clear();
  bool any_front = false, any_back = false;
  for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
    const Vec3& p = at(tree_.points_, corners_[c].point);
    double distance = dot(plane.normal, p) - plane.offset;
    if (std::abs(distance) <= thickness_) {
      distance = 0;
    }
    distances_.push_back(distance);
    any_front |= distance > 0;
    any_back |= distance < 0;
  }
  if (any_front && any_back) {
    return Side::both;
  }
  if (any_front) {
    return Side::front;
  }
  return any_back ? Side::back : Side::coplanar;
}

PointId BspBuilder::cut_edge(PointId a, PointId b, double distance_a, double distance_b) {
  if (a > b) {
    std::swap(a, b);
    std::swap(distance_a, distance_b);
  }
  const auto next = static_cast<PointId>(tree_.points_.size());
  const auto [entry, is_new] = cut_of_edge_.try_emplace(edge_key(a, b), next);
  if (is_new) {
    const double t = distance_a / (distance_a - distance_b);
    const Vec3& from = at(tree_.points_, a);
    const Vec3& to = at(tree_.points_, b);
    tree_.cut_points_.push_back({a, b, t});
    tree_.points_.push_back(from + t * (to - from));
  }
  return entry->second;
}

/// Splits a polygon that classify() has just found on both sides of the plane.
///
///        d>0   o-------x-------o  d<0      x: cut points, made once per edge and plane, so that
///              | front : back  |              neighbors get the same ones
///              o-------x-------o           : the new line, shared by both halves
///
/// The outline is traversed from a corner off the plane. It changes sides at a cut point, or at the
/// first of several consecutive corners on the plane; the others belong to the side that follows,
/// so that the halves have only the new line in common.
void BspBuilder::cut(std::int32_t polygon, PolygonList& front, PolygonList& back) {
  const Polygon whole = at(polygons_, polygon);
  const std::size_t count = whole.end - whole.begin;
  std::size_t start = 0;
  while (distances_[start] == 0) {
    ++start;
  }
  const auto side_of = [&](std::size_t k) { return distances_[k % count] > 0 ? 0 : 1; };
  const auto next_side = [&](std::size_t k) {
    while (distances_[k % count] == 0) {
      ++k;
    }
    return side_of(k);
  };

  std::vector<BspTree::Corner> halves[2];
  std::size_t closing[2] = {0, 0};  // per half: index of the corner from which the new line runs
  PointId turning[2] = {-1, -1};    // and its point, where the polygon's outline leaves that side
  int side = side_of(start);
  const auto change_sides = [&](const BspTree::Corner& corner) {
    halves[side].push_back(corner);
    closing[side] = halves[side].size() - 1;
    turning[side] = corner.point;
    side = 1 - side;
    halves[side].push_back(corner);
  };
  for (std::size_t step = 0; step < count; ++step) {
    const std::size_t k = (start + step) % count;
    const BspTree::Corner corner = corners_[whole.begin + k];
    const double here = distances_[k], there = distances_[(k + 1) % count];
    if (here == 0 && next_side(k) != side) {
      change_sides(corner);
      continue;
    }
    halves[side].push_back(corner);
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const PointId next = corners_[whole.begin + (k + 1) % count].point;
      change_sides({cut_edge(corner.point, next, here, there), corner.line, corner.forward});
    }
  }
  TRANSILLUM_INVARIANT(turning[0] >= 0 && turning[1] >= 0 && turning[0] != turning[1],
                       "the outline of a cut polygon crosses the plane twice");

  const LineId line = line_between(turning[0], turning[1]);
  for (int half = 0; half < 2; ++half) {
    BspTree::Corner& closes = halves[half][closing[half]];
    closes.line = line;
    closes.forward = turning[half] < turning[1 - half];
    Polygon part{whole.patch, whole.piece, static_cast<std::uint32_t>(corners_.size()), 0};
    corners_.insert(corners_.end(), halves[half].begin(), halves[half].end());
    part.end = static_cast<std::uint32_t>(corners_.size());
    (half == 0 ? front : back).push_back(static_cast<std::int32_t>(polygons_.size()));
    polygons_.push_back(part);
  }
}

/// Adds the polygons in a node's plane to the tree as fragments, those that cover others first.
void BspBuilder::add_coplanar(PolygonList coplanar, BspTree::Node& node) {
  const auto faces_along_normal = [&](std::int32_t p) {
    const auto piece = static_cast<std::size_t>(at(polygons_, p).piece);
    return dot(piece_planes_[piece].normal, node.plane.normal) >= 0;
  };
  const auto rank = [&](std::int32_t p) {
    return std::tuple(!faces_along_normal(p), cover_rank(scene_, at(polygons_, p).patch), p);
  };
  std::sort(coplanar.begin(), coplanar.end(),
            [&](std::int32_t a, std::int32_t b) { return rank(a) < rank(b); });

  node.begin = node.middle = static_cast<FragmentId>(tree_.fragments_.size());
  for (const std::int32_t p : coplanar) {
    const Polygon& polygon = at(polygons_, p);
    const auto begin = static_cast<std::uint32_t>(tree_.corners_.size());
    tree_.corners_.insert(tree_.corners_.end(), corners_.begin() + polygon.begin,
                          corners_.begin() + polygon.end);
    tree_.fragments_.push_back(
        {polygon.patch, begin, static_cast<std::uint32_t>(tree_.corners_.size())});
    if (faces_along_normal(p)) {
      ++node.middle;
    }
  }
  node.end = static_cast<FragmentId>(tree_.fragments_.size());
}

}  // namespace transillum
