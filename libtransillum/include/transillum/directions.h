// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// Where the points of the unit square come from (paper, section 4).
enum class Sampling {
  hammersley,  ///< u = k/M, v = radical inverse of k in base 2: the paper's
  random,      ///< independent uniform points, seeded
  fibonacci,   ///< spherical Fibonacci lattice: v = (k+1/2)/M, u = k/golden ratio mod 1
};

/// A point of the unit square and its transillumination direction by eq. 13:
/// psi = 2 pi u, theta = arccos(1 - 2v); unit length.
struct DirectionSample {
  double u = 0, v = 0;
  Vec3 direction;
};

/// The names of the command line, in the order of the enumeration.
const std::vector<std::string>& sampling_names();
/// @throws InputError naming the choices.
Sampling sampling_from_name(const std::string& name);
const std::string& name_of(Sampling sampling);

/// The M = `count` points of a sequence. The same bits on every machine.
/// @throws InputError unless 1 <= count <= 2^24.
std::vector<DirectionSample> make_directions(Sampling sampling, int count, std::uint64_t seed);

/// The numbers 0 … count-1 in an order whose every beginning is spread over the whole sequence
/// (sorted by radical inverse), so that a running estimate is a fair one.
std::vector<int> progressive_order(int count);

}  // namespace transillum
