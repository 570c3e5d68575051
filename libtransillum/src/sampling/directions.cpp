// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/directions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr int max_directions = 1 << 24;

/// The bits of k mirrored at the binary point: van der Corput's sequence in base 2.
double radical_inverse(std::uint32_t k) {
  double inverse = 0;
  for (double digit = 0.5; k != 0; k >>= 1, digit *= 0.5) {
    if (k & 1u) inverse += digit;
  }
  return inverse;
}

/// Eq. 13: uniform on the square to uniform on the sphere.
Vec3 to_sphere(double u, double v) {
  const double psi = 2 * std::numbers::pi * u;
  const double cos_theta = 1 - 2 * v;
  const double sin_theta = std::sqrt(std::max(0.0, 4 * v * (1 - v)));
  return {sin_theta * std::cos(psi), sin_theta * std::sin(psi), cos_theta};
}

/// A double in [0,1) from the upper 53 bits: the same on every standard library.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

}  // namespace

const std::vector<std::string>& sampling_names() {
  static const std::vector<std::string> names{"hammersley", "random", "fibonacci"};
  return names;
}

Sampling sampling_from_name(const std::string& name) {
  const auto& names = sampling_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("unknown sampling \"{}\"; choose one of {}", name, fmt::join(names, ", ")));
  }
  return static_cast<Sampling>(found - names.begin());
}

const std::string& name_of(Sampling sampling) {
  return sampling_names()[static_cast<std::size_t>(sampling)];
}

std::vector<DirectionSample> make_directions(Sampling sampling, int count, std::uint64_t seed) {
  if (count < 1 || count > max_directions) {
    throw InputError(
        fmt::format("{} directions: the number must be from 1 to {}", count, max_directions));
  }
  std::mt19937_64 generator(seed);
  std::vector<DirectionSample> samples(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    DirectionSample& sample = samples[static_cast<std::size_t>(k)];
    switch (sampling) {
      case Sampling::hammersley:
        sample.u = static_cast<double>(k) / count;
        sample.v = radical_inverse(static_cast<std::uint32_t>(k));
        break;
      case Sampling::random:
        sample.u = uniform(generator);
        sample.v = uniform(generator);
        break;
      case Sampling::fibonacci: {
        const double turns = k / std::numbers::phi;
        sample.u = turns - std::floor(turns);
        sample.v = (k + 0.5) / count;
        break;
      }
    }
    sample.direction = to_sphere(sample.u, sample.v);
  }
  return samples;
}

std::vector<int> progressive_order(int count) {
  std::vector<std::pair<double, int>> keyed(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    keyed[static_cast<std::size_t>(k)] = {radical_inverse(static_cast<std::uint32_t>(k)), k};
  }
  // Ranks of the radical inverses: the order in which van der Corput's points fill the interval,
  // stretched over 0 … count-1 whatever the count.
  std::sort(keyed.begin(), keyed.end());
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int rank = 0; rank < count; ++rank) {
    order[static_cast<std::size_t>(keyed[static_cast<std::size_t>(rank)].second)] = rank;
  }
  return order;
}

}  // namespace transillum
