// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// The sequence of points of the unit square from which directions are made (paper, section 4).
/// phi_b is the radical inverse in base b; k counts from 0.
enum class Sampling {
  hammersley,            ///< u = k/M, v = phi_2(k): the paper's
  centered_hammersley,   ///< u = phi_2(k), v = (k+1/2)/M: symmetric in ±z, so that one-way errors
                         ///< are about 6 times smaller
  scrambled_hammersley,  ///< the paper's, both coordinates Owen-scrambled in base 2; seeded
  halton,                ///< u = phi_2(k), v = phi_3(k)
  sobol,                 ///< Sobol's sequence, Owen-scrambled in base 2; seeded
  fibonacci,             ///< spherical Fibonacci lattice: v = (k+1/2)/M, u = k/golden ratio mod 1
  antipodal,             ///< for two-way passes: M axes; the 2M directions ±axis are evenly spread
  random,                ///< independent uniform points; seeded
};

/// A point of the unit square and its transillumination direction by eq. 13:
/// psi = 2 pi u, theta = arccos(1 - 2v).
struct DirectionSample {
  double u = 0;    ///< [0, 1)
  double v = 0;    ///< [0, 1]
  Vec3 direction;  ///< omega, unit
};

/// Their names (choice.h).
template <>
const Choices& choices_of<Sampling>();
/// The sampling called `name`. Reads the former spelling `centred-hammersley` too.
/// @throws InputError listing the names.
template <>
Sampling from_name<Sampling>(const std::string& name);

/// The properties of a sampling. Callers ask these instead of naming samplings.
struct SamplingTraits {
  Sampling value;                     ///< the sampling
  const char* name;                   ///< in options and files
  const char* label = nullptr;        ///< in a list of choices; null: the name with a capital
  const char* sentence = "";          ///< one sentence on its points
  bool is_seeded = false;             ///< is_seeded()
  bool is_extensible = false;         ///< is_extensible()
  bool differs_by_iteration = false;  ///< differs_by_iteration()
};
/// The traits of one sampling.
const SamplingTraits& traits_of(Sampling sampling);

/// The sampling that needs the fewest passes: antipodal where each pass also serves the opposite
/// direction, fibonacci where it does not.
Sampling default_sampling(bool two_way);

/// Whether the points depend on the seed.
bool is_seeded(Sampling sampling);
/// Whether the first M points are the same for every length of the sequence, with the same seed:
/// true for halton, sobol and random; false for those whose coordinates depend on M.
bool is_extensible(Sampling sampling);

/// The largest number of directions in a set.
inline constexpr int max_directions = 1 << 24;

/// The M = `count` points of a sequence. The same bits on every machine.
/// @throws InputError unless 1 <= count <= max_directions.
std::vector<DirectionSample> make_directions(Sampling sampling, int count, std::uint64_t seed);

/// Points `begin` … `end`-1 of an extensible sequence.
/// @throws InputError unless 0 <= begin <= end <= max_directions, and for other sequences.
std::vector<DirectionSample> make_directions(Sampling sampling, int begin, int end,
                                             std::uint64_t seed);

/// The set of M = `count` directions of one iteration of the semi-iterative scheme (section 6).
/// Iteration 0 has make_directions(sampling, count, seed). The later ones have
/// - random, scrambled_hammersley, fibonacci, antipodal: independent points, scramblings or
///   rotations, so that eq. 47 and with it eq. 46 hold;
/// - halton, sobol: consecutive parts of one sequence, shuffled: in their natural order they would
///   violate eq. 46, because each part depends on the one before. Parts 2^p … 2^(p+1)-1 come in
///   random order; after 2^p iterations the first 2^p parts have been used once each;
/// - hammersley, centered_hammersley: the same set again, which violates eq. 46.
///
/// O(count + iteration).
/// @throws InputError unless 1 <= count <= max_directions and iteration >= 0.
std::vector<DirectionSample> directions_of_iteration(Sampling sampling, int count,
                                                     std::uint64_t seed, int iteration);

/// Whether directions_of_iteration() gives every iteration other directions: not for hammersley and
/// centered_hammersley.
bool differs_by_iteration(Sampling sampling);

/// The directions under one random rotation, uniform among all rotations, with recomputed points
/// of the unit square. No seed gives the identity.
std::vector<DirectionSample> rotated(std::vector<DirectionSample> samples, std::uint64_t seed);

/// The directions and their opposites, 2M: what M two-way passes use.
std::vector<DirectionSample> with_opposites(std::vector<DirectionSample> samples);

/// The numbers 0 … count-1 in an order in which every prefix is spread over the whole sphere, so
/// that an estimate from the passes done so far is unbiased by region.
std::vector<int> progressive_order(Sampling sampling, int count);

}  // namespace TRANSILLUM_API transillum
