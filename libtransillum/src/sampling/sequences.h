// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/directions.h"

namespace transillum {

/// @throws InputError unless 1 <= count <= max_directions.
void check_direction_count(int count);

/// Whether consecutive points are a golden angle apart, on a spiral from pole to pole or to the
/// equator.
bool is_spiral(Sampling sampling);

/// The digits of k in `base` mirrored at the radix point: van der Corput's sequence, in [0,1).
double radical_inverse(std::uint32_t k, std::uint32_t base);

/// Points `begin` … `begin + count - 1` of an extensible sequence; 2^32 - 1 is followed by 0.
std::vector<DirectionSample> extensible_points(Sampling sampling, std::uint32_t begin, int count,
                                               std::uint64_t seed);

/// M = `count` >= 1 unit vectors that are spread evenly over the sphere together with their
/// opposites, along a spiral from both poles to the plane z = 0. The same bits on every machine.
/// O(M log M): 0.01 s for 1,024.
std::vector<Vec3> antipodal_set(int count);

}  // namespace transillum
