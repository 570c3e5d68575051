// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Rays by Embree from points of surfaces, distributed by the cosine: the mean of what they meet is
// the irradiance. Sequences are Hammersley's, shifted by a different amount in each table, and
// turned about the normal.
#include "pictures/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/bit_mixing.h"
#include "pictures/sequences.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr std::size_t table_count = 64;

}  // namespace

GatheredLight::GatheredLight(const Solution& solution, const EmbreeScene& embree,
                             const HitLight& light, int rays)
    : solution_(solution), scene_(*solution.scene), light_(light), embree_(embree) {
  for (std::size_t k = 0; k < table_count; ++k) {
    const auto number = static_cast<double>(k);
    tables_.push_back(cosine_directions(rays, fraction(plastic_step * number),
                                        fraction(plastic_square * number)));
  }
}

/// The light of a ray that meets `met`, without the exitance of lamps.
Rgb GatheredLight::brought(const Met& met, const Vec3& direction,
                           const Cancellation& cancellation) const {
  if (met.is_lit) {
    return light_.at_point(met.patch, met.place, cancellation);
  }
  return met.patch == no_patch && solution_.sky.is_set()
             ? solution_.sky.relative_radiance(direction) * solution_.sky.exitance
             : Rgb();
}

/// The sum of the light of up to 16 similar rays.
Rgb GatheredLight::brought(const Vec3& start, std::span<const Vec3> directions,
                           const Cancellation& cancellation) const {
  cancellation.throw_if_canceled();
  const std::array<Met, ray_packet> met = met_by(embree_, start, directions);
  Rgb sum;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    sum += brought(met[k], directions[k], cancellation);
  }
  return sum;
}

GatheredLight::Gathered GatheredLight::at_point(const Vec3& x, const Vec3& normal,
                                                std::uint64_t salt,
                                                const Cancellation& cancellation) const {
  // Samples of a pixel have different tables, which together fill the hemisphere evenly.
  const auto [pixel, number] = split(salt);
  const std::uint64_t bits = mixed(pixel + golden_step * (number / table_count + 1));
  const auto& table = tables_[salt == 0 ? 0 : (bits + number) % table_count];
  const double angle = salt == 0 ? 0 : 2 * std::numbers::pi * unit_fraction(bits);
  const TangentFrame about(normal);
  TangentFrame frame = about;
  frame.u = std::cos(angle) * about.u + std::sin(angle) * about.v;
  frame.v = cross(normal, frame.u);
  const Vec3 start = start_of_rays(embree_, x, normal);
  std::array<Rgb, 2> means{};
  std::array<Vec3, ray_packet> directions;
  for (std::size_t half = 0; half < 2; ++half) {
    const std::vector<Vec3>& set = table[half];
    for (std::size_t first = 0; first < set.size(); first += ray_packet) {
      const std::size_t count = std::min(ray_packet, set.size() - first);
      for (std::size_t k = 0; k < count; ++k) {
        directions[k] = frame.turned(set[first + k]);
      }
      means[half] += brought(start, {directions.data(), count}, cancellation);
    }
    means[half] = 1 / static_cast<double>(std::max<std::size_t>(set.size(), 1)) * means[half];
  }
  if (table[1].empty()) {
    return {means[0], max_abs(means[0])};
  }
  return {0.5 * (means[0] + means[1]), max_abs(0.5 * (means[0] - means[1]))};
}

GatheredLight::Arriving GatheredLight::arriving(const Vec3& x, const Vec3& normal,
                                                const Vec3& direction,
                                                const Cancellation& cancellation) const {
  cancellation.throw_if_canceled();
  const Met met = met_by(embree_, start_of_rays(embree_, x, normal), direction);
  const bool is_lamp = met.is_lit && max_abs(light_.exitance(met.patch)) > 0;
  return {brought(met, direction, cancellation), is_lamp ? met.patch : no_patch, met.place};
}

}  // namespace transillum
