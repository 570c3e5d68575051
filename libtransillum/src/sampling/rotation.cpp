// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <cmath>
#include <numbers>

#include "base/bit_mixing.h"
#include "sampling/sphere_map.h"

namespace transillum {
namespace {

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
  const double share = uniform(1);
  const double a = 2 * std::numbers::pi * uniform(2), b = 2 * std::numbers::pi * uniform(3);
  const double x = std::sqrt(1 - share) * std::sin(a), y = std::sqrt(1 - share) * std::cos(a);
  const double z = std::sqrt(share) * std::sin(b), w = std::sqrt(share) * std::cos(b);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

}  // namespace

std::vector<DirectionSample> rotated(std::vector<DirectionSample> samples, std::uint64_t seed) {
  const Rotation rotation = random_rotation(seed);
  for (DirectionSample& sample : samples) {
    sample = sample_along(normalized(rotation(sample.direction)));
  }
  return samples;
}

}  // namespace transillum
