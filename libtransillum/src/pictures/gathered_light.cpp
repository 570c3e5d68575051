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

/// The meeting of a ray with a triangle that Embree has found.
GatheredLight::Met GatheredLight::met_at(const Line& line, unsigned triangle,
                                         float distance) const {
  const PatchId hit = embree_.patch_of(triangle);
  const PatchId lit = embree_.lit_at(hit, line.start, line.direction, distance);
  return {
      lit == no_patch ? hit : lit, lit != no_patch,
      scene_.bounds().center() +
          (1 / embree_.scale()) * (line.start + static_cast<double>(distance) * line.direction)};
}

/// The light of a ray that meets `met`, without the exitance of lamps.
Rgb GatheredLight::brought(const Met& met, const Vec3& direction) const {
  if (met.is_lit) {
    return light_.at_point(met.patch, met.point);
  }
  return met.patch == no_patch && solution_.sky.is_set()
             ? solution_.sky.relative_radiance(direction) * solution_.sky.exitance
             : Rgb();
}

/// The sum of the light of up to 16 similar rays.
Rgb GatheredLight::brought(const Vec3& start, std::span<const Vec3> directions) const {
  alignas(64) std::array<int, packet> valid{};
  RTCRayHit16 rays{};
  for (std::size_t k = 0; k < packet; ++k) {
    const Vec3& direction = directions[std::min(k, directions.size() - 1)];
    valid[k] = k < directions.size() ? -1 : 0;
    rays.ray.org_x[k] = static_cast<float>(start.x);
    rays.ray.org_y[k] = static_cast<float>(start.y);
    rays.ray.org_z[k] = static_cast<float>(start.z);
    rays.ray.dir_x[k] = static_cast<float>(direction.x);
    rays.ray.dir_y[k] = static_cast<float>(direction.y);
    rays.ray.dir_z[k] = static_cast<float>(direction.z);
    rays.ray.tfar[k] = HUGE_VALF;
    rays.ray.mask[k] = ~0U;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  embree_.first_hits(valid.data(), rays);
  Rgb sum;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    sum += brought(rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID
                       ? Met()
                       : met_at({start, directions[k]}, rays.hit.primID[k], rays.ray.tfar[k]),
                   directions[k]);
  }
  return sum;
}

GatheredLight::Gathered GatheredLight::at_point(const Vec3& x, const Vec3& normal,
                                                std::uint64_t salt) const {
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
  std::array<Vec3, packet> directions;
  for (std::size_t half = 0; half < 2; ++half) {
    const std::vector<Vec3>& set = table[half];
    for (std::size_t first = 0; first < set.size(); first += packet) {
      const std::size_t count = std::min(packet, set.size() - first);
      for (std::size_t k = 0; k < count; ++k) {
        directions[k] = frame.turned(set[first + k]);
      }
      means[half] += brought(start, {directions.data(), count});
    }
    means[half] = 1 / static_cast<double>(std::max<std::size_t>(set.size(), 1)) * means[half];
  }
  if (table[1].empty()) {
    return {means[0], means[0]};
  }
  return {0.5 * (means[0] + means[1]), 0.5 * (means[0] - means[1])};
}

GatheredLight::Arriving GatheredLight::arriving(const Vec3& x, const Vec3& normal,
                                                const Vec3& direction) const {
  const Vec3 start = start_of_rays(embree_, x, normal);
  RTCRayHit ray = make_ray(start, direction);
  embree_.first_hit(ray, false);
  const Met met = has_hit(ray) ? met_at({start, direction}, ray.hit.primID, ray.ray.tfar) : Met();
  const bool is_lamp = met.is_lit && max_abs(light_.exitance(met.patch)) > 0;
  return {brought(met, direction), is_lamp ? met.patch : no_patch, met.point};
}

}  // namespace transillum
