// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Moments for engine fast: the functions of the patches on the grid of one direction, and their
// integrals over what BoundaryView or ExactView has found, segment by segment.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "visibility/plane/overlap_moments.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// The moments of the fragments of one direction, and of what they see of each other.
class FragmentMoments {
 public:
  /// @param bases of all patches of `scene`
  FragmentMoments(const Scene& scene, std::shared_ptr<const std::vector<LinearBasis>> bases,
                  const ProjectedFragments& projected)
      : scene_(scene),
        bases_(std::move(bases)),
        projected_(projected),
        largest_(largest_values(scene, *bases_)),
        patches_(bases_->size()) {}

  /// Begins a direction.
  void begin() {
    for (OfPatch& patch : patches_) {
      patch.ready = false;
    }
    unit_ = projected_.grid.unit * projected_.grid.unit;
  }

  /// Carries the functions of a patch to the plane of the direction, unless that is done.
  void prepare(PatchId i) {
    OfPatch& patch = at(patches_, i);
    if (patch.ready) {
      return;
    }
    const LinearBasis& basis = at(*bases_, i);
    const PlaneFrame& frame = projected_.grid.frame;
    patch.gradient = gradient_on_plane(basis, at(largest_, i), scene_.patch(i).normal, frame,
                                       projected_.grid.unit);
    patch.center = projected_.grid.point_at(basis.center);
    patch.ready = true;
  }

  /// Integrals of phi_1 and phi_2 of a patch over the projection of its fragment, m².
  std::array<double, 2> of_fragment(PatchId patch, const ProjectedFragments::Fragment& fragment) {
    prepare(patch);
    const GridPoint* const corners = projected_.corners.data() + fragment.begin;
    const std::size_t count = fragment.end - fragment.begin;
    const GridPoint& apex = corners[0];
    RegionMoments<double> sum(at_apex(patch, apex, 0.0, 0.0));
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const GridPoint &p = corners[k], &q = corners[k + 1];
      sum.add(static_cast<double>(p.x - apex.x), static_cast<double>(p.y - apex.y),
              static_cast<double>(q.x - apex.x), static_cast<double>(q.y - apex.y));
    }
    return sum.finish(unit_ * fragment.area, unit_);
  }

  /// The moments of what one patch sees of another.
  /// @param view that has its boundary
  /// @param area of it, m²
  template <class View>
  TransferMoments of_overlap(const View& view, PatchId own, PatchId other, double area) const {
    using Coordinate = typename View::Coordinate;
    Coordinate apex_x = 0, apex_y = 0;
    std::optional<OverlapMoments<double>> sum;
    view.for_each_covered_segment([&](Coordinate px, Coordinate py, Coordinate qx, Coordinate qy) {
      if (!sum) {
        apex_x = px;
        apex_y = py;
        sum.emplace(at_apex(own, view.origin(), px, py), at_apex(other, view.origin(), px, py));
      }
      sum->add(static_cast<double>(px - apex_x), static_cast<double>(py - apex_y),
               static_cast<double>(qx - apex_x), static_cast<double>(qy - apex_y));
    });
    if (sum) {
      return sum->finish(area, unit_);
    }
    TransferMoments none;
    none.of(0, 0) = area;
    return none;
  }

 private:
  struct OfPatch {
    BasisGradient gradient;  ///< per grid unit
    GridPoint center;        ///< center of the basis, projected
    bool ready = false;
  };

  /// The functions of a patch at the point (x, y) from `origin`.
  template <class Coordinate>
  BasisAtApex<double> at_apex(PatchId i, const GridPoint& origin, Coordinate x,
                              Coordinate y) const {
    using Wide = long double;
    const OfPatch& patch = at(patches_, i);
    return {patch.gradient, static_cast<Wide>(origin.x - patch.center.x) + static_cast<Wide>(x),
            static_cast<Wide>(origin.y - patch.center.y) + static_cast<Wide>(y)};
  }

  const Scene& scene_;
  std::shared_ptr<const std::vector<LinearBasis>> bases_;
  const ProjectedFragments& projected_;
  std::vector<std::array<double, 2>> largest_;
  std::vector<OfPatch> patches_;
  double unit_ = 1;  ///< m² per square grid unit
};

}  // namespace transillum
