// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/bit_mixing.h"
#include "base/choice.h"
#include "sampling/sequences.h"
#include "sampling/sphere_map.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr std::array samplings{
    SamplingTraits{.value = Sampling::hammersley, .name = "hammersley"},
    SamplingTraits{.value = Sampling::centered_hammersley,
                   .name = "centered-hammersley",
                   .label = "Centered Hammersley"},
    SamplingTraits{.value = Sampling::scrambled_hammersley,
                   .name = "scrambled-hammersley",
                   .label = "Scrambled Hammersley",
                   .is_seeded = true,
                   .differs_by_iteration = true},
    SamplingTraits{.value = Sampling::halton,
                   .name = "halton",
                   .is_extensible = true,
                   .differs_by_iteration = true},
    SamplingTraits{.value = Sampling::sobol,
                   .name = "sobol",
                   .is_seeded = true,
                   .is_extensible = true,
                   .differs_by_iteration = true},
    SamplingTraits{.value = Sampling::fibonacci, .name = "fibonacci", .differs_by_iteration = true},
    SamplingTraits{.value = Sampling::antipodal, .name = "antipodal", .differs_by_iteration = true},
    SamplingTraits{.value = Sampling::random,
                   .name = "random",
                   .is_seeded = true,
                   .is_extensible = true,
                   .differs_by_iteration = true},
};

struct Rotation {
  Vec3 x, y, z;  ///< images of the axes

  Vec3 operator()(const Vec3& a) const { return a.x * x + a.y * y + a.z * z; }
};

/// The rotation of a unit quaternion that is uniform on its sphere (Shoemake, "Uniform Random
/// Rotations", 1992).
Rotation random_rotation(std::uint64_t seed) {
  const auto uniform = [seed](std::uint64_t k) {
    return static_cast<double>(mixed(seed + k * golden_step) >> 11) * 0x1p-53;
  };
  const double fraction = uniform(1);
  const double a = 2 * std::numbers::pi * uniform(2), b = 2 * std::numbers::pi * uniform(3);
  const double x = std::sqrt(1 - fraction) * std::sin(a), y = std::sqrt(1 - fraction) * std::cos(a);
  const double z = std::sqrt(fraction) * std::sin(b), w = std::sqrt(fraction) * std::cos(b);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

}  // namespace

template <>
const Choices& choices_of<Sampling>() {
  return texts_of<samplings>("sampling");
}

template <>
Sampling from_name<Sampling>(const std::string& name) {
  // The former, British spelling: scripts still use it.
  const std::string& current =
      name == "centred-hammersley" ? name_of(Sampling::centered_hammersley) : name;
  return static_cast<Sampling>(choices_of<Sampling>().index_of(current));
}

const SamplingTraits& traits_of(Sampling sampling) { return at(samplings, sampling); }

bool is_seeded(Sampling sampling) { return traits_of(sampling).is_seeded; }

bool is_extensible(Sampling sampling) { return traits_of(sampling).is_extensible; }

bool differs_by_iteration(Sampling sampling) { return traits_of(sampling).differs_by_iteration; }

bool is_spiral(Sampling sampling) {
  return sampling == Sampling::fibonacci || sampling == Sampling::antipodal;
}

Sampling default_sampling(bool two_way) {
  return two_way ? Sampling::antipodal : Sampling::fibonacci;
}

std::vector<DirectionSample> with_opposites(std::vector<DirectionSample> samples) {
  const std::size_t count = samples.size();
  samples.reserve(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    samples.push_back(sample_along(-samples[k].direction));
  }
  return samples;
}

std::vector<int> progressive_order(Sampling sampling, int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  if (is_extensible(sampling)) {
    return order;
  }
  // Ranks of the radical inverses: the order in which van der Corput's points fill the interval,
  // scaled to 0 … count-1 for any count. The base differs from the bases of the sampling, else
  // prefixes
  // would cover only a corner of the square.
  const std::uint32_t base = is_spiral(sampling) ? 2 : 3;
  std::vector<std::pair<double, int>> keyed;
  keyed.reserve(order.size());
  for (int k = 0; k < count; ++k) {
    keyed.emplace_back(radical_inverse(static_cast<std::uint32_t>(k), base), k);
  }
  std::sort(keyed.begin(), keyed.end());
  for (int rank = 0; rank < count; ++rank) {
    at(order, at(keyed, rank).second) = rank;
  }
  return order;
}

std::vector<DirectionSample> rotated(std::vector<DirectionSample> samples, std::uint64_t seed) {
  const Rotation rotation = random_rotation(seed);
  for (DirectionSample& sample : samples) {
    sample = sample_along(normalized(rotation(sample.direction)));
  }
  return samples;
}

}  // namespace transillum
