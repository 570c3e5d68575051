// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Moments of what a fragment sees of another, for a linear basis (ALGORITHM.md 6.12): T^ab, the
// integral over their overlap on the transillumination plane of phi_a of one times phi_b of the
// other, from the directed segments that bound the overlap. Input: the segments, from an engine.
//
// Why not the moments 1, x, y, x², xy, y² of the overlap: a patch seen at a grazing angle is a
// needle on the plane, across which its functions are steep; their integrals would be differences
// of much larger numbers. Values of the functions at the ends of segments are of the size of 1
// wherever they are in the patch.
//
// Notation: the apex is a point on the boundary of the overlap. By Green's theorem, an integral
// over the overlap is the sum over its boundary segments pq of the integral over the signed
// triangle of the apex, p and q. `rise` of a function is its value less that at the apex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "transillum/transfers.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// Gradients of phi_1 and phi_2 of a patch on the transillumination plane, along its x and y.
struct BasisGradient {
  std::array<double, 2> x{}, y{};
  std::array<double, 2> largest{};  ///< magnitudes on the patch
};

/// The largest magnitudes of phi_1 and phi_2 on each patch: those at its corners. They bound the
/// moments of an overlap by its area, also where it is narrower than the rounding of its corners.
inline std::vector<std::array<double, 2>> largest_values(const Scene& scene,
                                                         const std::vector<LinearBasis>& bases) {
  std::vector<std::array<double, 2>> largest(bases.size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      const std::array<double, 2> values = at(bases, i).at(scene.point(p));
      for (std::size_t a = 0; a < 2; ++a) {
        at(largest, i)[a] = std::max(at(largest, i)[a], std::abs(values[a]));
      }
    }
  }
  return largest;
}

/// The functions of a patch, carried along omega from its plane to the transillumination plane.
/// @param largest of largest_values()
/// @param unit of the plane's coordinates, m
inline BasisGradient gradient_on_plane(const LinearBasis& basis,
                                       const std::array<double, 2>& largest, const Vec3& normal,
                                       const PlaneFrame& frame, double unit = 1) {
  constexpr double edge_on = 1e-14;
  BasisGradient gradient;
  gradient.largest = largest;
  const double cosine = dot(normal, frame.omega);
  if (std::abs(cosine) < edge_on) {
    return gradient;
  }
  for (std::size_t a = 0; a < 2; ++a) {
    // The gradient that is perpendicular to omega and the same along the patch.
    const Vec3& g = basis.gradient[a];
    const Vec3 on_plane = g - (dot(g, frame.omega) / cosine) * normal;
    gradient.x[a] = unit * dot(on_plane, frame.u);
    gradient.y[a] = unit * dot(on_plane, frame.v);
  }
  return gradient;
}

/// The functions of one patch near an apex.
template <class Real>
struct BasisAtApex {
  std::array<Real, 2> value;  ///< at the apex
  std::array<Real, 2> x, y;   ///< gradient
  std::array<double, 2> largest;

  /// @param dx, dy the apex less the projected center of the patch
  template <class Wide>
  BasisAtApex(const BasisGradient& gradient, Wide dx, Wide dy) : largest(gradient.largest) {
    for (std::size_t a = 0; a < 2; ++a) {
      value[a] = static_cast<Real>(gradient.x[a] * dx + gradient.y[a] * dy);
      x[a] = static_cast<Real>(gradient.x[a]);
      y[a] = static_cast<Real>(gradient.y[a]);
    }
  }
  Real rise(std::size_t a, Real px, Real py) const { return x[a] * px + y[a] * py; }
};

/// An integral, which no rounding may take beyond `bound` >= 0 in magnitude.
template <class Real>
double bounded(Real integral, double bound) {
  const auto value = static_cast<double>(integral);
  return value < -bound ? -bound : value > bound ? bound : value;
}

