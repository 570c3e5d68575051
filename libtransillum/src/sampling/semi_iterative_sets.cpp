// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "base/bit_mixing.h"
#include "sampling/sequences.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// The number of the part of a sequence used in `iteration`: parts 2^p … 2^(p+1)-1 are shuffled.
std::uint32_t shuffled_set(std::uint32_t iteration, std::uint64_t seed) {
  std::uint32_t first = 1;
  while (iteration >= 2 * std::uint64_t{first}) {
    first *= 2;
  }
  std::vector<std::uint32_t> sets(first);
  std::iota(sets.begin(), sets.end(), first);
  std::uint64_t random = mixed(seed + first);
  for (std::uint32_t left = first; left > 1; --left) {
    random += golden_step;
    // For left < 2^32 the bias of the remainder is below 2^-32.
    std::swap(sets[left - 1], sets[mixed(random) % left]);
  }
  return sets[iteration - first];
}

}  // namespace

std::vector<DirectionSample> directions_of_iteration(Sampling sampling, int count,
                                                     std::uint64_t seed, int iteration) {
  if (iteration < 0) {
    throw InputError(fmt::format("iteration {}: the number must be at least 0", iteration));
  }
  if (iteration == 0) {
    return make_directions(sampling, count, seed);
  }
  const std::uint64_t set_seed = mixed(seed + static_cast<std::uint64_t>(iteration) * golden_step);
  switch (sampling) {
    case Sampling::random:
    case Sampling::scrambled_hammersley:
      return make_directions(sampling, count, set_seed);
    case Sampling::fibonacci:
    case Sampling::antipodal:
      return rotated(make_directions(sampling, count, seed), set_seed);
    case Sampling::halton:
    case Sampling::sobol: {
      check_direction_count(count);
      const std::uint32_t set = shuffled_set(static_cast<std::uint32_t>(iteration), seed);
      return extensible_points(sampling, set * static_cast<std::uint32_t>(count), count, seed);
    }
    case Sampling::hammersley:
    case Sampling::centered_hammersley:
      break;
  }
  return make_directions(sampling, count, seed);
}

}  // namespace transillum
