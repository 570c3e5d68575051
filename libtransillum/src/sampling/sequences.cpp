// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sequences of points that directions are made from (paper, section 4). Numbers of points are
// 32-bit and wrap around.
#include "sampling/sequences.h"

#include <fmt/format.h>

#include <boost/random/sobol.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "base/bit_mixing.h"
#include "sampling/sphere_map.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// A double in [0,1) from the upper 53 bits: the same on every standard library.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

std::uint32_t bit_reversed(std::uint32_t k) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit, k >>= 1) {
    reversed = (reversed << 1) | (k & 1u);
  }
  return reversed;
}

/// Owen's nested uniform scrambling in base 2: each binary digit of x is flipped or not by a random
/// bit that depends on all digits before it. Every scrambled point is uniform, and the
/// equidistribution of a set is kept: dyadic intervals of a length map to dyadic intervals of that
/// length.
///
/// @param x the first 32 digits of a number in [0,1)
/// @param seed a different one for each coordinate, which are otherwise scrambled equally
std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t seed) {
  std::uint32_t flips = 0;
  for (int digit = 0; digit < 32; ++digit) {
    // The node of the binary tree given by the digits before this one.
    const std::uint64_t node = (std::uint64_t{1} << digit) | (std::uint64_t{x} >> (32 - digit));
    flips |= static_cast<std::uint32_t>(mixed(seed + node * golden_step) >> 63) << (31 - digit);
  }
  return x ^ flips;
}

/// A point given by the first 32 binary digits of its coordinates, which are scrambled
/// independently.
DirectionSample scrambled(std::uint32_t u, std::uint32_t v, std::uint64_t seed) {
  const auto coordinate = [seed](std::uint32_t digits, std::uint64_t axis) {
    return (owen_scrambled(digits, mixed(seed + axis * golden_step)) + 0.5) * 0x1p-32;
  };
  return sample_at(coordinate(u, 1), coordinate(v, 2));
}

/// Sobol's points in the plane, from number `k` on.
class SobolDigits {
 public:
  explicit SobolDigits(std::uint32_t k) : next_(k), points_(2) { skip_to_next(); }

  std::pair<std::uint32_t, std::uint32_t> take() {
    // Boost omits the origin, number 0. Scrambled it is a point like any other, and nets of 2^m
    // points require it.
    std::pair<std::uint32_t, std::uint32_t> digits{0, 0};
    if (next_ != 0) {
      digits.first = static_cast<std::uint32_t>(points_() >> 32);
      digits.second = static_cast<std::uint32_t>(points_() >> 32);
    }
    if (++next_ == 0) {
      skip_to_next();
    }
    return digits;
  }

 private:
  void skip_to_next() { points_.seed(next_ > 0 ? next_ - 1 : 0); }

  std::uint32_t next_;
  boost::random::sobol points_;
};

DirectionSample hammersley_point(std::uint32_t k, int count) {
  return sample_at(static_cast<double>(k) / count, radical_inverse(k, 2));
}

DirectionSample centered_hammersley_point(std::uint32_t k, int count) {
  return sample_at(radical_inverse(k, 2), (k + 0.5) / count);
}

DirectionSample scrambled_hammersley_point(std::uint32_t k, int count, std::uint64_t seed) {
  const std::uint64_t u = (std::uint64_t{k} << 32) / static_cast<std::uint64_t>(count);
  return scrambled(static_cast<std::uint32_t>(u), bit_reversed(k), seed);
}

DirectionSample fibonacci_point(std::uint32_t k, int count) {
  const double turns = k / std::numbers::phi;
  return sample_at(turns - std::floor(turns), (k + 0.5) / count);
}

}  // namespace

void check_direction_count(int count) {
  if (count < 1 || count > max_directions) {
    throw InputError(
        fmt::format("{} directions: the number must be from 1 to {}", count, max_directions));
  }
}

double radical_inverse(std::uint32_t k, std::uint32_t base) {
  std::uint64_t mirrored = 0, power = 1;
  for (; k != 0; k /= base, power *= base) {
    mirrored = mirrored * base + k % base;
  }
  return static_cast<double>(mirrored) / static_cast<double>(power);
}

std::vector<DirectionSample> extensible_points(Sampling sampling, std::uint32_t begin, int count,
                                               std::uint64_t seed) {
  std::vector<DirectionSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  SobolDigits sobol(begin);
  std::mt19937_64 generator(seed);
  if (sampling == Sampling::random) {
    generator.discard(2 * std::uint64_t{begin});
  }
  for (std::uint32_t k = begin; samples.size() < static_cast<std::size_t>(count); ++k) {
    if (sampling == Sampling::halton) {
      samples.push_back(sample_at(radical_inverse(k, 2), radical_inverse(k, 3)));
    } else if (sampling == Sampling::sobol) {
      const auto [u, v] = sobol.take();
      samples.push_back(scrambled(u, v, seed));
    } else {
      const double u = uniform(generator);
      samples.push_back(sample_at(u, uniform(generator)));
    }
  }
  return samples;
}

std::vector<DirectionSample> make_directions(Sampling sampling, int count, std::uint64_t seed) {
  check_direction_count(count);
  if (is_extensible(sampling)) {
    return extensible_points(sampling, 0, count, seed);
  }
  std::vector<DirectionSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  if (sampling == Sampling::antipodal) {
    for (const Vec3& axis : antipodal_set(count)) {
      samples.push_back(sample_along(axis));
    }
    return samples;
  }
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
    switch (sampling) {
      case Sampling::centered_hammersley:
        samples.push_back(centered_hammersley_point(k, count));
        break;
      case Sampling::scrambled_hammersley:
        samples.push_back(scrambled_hammersley_point(k, count, seed));
        break;
      case Sampling::fibonacci:
        samples.push_back(fibonacci_point(k, count));
        break;
      default:
        samples.push_back(hammersley_point(k, count));
    }
  }
  return samples;
}

std::vector<DirectionSample> make_directions(Sampling sampling, int begin, int end,
                                             std::uint64_t seed) {
  if (!is_extensible(sampling)) {
    throw InputError(
        fmt::format("{}: its points depend on their number, so the sequence cannot be continued",
                    name_of(sampling)));
  }
  if (begin < 0 || end < begin || end > max_directions) {
    throw InputError(
        fmt::format("directions {} to {}: not within 0 to {}", begin, end, max_directions));
  }
  return extensible_points(sampling, static_cast<std::uint32_t>(begin), end - begin, seed);
}

}  // namespace transillum
