// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Input: a set of polygons, from BspBuilder. Polygons become fragments of the subtree when they lie
// in the plane of a node. Every edge refers to a line through two points of its input edge or cut,
// so that the engines can clip by the same line on both sides.
//
// Small sets first use clean planes, which cut nothing. So do large sets whose best plane would
// split off a single polygon: they are round, or nearly so, and every plane of a convex surface is
// clean. Then a chain of nodes is made at once; node by node it would take quadratic time.
#include "visibility/bsp/subtree_builder.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/invariant.h"
#include "scene/build/cover_rank.h"
#include "transillum/at.h"
#include "visibility/bsp/edge_key.h"

namespace transillum {
namespace {

/// Sets up to this size are searched for clean planes before any other.
constexpr std::size_t small_set = 128;
/// Larger sets with many one-sided planes are divided first, so that several threads share them.
constexpr std::size_t largest_round_set = 1U << 16;

}  // namespace

SubtreeBuilder::SubtreeBuilder(TreeInput& input)
    : input_(input),
      search_(input.planes, input.thickness),
      clean_planes_(input.planes, input.thickness, [this] { check_cancellation(); }) {}

Subtree SubtreeBuilder::build_root(SubtreeTask task) {
  built_ = {};
  task.parent = BspTree::no_node;
  split(std::move(task));
  return std::move(built_);
}

Subtree SubtreeBuilder::build(SubtreeTask task) {
  built_ = {};
  task.parent = BspTree::no_node;
  built_.open.push_back(std::move(task));
  while (!built_.open.empty()) {
    input_.cancellation.throw_if_canceled();
    SubtreeTask next = std::move(built_.open.back());
    built_.open.pop_back();
    split(std::move(next));
  }
  return std::move(built_);
}

/// To be called in loops over many polygons.
void SubtreeBuilder::check_cancellation() {
  if (++polygons_since_check_ % 4096 == 0) {
    input_.cancellation.throw_if_canceled();
  }
}

/// Makes a node, or several, for a set, and leaves what is beside their planes open.
void SubtreeBuilder::split(SubtreeTask task) {
  const std::size_t open_before = built_.open.size();
  std::int64_t work = BuildProgress::work(task.set.size());
  if (!use_clean_planes(task)) {
    use_best_plane(task);
  }
  for (std::size_t k = open_before; k < built_.open.size(); ++k) {
    work -= BuildProgress::work(built_.open[k].set.size());
  }
  input_.progress.add(work);
}

/// Uses clean planes of a set, if there are any: one-sided ones if they are many, else, in a small
/// set, the one that divides it most evenly.
bool SubtreeBuilder::use_clean_planes(SubtreeTask& task) {
  const std::size_t n = task.set.size();
  if (n > small_set) {
    if (task.peeled || !clean_planes_.many_one_sided(task.set)) {
      return false;
    }
    if (n > largest_round_set) {
      task.peeled = true;
      return false;
    }
  }
  const std::vector<CleanPlanes::Plane>& planes =
      n > small_set ? clean_planes_.find_one_sided(task.set) : clean_planes_.find_all(task.set);
  std::size_t one_sided = 0;
  const CleanPlanes::Plane* most_even = nullptr;
  for (const CleanPlanes::Plane& plane : planes) {
    if (plane.one_sided()) {
      one_sided += 1 + plane.end - plane.begin;
    } else if (!most_even || plane.smaller_side > most_even->smaller_side) {
      most_even = &plane;
    }
  }
  const bool even = most_even && 4 * most_even->smaller_side >= n;
  const bool many_one_sided = 2 * one_sided >= n || (!even && 8 * one_sided >= n);
  if (many_one_sided || (!most_even && one_sided > 0)) {
    add_chain(task, planes);
  } else if (most_even) {
    split_by(task, plane_of(task.set, most_even->polygon), most_even->polygon);
  } else {
    return false;
  }
  return true;
}

/// Uses the plane with the least cost, or all one-sided planes if it is one of these.
void SubtreeBuilder::use_best_plane(SubtreeTask& task) {
  PlaneSearch::Choice choice = search_.best(task.set, !task.peeled);
  if (choice.one_sided) {
    const auto& planes = clean_planes_.find_one_sided(task.set);
    if (!planes.empty()) {
      add_chain(task, planes);
      return;
    }
    choice = search_.best(task.set, false);
  }
  split_by(task, choice.plane, choice.polygon);
}

const BspTree::Plane& SubtreeBuilder::plane_of(const PolygonSet& set, std::int32_t polygon) const {
  return at(input_.planes, at(set.polygons, polygon).plane);
}

/// Adds a chain of nodes with the one-sided planes among those found last, each below the one
/// before, and leaves what is in none of them open. Parts of one piece follow one another.
void SubtreeBuilder::add_chain(SubtreeTask& task, std::vector<CleanPlanes::Plane> planes) {
  std::sort(planes.begin(), planes.end(),
            [](const auto& a, const auto& b) { return a.polygon < b.polygon; });
  std::vector<char> placed(task.set.size(), 0);
  std::vector<std::int32_t> coplanar;
  for (const CleanPlanes::Plane& plane : planes) {
    check_cancellation();
    if (!plane.one_sided() || at(placed, plane.polygon) != 0) {
      continue;
    }
    coplanar.assign(1, plane.polygon);
    for (std::uint32_t k = plane.begin; k < plane.end; ++k) {
      if (at(placed, clean_planes_.in_plane()[k]) == 0) {
        coplanar.push_back(clean_planes_.in_plane()[k]);
      }
    }
    for (const std::int32_t p : coplanar) {
      at(placed, p) = 1;
    }
    task.parent = add_node(task, plane_of(task.set, plane.polygon), coplanar);
    task.front = plane.any_front;
    ++task.depth;
  }

  SubtreeTask rest{{}, task.parent, task.front, task.depth, true};
  for (std::size_t p = 0; p < task.set.size(); ++p) {
    if (placed[p] == 0) {
      rest.set.add(task.set, task.set.polygons[p]);
    }
  }
  if (!rest.set.polygons.empty()) {
    built_.open.push_back(std::move(rest));
  }
}

/// Adds a node with a plane, cuts the polygons that cross it, and leaves its sides open.
/// @param own a polygon in the plane by definition, or -1.
void SubtreeBuilder::split_by(const SubtreeTask& task, const BspTree::Plane& plane,
                              std::int32_t own) {
  std::vector<std::int32_t> coplanar;
  SubtreeTask front{{}, 0, true, task.depth + 1, false}, back{{}, 0, false, task.depth + 1, false};
  cut_of_edge_.clear();
  for (std::size_t p = 0; p < task.set.size(); ++p) {
    check_cancellation();
    const PolygonSet::Polygon& polygon = task.set.polygons[p];
    const auto number = static_cast<std::int32_t>(p);
    const auto [low, high] =
        number == own ? PolygonSet::Extent{0, 0} : task.set.extent(polygon, plane);
    const bool any_front = high > input_.thickness, any_back = low < -input_.thickness;
    if (any_front && any_back) {
      cut(task.set, polygon, plane, front.set, back.set);
    } else if (any_front) {
      front.set.add(task.set, polygon);
    } else if (any_back) {
      back.set.add(task.set, polygon);
    } else {
      coplanar.push_back(number);
    }
  }
  TRANSILLUM_INVARIANT(front.set.size() < task.set.size() && back.set.size() < task.set.size(),
                       "a BSP node makes no progress");

  front.parent = back.parent = add_node(task, plane, std::move(coplanar));
  for (SubtreeTask* side : {&front, &back}) {
    if (!side->set.polygons.empty()) {
      built_.open.push_back(std::move(*side));
    }
  }
}

/// Adds a node and the fragments in its plane.
std::int32_t SubtreeBuilder::add_node(const SubtreeTask& task, const BspTree::Plane& plane,
                                      std::vector<std::int32_t> coplanar) {
  const auto node_id = static_cast<std::int32_t>(built_.nodes.size());
  BspTree::Node node;
  node.plane = plane;
  add_coplanar(task.set, std::move(coplanar), node);
  built_.nodes.push_back(node);
  built_.depth = std::max(built_.depth, task.depth);
  if (task.parent != BspTree::no_node) {
    BspTree::Node& parent = at(built_.nodes, task.parent);
    (task.front ? parent.front : parent.back) = node_id;
  }
  return node_id;
}

/// The point where a plane cuts an edge, by its index in built_.points; the same for all polygons
/// with this edge.
std::size_t SubtreeBuilder::cut_edge(const End& from, const End& to) {
  if (from.point > to.point) {
    return cut_edge(to, from);
  }
  const auto [entry, is_new] =
      cut_of_edge_.try_emplace(edge_key(from.point, to.point), built_.points.size());
  if (is_new) {
    const double t = from.distance / (from.distance - to.distance);
    const PointId id = input_.next_point.fetch_add(1, std::memory_order_relaxed);
    built_.points.push_back(
        {id, {from.point, to.point, t}, from.place + t * (to.place - from.place)});
  }
  return entry->second;
}

/// Splits a polygon that is on both sides of a plane.
///
///        d>0   o-------x-------o  d<0      x: cut points, made once per edge and plane, so that
///              | front : back  |              neighbors get the same ones
///              o-------x-------o           : the new line, shared by both halves
///
/// The outline is traversed from a corner off the plane. It changes sides at a cut point, or at the
/// first of several consecutive corners on the plane; the others belong to the side that follows,
/// so that the halves have only the new line in common.
void SubtreeBuilder::cut(const PolygonSet& set, const PolygonSet::Polygon& whole,
                         const BspTree::Plane& plane, PolygonSet& front, PolygonSet& back) {
  const std::size_t count = whole.end - whole.begin;
  ends_.clear();
  for (std::uint32_t c = whole.begin; c < whole.end; ++c) {
    const double distance = dot(plane.normal, set.places[c]) - plane.offset;
    ends_.push_back({set.corners[c].point, set.places[c],
                     std::abs(distance) <= input_.thickness ? 0.0 : distance});
  }
  std::size_t start = 0;
  while (ends_[start].distance == 0) {
    ++start;
  }
  const auto next_side = [&](std::size_t k) {
    while (ends_[k % count].distance == 0) {
      ++k;
    }
    return ends_[k % count].distance > 0 ? 0 : 1;
  };

  PolygonSet* const halves[2] = {&front, &back};
  const std::size_t begin[2] = {front.corners.size(), back.corners.size()};
  std::size_t closing[2] = {0, 0};  // per half: the corner from which the new line runs
  PointId turning[2] = {-1, -1};    // and its point, where the polygon's outline leaves that side
  int side = next_side(start);
  const auto add = [&](const BspTree::Corner& corner, const Vec3& place) {
    halves[side]->corners.push_back(corner);
    halves[side]->places.push_back(place);
  };
  const auto change_sides = [&](const BspTree::Corner& corner, const Vec3& place) {
    closing[side] = halves[side]->corners.size();
    turning[side] = corner.point;
    add(corner, place);
    side = 1 - side;
    add(corner, place);
  };
  for (std::size_t step = 0; step < count; ++step) {
    const std::size_t k = (start + step) % count;
    const BspTree::Corner corner = set.corners[whole.begin + k];
    const End &here = ends_[k], &there = ends_[(k + 1) % count];
    if (here.distance == 0 && next_side(k) != side) {
      change_sides(corner, here.place);
      continue;
    }
    add(corner, here.place);
    if ((here.distance > 0 && there.distance < 0) || (here.distance < 0 && there.distance > 0)) {
      const Subtree::NewPoint& made = built_.points[cut_edge(here, there)];
      change_sides({made.id, corner.line, corner.forward}, made.place);
    }
  }
  TRANSILLUM_INVARIANT(turning[0] >= 0 && turning[1] >= 0 && turning[0] != turning[1],
                       "the outline of a cut polygon crosses the plane twice");

  const LineId line = input_.next_line.fetch_add(1, std::memory_order_relaxed);
  built_.lines.push_back(
      {line, {std::min(turning[0], turning[1]), std::max(turning[0], turning[1])}});
  for (int half = 0; half < 2; ++half) {
    BspTree::Corner& closes = halves[half]->corners[closing[half]];
    closes.line = line;
    closes.forward = turning[half] < turning[1 - half];
    halves[half]->polygons.push_back({whole.patch, whole.plane,
                                      static_cast<std::uint32_t>(begin[half]),
                                      static_cast<std::uint32_t>(halves[half]->corners.size())});
  }
}

/// Adds the polygons in a node's plane to the tree as fragments, those that cover others first.
void SubtreeBuilder::add_coplanar(const PolygonSet& set, std::vector<std::int32_t> coplanar,
                                  BspTree::Node& node) {
  const auto faces_along_normal = [&](std::int32_t p) {
    return dot(plane_of(set, p).normal, node.plane.normal) >= 0;
  };
  if (coplanar.size() > 1) {
    const auto rank = [&](std::int32_t p) {
      return std::tuple(!faces_along_normal(p), cover_rank(input_.scene, at(set.polygons, p).patch),
                        p);
    };
    std::sort(coplanar.begin(), coplanar.end(),
              [&](std::int32_t a, std::int32_t b) { return rank(a) < rank(b); });
  }

  node.begin = node.middle = static_cast<FragmentId>(built_.fragments.size());
  for (const std::int32_t p : coplanar) {
    const PolygonSet::Polygon& polygon = at(set.polygons, p);
    const auto begin = static_cast<std::uint32_t>(built_.corners.size());
    built_.corners.insert(built_.corners.end(), set.corners.begin() + polygon.begin,
                          set.corners.begin() + polygon.end);
    built_.fragments.push_back(
        {polygon.patch, begin, static_cast<std::uint32_t>(built_.corners.size())});
    if (faces_along_normal(p)) {
      ++node.middle;
    }
  }
  node.end = static_cast<FragmentId>(built_.fragments.size());
}

}  // namespace transillum
