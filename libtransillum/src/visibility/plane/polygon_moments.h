// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <vector>

#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "visibility/plane/map_polygon.h"
#include "visibility/plane/overlap_moments.h"

namespace transillum {

/// Moments of the convex polygons of the maps.
template <class Number>
class PolygonMoments {
 public:
  PolygonMoments(const Scene& scene, const std::vector<LinearBasis>& bases,
                 const BasicProjection<Number>& projection) {
    const std::vector<std::array<double, 2>> largest = largest_values(scene, bases);
    patches_.reserve(bases.size());
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      patches_.push_back(
          {gradient_on_plane(at(bases, i), at(largest, i), scene.patch(i).normal, projection.frame),
           projection.project(at(bases, i).center)});
    }
  }

  /// Integrals of phi_1 and phi_2 of a patch over a polygon, m².
  std::array<double, 2> of_polygon(PatchId i, const BasicMapPolygon<Number>& polygon) const {
    RegionMoments<Type> sum(at_apex(i, polygon));
    for_each_edge(polygon, [&](Type px, Type py, Type qx, Type qy) { sum.add(px, py, qx, qy); });
    return sum.finish(to_double(area_of(polygon)), 1);
  }

  /// The moments of a polygon in which patch `own` sees patch `other`.
  TransferMoments of_overlap(PatchId own, PatchId other,
                             const BasicMapPolygon<Number>& polygon) const {
    OverlapMoments<Type> sum(at_apex(own, polygon), at_apex(other, polygon));
    for_each_edge(polygon, [&](Type px, Type py, Type qx, Type qy) { sum.add(px, py, qx, qy); });
    return sum.finish(to_double(area_of(polygon)), 1);
  }

 private:
  using Type = typename MapNumber<Number>::Moment;
  struct OfPatch {
    BasisGradient gradient;
    BasicPlanePoint<Number> center;
  };

  static double to_double(const Number& number) {
    return static_cast<double>(MapNumber<Number>::moment(number));
  }
  /// The functions of a patch at a polygon's first corner.
  BasisAtApex<Type> at_apex(PatchId i, const BasicMapPolygon<Number>& polygon) const {
    const OfPatch& patch = at(patches_, i);
    const BasicPlanePoint<Number> offset = polygon[0].at - patch.center;
    return {patch.gradient, MapNumber<Number>::moment(offset.x),
            MapNumber<Number>::moment(offset.y)};
  }
  /// Calls visit for the edges that do not meet the first corner, relative to it.
  template <class Visit>
  static void for_each_edge(const BasicMapPolygon<Number>& polygon, Visit visit) {
    const auto relative = [&](std::size_t k) {
      const BasicPlanePoint<Number> offset = polygon[k].at - polygon[0].at;
      return std::array<Type, 2>{MapNumber<Number>::moment(offset.x),
                                 MapNumber<Number>::moment(offset.y)};
    };
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const auto p = relative(k), q = relative(k + 1);
      visit(p[0], p[1], q[0], q[1]);
    }
  }

  std::vector<OfPatch> patches_;
};

}  // namespace transillum
