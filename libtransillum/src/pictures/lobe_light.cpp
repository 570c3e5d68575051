// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Rays are distributed as the lobe's peak: for a power of the cosine about the mirror direction,
// for microfacets by their normals. Each has the weight of the lobe over its density.
#include "pictures/lobe_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/bit_mixing.h"
#include "pictures/sequences.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// A direction that a lobe reflects light from, and its density by solid angle.
struct Sampled {
  Vec3 direction;
  double density = 0;
};

Vec3 about(const TangentFrame& frame, double cosine, double angle) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return frame.turned({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

Sampled sample(const Lobe& lobe, const Vec3& normal, const Vec3& toward, double u, double v) {
  const double angle = 2 * std::numbers::pi * v;
  if (lobe.shape == LobeShape::phong) {
    const double cosine = std::pow(1 - u, 1 / (lobe.exponent + 1));
    const Vec3 mirror = 2 * dot(normal, toward) * normal - toward;
    return {about(TangentFrame(mirror), cosine, angle),
            (lobe.exponent + 1) / (2 * std::numbers::pi) * std::pow(cosine, lobe.exponent)};
  }
  const double alpha = std::max(lobe.roughness * lobe.roughness, 1e-4), square = alpha * alpha;
  const double cosine = std::sqrt((1 - u) / (1 + (square - 1) * u));
  const Vec3 half = about(TangentFrame(normal), cosine, angle);
  const double along = dot(half, toward);
  const double spread = 1 + (square - 1) * cosine * cosine;
  return {2 * along * half - toward, square * cosine / (std::numbers::pi * spread * spread) /
                                         std::max(4 * std::abs(along), 1e-12)};
}

}  // namespace

LobeLight::LobeLight(const Scene& scene, const GatheredLight& gathered, int rays,
                     const Cancellation& cancellation)
    : scene_(scene), gathered_(gathered), rays_(rays) {
  for (const Material& material : scene.materials()) {
    const Lobe lobe = used_lobe(material);
    lobes_.push_back(
        {lobe, lobe.present() ? std::make_unique<LobeFunction>(lobe, cancellation) : nullptr});
  }
}

Rgb LobeLight::at_point(PatchId patch, const Vec3& x, const Vec3& toward,
                        std::uint64_t variant) const {
  const auto& [lobe, function] = at(lobes_, scene_.patch(patch).material);
  if (!function) {
    return {};
  }
  const Vec3& normal = scene_.patch(patch).normal;
  const double shift_u = unit_fraction(mixed(variant)), shift_v = unit_fraction(mixed(~variant));
  Rgb sum;
  for (int k = 0; k < rays_; ++k) {
    const auto [direction, density] =
        sample(lobe, normal, toward, fraction((k + 0.5) / rays_ + shift_u),
               fraction(mirrored_bits(static_cast<std::uint32_t>(k)) + shift_v));
    const double cosine = dot(direction, normal);
    if (cosine > 0 && density > 0) {
      sum += function->value(toward, direction, normal) * cosine / density *
             gathered_.arriving(x, normal, direction);
    }
  }
  return 1.0 / rays_ * (lobe.reflectance * sum);
}

}  // namespace transillum
