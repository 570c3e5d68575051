// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What a point receives from a patch: for each part of the patch, the blockers in the pyramid from
// the point to it are found in the box tree and subtracted (point_view.h).
#include <algorithm>
#include <cmath>

#include "visibility/pairs/patch_exchange.h"
#include "visibility/pairs/point_view.h"

namespace transillum {
namespace {

/// The pyramid from an apex to a convex polygon whose front it sees.
class Pyramid {
 public:
  Pyramid(const Vec3& apex, Outline polygon) {
    box_.add(apex);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
      box_.add(a);
      // Seen from the front, the polygon runs counter-clockwise: this is outward.
      const Vec3 outward = cross(a - apex, b - apex);
      if (const double length = norm(outward); length > 0) {
        const Vec3 inward = outward / -length;
        sides_.push_back({inward, dot(inward, apex)});
      }
    }
  }
  /// Whether the box may reach into the pyramid; never false if it does.
  bool reaches(const CenteredBox& box) const {
    const Vec3 apart = box.center - box_.center(), sum = box.half + 0.5 * (box_.high - box_.low);
    return std::abs(apart.x) <= sum.x && std::abs(apart.y) <= sum.y && std::abs(apart.z) <= sum.z &&
           std::all_of(sides_.begin(), sides_.end(), [&](const HalfSpace& side) {
             return box.reach(side.normal) >= side.offset;
           });
  }

 private:
  Bounds box_;
  boost::container::small_vector<HalfSpace, 12> sides_;
};

}  // namespace

/// Finds the blockers in the pyramid from x to a polygon, without those in whose plane x is, and
/// those that do not reach in front of the polygon's plane, such as itself.
/// @param polygon of `part`, which is of `patch`
void ExchangeFinder::collect_blockers(const Vec3& x, Outline polygon, const OpenPlane& open,
                                      PatchId patch, Numbers& blockers) const {
  blockers.clear();
  const Pyramid pyramid(x, polygon);
  tree_.for_each([&](const CenteredBox& box) { return pyramid.reaches(box); },
                 [&](std::int32_t number) {
                   const Blocker& blocker = at(blockers_, number);
                   const Corners& outline = blocker.outline;
                   const bool reaches_in =
                       std::any_of(outline.begin(), outline.end(), [&](const Vec3& c) {
                         return open.front.distance(c) > tolerance_ + open.bend;
                       });
                   if (!blocker.is_of(at(first_sides_, patch)) && reaches_in &&
                       std::abs(lit_half_space(outline).distance(x)) > tolerance_ + blocker.bend) {
                     blockers.push_back(number);
                   }
                 });
}

double ExchangeFinder::from_point(const Vec3& x, const Vec3& normal, PatchId j,
                                  const std::function<void()>& tick) const {
  const Vec3 apex = scale_ * x;
  double sum = 0;
  Numbers numbers;
  std::vector<Corners> blockers;
  for (const OpenPiece& open : open_pieces_of(j)) {
    if (open.front.distance(apex) <= tolerance_ + open.bend) {
      continue;
    }
    const Corners above = clipped(corners_of(open), {normal, dot(normal, apex)});
    if (above.size() < 3) {
      continue;
    }
    collect_blockers(apex, above, open, j, numbers);
    blockers.clear();
    for (const std::int32_t number : numbers) {
      blockers.push_back(at(blockers_, number).outline);
    }
    sum += PointView(above, blockers).form_factor(apex, normal, tick);
  }
  return sum;
}

}  // namespace transillum
