// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// Where the points of the unit square come from (paper, section 4). phi_b is the radical inverse
/// in base b; k counts from 0.
enum class Sampling {
  hammersley,            ///< u = k/M, v = phi_2(k): the paper's
  centered_hammersley,   ///< u = phi_2(k), v = (k+1/2)/M: up and down alike, so 6 times better one
                         ///< way
  scrambled_hammersley,  ///< the paper's, both coordinates Owen-scrambled in base 2; seeded
  halton,                ///< u = phi_2(k), v = phi_3(k)
  sobol,                 ///< Sobol's sequence, Owen-scrambled in base 2; seeded
  fibonacci,             ///< spherical Fibonacci lattice: v = (k+1/2)/M, u = k/golden ratio mod 1
  random,                ///< independent uniform points; seeded
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

/// Whether the seed makes a difference.
bool is_seeded(Sampling sampling);
/// Whether M points are the beginning of any longer sequence of the same seed: halton, sobol and
/// random are; what divides by M is not.
bool is_extensible(Sampling sampling);

/// The most directions of a set.
inline constexpr int max_directions = 1 << 24;

/// The M = `count` points of a sequence. The same bits on every machine.
/// @throws InputError unless 1 <= count <= max_directions.
std::vector<DirectionSample> make_directions(Sampling sampling, int count, std::uint64_t seed);

/// Points `begin` … `end`-1 of an extensible sequence.
/// @throws InputError unless 0 <= begin <= end <= max_directions, and for other sequences.
std::vector<DirectionSample> make_directions(Sampling sampling, int begin, int end,
                                             std::uint64_t seed);

/// The set of M = `count` directions that step 0, 1, 2, … of the semi-iterative scheme takes
/// (section 6). Step 0 has make_directions(sampling, count, seed). From there
/// - random, scrambled_hammersley, fibonacci: independent points, scramblings, rotations, so that
///   eq. 47 and with it eq. 46 hold;
/// - halton, sobol: the next points of one sequence. Sets in their natural order would fail eq. 46,
///   for where the last set was tells where the next will be; so sets 2^p … 2^(p+1)-1 come in
///   random order. After 2^p steps the first 2^p sets have been used, each once;
/// - hammersley, centered_hammersley: the same set again, which fails eq. 46.
///
/// Costs O(count + step).
/// @throws InputError unless 1 <= count <= max_directions and step >= 0.
std::vector<DirectionSample> directions_of_iteration(Sampling sampling, int count,
                                                     std::uint64_t seed, int step);

/// All turned by one random rotation, uniform among all rotations, and given the points of the
/// square that belong to them. No seed is the rotation that leaves them where they are.
std::vector<DirectionSample> rotated(std::vector<DirectionSample> samples, std::uint64_t seed);

/// The numbers 0 … count-1 in an order whose every beginning takes points from all over the sphere,
/// so that a running estimate is a fair one.
std::vector<int> progressive_order(Sampling sampling, int count);

}  // namespace transillum
