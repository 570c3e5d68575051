// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Input: the pieces of a scene. The constructor finds the blockers (merged pieces, in a box tree)
// and the parts of the patches that coplanar patches do not cover; a query then clips each pair of
// parts to their front sides and computes the exchange in closed form, or by points if anything
// blocks it (decisions/0021-exact-pairs.md).
#include "visibility/pairs/patch_exchange.h"

#include <algorithm>
#include <cmath>

#include "base/power_of_two.h"
#include "scene/build/cover_rank.h"
#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "visibility/pairs/merged_pieces.h"
#include "visibility/pairs/shaft.h"

namespace transillum {
namespace {

/// Divisions of a cell from which its moments are computed: half of them still have three points,
/// whose rule is exact for products of two linear functions. With a low density, errors do not
/// matter.
int fewest_for_moments(double density) {
  constexpr double low_density = 4;
  return density > low_density ? 2 : 1;
}

Bounds bounds_of(Outline polygon) {
  Bounds box;
  for (const Vec3& corner : polygon) {
    box.add(corner);
  }
  return box;
}

Corners scaled(Corners polygon, double scale) {
  for (Vec3& corner : polygon) {
    corner = scale * corner;
  }
  return polygon;
}

}  // namespace

ExchangeFinder::ExchangeFinder(const Scene& scene, const Cancellation& cancellation, double density)
    : scene_(scene),
      density_(density),
      moment_divisions_(fewest_for_moments(density)),
      scale_(scale_to_one(scene.bounds().diagonal())),
      tolerance_(scale_ *
                 std::max(1e-12 * scene.bounds().diagonal(), 2 * BspTree::thickness(scene))),
      first_sides_(first_sides(scene)),
      blockers_(blockers_of(scene)),
      tree_(boxes_of(blockers_)),
      open_begin_(static_cast<std::size_t>(scene.patch_count()) + 1) {
  const std::vector<Piece> uppermost = uppermost_pieces(scene);
  std::vector<Bounds> boxes;
  for (const Piece& piece : uppermost) {
    boxes.push_back(bounds_of(corners_of(piece)));
  }
  const BoxTree tree(boxes);
  open_pieces_.reserve(uppermost.size());
  for (const Piece& piece : uppermost) {
    cancellation.throw_if_canceled();
    const double bend = bend_of(corners_of(piece));
    for (const Corners& open : open_pieces(piece, uppermost, tree)) {
      const auto begin = static_cast<std::uint32_t>(open_corners_.size());
      open_corners_.insert(open_corners_.end(), open.begin(), open.end());
      open_pieces_.push_back(
          {{lit_half_space(open), bend}, begin, static_cast<std::uint32_t>(open_corners_.size())});
    }
    at(open_begin_, piece.patch + 1) = open_pieces_.size();
  }
  for (std::size_t i = 1; i < open_begin_.size(); ++i) {
    open_begin_[i] = std::max(open_begin_[i], open_begin_[i - 1]);
  }
  for (MergedFace& face : merged_faces(scene)) {
    // The patches of both sides of a two-sided face alternate.
    if (static_cast<std::size_t>(face.patches.back() - face.patches.front()) + 1 ==
        face.patches.size()) {
      face.outline = scaled(face.outline, scale_);
      faces_.push_back(std::move(face));
    }
  }
}

Corners ExchangeFinder::corners_of(const Piece& piece) const {
  Corners corners;
  for (const PointId p : scene_.corners(piece)) {
    corners.push_back(scale_ * scene_.point(p));
  }
  return corners;
}

/// Largest distance of the corners from their plane; 0 if that is rounding of planar ones.
double ExchangeFinder::bend_of(Outline corners) const {
  const HalfSpace front = lit_half_space(corners);
  double bend = 0;
  for (const Vec3& x : corners) {
    bend = std::max(bend, std::abs(front.distance(x)));
  }
  return bend_beyond_rounding(bend);
}

std::vector<ExchangeFinder::Blocker> ExchangeFinder::blockers_of(const Scene& scene) const {
  std::vector<Blocker> blockers;
  for (const MergedPiece& piece : merged_pieces(scene)) {
    blockers.push_back(
        {scaled(piece.outline, scale_), bend_beyond_rounding(scale_ * piece.bend), piece.patches});
  }
  return blockers;
}

std::vector<Bounds> ExchangeFinder::boxes_of(const std::vector<Blocker>& blockers) {
  std::vector<Bounds> boxes;
  for (const Blocker& blocker : blockers) {
    boxes.push_back(bounds_of(blocker.outline));
  }
  return boxes;
}

/// Whether `upper` covers `lower` where they overlap, for coplanar patches with the same normal.
bool ExchangeFinder::covers(PatchId upper, PatchId lower) const {
  return cover_rank(scene_, upper) < cover_rank(scene_, lower);
}

std::vector<Corners> ExchangeFinder::open_pieces(const Piece& piece,
                                                 const std::vector<Piece>& pieces,
                                                 const BoxTree& tree) const {
  const Corners corners = corners_of(piece);
  const PatchId patch = piece.patch;
  const HalfSpace front = lit_half_space(corners);
  const double bend = bend_of(corners);
  const Bounds box = bounds_of(corners);
  const auto overlaps = [&](const CenteredBox& other) {
    const Vec3 apart = other.center - box.center(), sum = other.half + 0.5 * (box.high - box.low);
    return std::abs(apart.x) <= sum.x + tolerance_ && std::abs(apart.y) <= sum.y + tolerance_ &&
           std::abs(apart.z) <= sum.z + tolerance_;
  };
  std::vector<Corners> covering;
  tree.for_each(overlaps, [&](std::int32_t number) {
    const Piece& other = at(pieces, number);
    if (other.patch == patch || dot(scene_.patch(other.patch).normal, front.normal) <= 0 ||
        !covers(other.patch, patch)) {
      return;
    }
    const Corners others = corners_of(other);
    const double thickness = tolerance_ + std::max(bend, bend_of(others));
    if (std::all_of(others.begin(), others.end(),
                    [&](const Vec3& x) { return std::abs(front.distance(x)) <= thickness; })) {
      covering.push_back(others);
    }
  });
  return covering.empty() ? std::vector<Corners>{corners} : uncovered(corners, covering);
}

/// Finds the blockers between two polygons, of those in `among`, or of all if that is null.
void ExchangeFinder::collect_blockers(const FacingPolygons& facing, const Sides& sides,
                                      const Numbers* among, Numbers& blockers) const {
  blockers.clear();
  if (among != nullptr && among->empty()) {
    return;
  }
  const Shaft shaft(facing, tolerance_, sides.bends);
  const auto add = [&](std::int32_t number) {
    const Blocker& blocker = at(blockers_, number);
    if (!blocker.is_of(sides.of_p) && !blocker.is_of(sides.of_q) &&
        shaft.meets(blocker.outline, blocker.bend)) {
      blockers.push_back(number);
    }
  };
  if (among != nullptr) {
    std::for_each(among->begin(), among->end(), add);
  } else {
    tree_.for_each([&](const CenteredBox& box) { return shaft.reaches(box); }, add);
  }
}

bool ExchangeFinder::is_any_hiding(const FacingPolygons& facing, const Numbers& blockers) const {
  return std::any_of(blockers.begin(), blockers.end(), [&](std::int32_t number) {
    return is_hidden(facing, at(blockers_, number).outline);
  });
}

/// Whether one blocker alone hides the two polygons from each other: if it meets every line between
/// a corner of one and a corner of the other, it meets all lines between them, since all are
/// convex.
bool ExchangeFinder::is_hidden(const FacingPolygons& facing, const Corners& blocker) const {
  const HalfSpace front = lit_half_space(blocker);
  const bool p_is_before = front.distance(facing.p[0]) > 0;
  const Corners& before = p_is_before ? facing.p : facing.q;
  const Corners& behind = p_is_before ? facing.q : facing.p;
  const auto is_before = [&](const Vec3& x) { return front.distance(x) > tolerance_; };
  const auto is_behind = [&](const Vec3& x) { return front.distance(x) < -tolerance_; };
  if (!std::all_of(before.begin(), before.end(), is_before) ||
      !std::all_of(behind.begin(), behind.end(), is_behind)) {
    return false;
  }
  for (const Vec3& x : before) {
    for (std::size_t k = 0; k < blocker.size(); ++k) {
      // Seen from the front, the edges run counter-clockwise.
      const Vec3 out = cross(blocker[k] - x, blocker[k + 1 < blocker.size() ? k + 1 : 0] - x);
      const auto is_outside = [&](const Vec3& y) { return dot(out, y - x) > 0; };
      if (std::any_of(behind.begin(), behind.end(), is_outside)) {
        return false;
      }
    }
  }
  return true;
}

template <class Visit>
void ExchangeFinder::for_each_facing(PatchId i, PatchId j, const Numbers* among,
                                     Visit visit) const {
  Numbers blockers;
  for (const OpenPiece& p : open_pieces_of(i)) {
    for (const OpenPiece& q : open_pieces_of(j)) {
      const FacingPolygons facing(corners_of(p), p.front, corners_of(q), q.front,
                                  tolerance_ + p.bend + q.bend);
      if (!facing.empty()) {
        const Sides sides{at(first_sides_, i), at(first_sides_, j), {p.bend, q.bend}};
        collect_blockers(facing, sides, among, blockers);
        visit(facing, blockers);
      }
    }
  }
}

PatchExchange ExchangeFinder::between(PatchId i, PatchId j, const Numbers* among,
                                      const Query& query) const {
  PatchExchange exchange;
  for_each_facing(i, j, among, [&](const FacingPolygons& facing, Numbers& blockers) {
    if (blockers.empty()) {
      add_whole(facing, query, exchange);
      return;
    }
    exchange.whole = false;
    if (!is_any_hiding(facing, blockers)) {
      add_partial(facing, blockers, query, exchange);
    }
  });
  for (double* value : {&exchange.area, &exchange.error, &exchange.moments[0], &exchange.moments[1],
                        &exchange.moment_errors[0], &exchange.moment_errors[1]}) {
    *value /= scale_ * scale_;
  }
  return exchange;
}

PatchExchange ExchangeFinder::operator()(PatchId i, PatchId j, const std::function<void()>& tick,
                                         const LinearBasis* receiver) const {
  return between(i, j, nullptr, {true, tick, receiver});
}

double ExchangeFinder::area_between(PatchId i, PatchId j, const std::function<void()>& tick) const {
  return between(i, j, nullptr, {false, tick, nullptr}).area;
}

TransferMoments ExchangeFinder::moments_between(PatchId i, PatchId j,
                                                const std::vector<LinearBasis>& bases,
                                                const Numbers* among,
                                                const std::function<void()>& tick) const {
  TransferMoments sum;
  for_each_facing(i, j, among, [&](const FacingPolygons& facing, Numbers& blockers) {
    if (blockers.empty() || !is_any_hiding(facing, blockers)) {
      add_moments(facing, blockers, at(bases, i), at(bases, j), tick, sum);
    }
  });
  for (double& value : sum.value) {
    value /= scale_ * scale_;
  }
  return sum;
}

/// Calls visit(begin, end, among) for ranges of the patches j > i, in order.
/// @param visit among: all that may block between i and these patches; null where that is not known
template <class Visit>
void ExchangeFinder::for_each_range_after(PatchId i, Visit visit) const {
  PatchId next = i + 1;
  Numbers blockers;
  auto face =
      std::upper_bound(faces_.begin(), faces_.end(), next,
                       [](PatchId j, const MergedFace& f) { return j <= f.patches.back(); });
  // A patch in several parts may see a face by each of them.
  for (; face != faces_.end() && open_pieces_of(i).size() == 1; ++face) {
    visit(next, face->patches.front(), nullptr);
    const OpenPiece& p = open_pieces_of(i)[0];
    const FacingPolygons facing(corners_of(p), p.front, face->outline,
                                lit_half_space(face->outline), tolerance_ + p.bend);
    if (!facing.empty()) {
      collect_blockers(facing, {at(first_sides_, i), face->patches.front(), {p.bend, 0}}, nullptr,
                       blockers);
      if (!is_any_hiding(facing, blockers)) {
        visit(std::max(next, face->patches.front()), face->patches.back() + 1, &blockers);
      }
    }
    next = face->patches.back() + 1;
  }
  visit(next, scene_.patch_count(), nullptr);
}

void ExchangeFinder::for_each_after(
    PatchId i, const std::vector<LinearBasis>& bases, const std::function<void()>& tick,
    const std::function<void(PatchId j, const PatchExchange&, const TransferMoments&)>& visit)
    const {
  for_each_range_after(i, [&](PatchId begin, PatchId end, const Numbers* among) {
    for (PatchId j = begin; j < end; ++j) {
      if (tick) {
        tick();
      }
      const PatchExchange exchange = between(i, j, among, {false, tick, nullptr});
      if (exchange.area > 0) {
        TransferMoments moments =
            bases.empty() ? TransferMoments() : moments_between(i, j, bases, among, tick);
        // Past blockers the area may be by more points, and the others are of the same light.
        const double by_points = moments.of(0, 0);
        for (double& value : moments.value) {
          value *= !exchange.whole && by_points > 0 ? exchange.area / by_points : 1;
        }
        moments.of(0, 0) = exchange.area;
        visit(j, exchange, moments);
      }
    }
  });
}

}  // namespace transillum
