// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/directions.h"

namespace transillum {

/// How unevenly points of the unit square lie (eq. 3): the largest difference, over all boxes
/// [0,u] x [0,v] with or without their upper sides, between the share of points in the box and its
/// area. Exact; 0 without points. O(M^1.5): 0.1 s for 10,000 points.
/// @throws Canceled
double star_discrepancy(std::span<const DirectionSample> samples,
                        const Cancellation& cancellation = {});

/// The spherical-cap discrepancy of a set, or what is known of it.
struct CapDiscrepancy {
  double value = 0;    ///< largest difference, over caps, between share of directions and of area
  bool exact = false;  ///< false: over caps of any size round some centers, so a lower bound
};

/// The most directions whose cap discrepancy is found exactly.
inline constexpr int max_exact_cap_directions = 200;

/// Over all caps where there are few directions: the worst cap has two or three on its rim, and all
/// circles through two are swept, O(M^3 log M). Else over caps round 2,048 centers spread over the
/// sphere, and round as many of the directions and their opposites; fewer, at least 32, from 2,048
/// directions on. O(M log M) a center.
/// @throws Canceled
CapDiscrepancy cap_discrepancy(std::span<const DirectionSample> samples,
                               const Cancellation& cancellation = {});

/// eps(M) of eq. 17 with its sign: (4 pi/M) sum_d max(n·omega_d, 0) - pi, for a patch of unit
/// normal n. Two-way: of the directions and their opposites together.
double quadrature_error(const Vec3& normal, std::span<const DirectionSample> samples, bool two_way);

/// eps(M) of many patches, its magnitude.
struct QuadratureErrors {
  double rms = 0, max = 0;
};
QuadratureErrors summary_of(std::span<const double> errors);

/// quadrature_error for each normal, in their order. O(normals x directions).
/// @throws Canceled
std::vector<double> quadrature_errors(std::span<const Vec3> normals,
                                      std::span<const DirectionSample> samples, bool two_way,
                                      const Cancellation& cancellation = {});

/// Normals that stand for all: `count` spread over the sphere, and the axes.
std::vector<Vec3> spread_normals(int count);

}  // namespace transillum
