// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/directions.h"

namespace transillum {

/// Star discrepancy D* of points of the unit square (eq. 3): the largest difference, over all boxes
/// [0,u] x [0,v] with or without their upper sides, between the fraction of points in the box and
/// its area. Exact; 0 without points. O(M^1.5): 0.1 s for 10,000 points.
/// @throws Canceled
double star_discrepancy(std::span<const DirectionSample> samples,
                        const Cancellation& cancellation = {});

/// The spherical-cap discrepancy of a set, or a lower bound.
struct CapDiscrepancy {
  double value = 0;  ///< largest difference, over caps, between fraction of directions and of area
  bool exact = false;  ///< false: only caps about some centers were examined; a lower bound
};

/// The largest number of directions for which cap_discrepancy() is exact.
inline constexpr int max_exact_cap_directions = 200;

/// The spherical-cap discrepancy. Up to max_exact_cap_directions directions it is exact: the worst
/// cap has two or three directions on its boundary, and all circles through two are swept,
/// O(M^3 log M). For more it examines caps of all sizes about 2,048 centers spread over the sphere
/// and about as many of the directions and their opposites (from 2,048 directions on fewer of each,
/// at least 32), O(M log M) per center.
/// @throws Canceled
CapDiscrepancy cap_discrepancy(std::span<const DirectionSample> samples,
                               const Cancellation& cancellation = {});

/// The signed quadrature error eps(M) of eq. 17: (4 pi/M) sum_d max(n·omega_d, 0) - pi.
/// @param normal n, of the patch; unit.
/// @param samples the M directions.
/// @param two_way use the directions and their opposites.
double quadrature_error(const Vec3& normal, std::span<const DirectionSample> samples, bool two_way);

/// Magnitude of eps(M) over many normals.
struct QuadratureErrors {
  double rms = 0;  ///< root mean square
  double max = 0;  ///< largest magnitude
};
/// RMS and largest magnitude of some errors.
QuadratureErrors summary_of(std::span<const double> errors);

/// quadrature_error() for each normal, in their order. O(normals x directions).
/// @throws Canceled
std::vector<double> quadrature_errors(std::span<const Vec3> normals,
                                      std::span<const DirectionSample> samples, bool two_way,
                                      const Cancellation& cancellation = {});

/// `count` unit normals spread over the sphere, and the six axis directions.
std::vector<Vec3> spread_normals(int count);

}  // namespace transillum