/// Integrals of phi_1 and phi_2 over a region.
template <class Real>
class RegionMoments {
 public:
  explicit RegionMoments(const BasisAtApex<Real>& basis) : basis_(basis) {}

  /// Adds the boundary segment from p to q, relative to the apex; the region is on its left.
  void add(Real px, Real py, Real qx, Real qy) {
    const Real twice_area = px * qy - py * qx;
    for (std::size_t a = 0; a < 2; ++a) {
      first_[a] += twice_area * (basis_.rise(a, px, py) + basis_.rise(a, qx, qy));
    }
  }
  /// @param area of the region, m²
  /// @param unit m² per square of the unit of the coordinates
  std::array<double, 2> finish(double area, double unit) const {
    std::array<double, 2> moments;
    for (std::size_t a = 0; a < 2; ++a) {
      moments[a] = bounded(
          basis_.value[a] * static_cast<Real>(area) + first_[a] * static_cast<Real>(unit) / 6,
          basis_.largest[a] * area);
    }
    return moments;
  }

 private:
  BasisAtApex<Real> basis_;
  std::array<Real, 2> first_{};  ///< 6 times the integral of the rises
};

/// The moments of one overlap.
template <class Real>
class OverlapMoments {
 public:
  /// @param own of the fragment below, whose functions have index a
  /// @param other of the one above, index b
  OverlapMoments(const BasisAtApex<Real>& own, const BasisAtApex<Real>& other)
      : own_(own), other_(other) {}

  /// Adds the boundary segment from p to q, relative to the apex; the overlap is on its left.
  void add(Real px, Real py, Real qx, Real qy) {
    const Real twice_area = px * qy - py * qx;
    // The integral of a product f g over the triangle is A/12 (2 f_p g_p + 2 f_q g_q + f_p g_q +
    // f_q g_p), where f and g are 0 at the apex.
    std::array<Real, 2> other_p, other_q;
    for (std::size_t b = 0; b < 2; ++b) {
      const Real p = other_.rise(b, px, py), q = other_.rise(b, qx, qy);
      first_other_[b] += twice_area * (p + q);
      other_p[b] = p + q / 2;
      other_q[b] = q + p / 2;
    }
    for (std::size_t a = 0; a < 2; ++a) {
      const Real p = twice_area * own_.rise(a, px, py), q = twice_area * own_.rise(a, qx, qy);
      first_own_[a] += p + q;
      for (std::size_t b = 0; b < 2; ++b) {
        second_[a][b] += p * other_p[b] + q * other_q[b];
      }
    }
  }

  /// @param area of the overlap, m²
  /// @param unit m² per square of the unit of the coordinates
  TransferMoments finish(double area, double unit) const {
    const auto m0 = static_cast<Real>(area);
    const Real sixth = static_cast<Real>(unit) / 6, twelfth = static_cast<Real>(unit) / 12;
    TransferMoments moments;
    moments.of(0, 0) = area;
    for (std::size_t a = 0; a < 2; ++a) {
      const Real own = first_own_[a] * sixth;
      moments.of(a + 1, 0) = bounded(own_.value[a] * m0 + own, own_.largest[a] * area);
      moments.of(0, a + 1) =
          bounded(other_.value[a] * m0 + first_other_[a] * sixth, other_.largest[a] * area);
      for (std::size_t b = 0; b < 2; ++b) {
        const Real other = first_other_[b] * sixth;
        moments.of(a + 1, b + 1) = bounded((own_.value[a] * m0 + own) * other_.value[b] +
                                               own_.value[a] * other + second_[a][b] * twelfth,
                                           own_.largest[a] * other_.largest[b] * area);
      }
    }
    return moments;
  }

 private:
  BasisAtApex<Real> own_, other_;
  std::array<Real, 2> first_own_{}, first_other_{};  ///< 6 times the integrals of the rises
  std::array<std::array<Real, 2>, 2> second_{};      ///< 12 times the integrals of their products
};

}  // namespace transillum
