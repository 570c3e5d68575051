// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/surface_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "pictures/sequences.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Height above a surface at which rays start, in Embree's unit: a few roundings of a coordinate.
constexpr double lift = 2e-6;

/// The bits of two numbers below 2^8, alternating: near points get near numbers.
std::uint32_t interleaved(std::uint32_t a, std::uint32_t b) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 8; ++k) {
    bits |= ((a >> k) & 1U) << (2 * k) | ((b >> k) & 1U) << (2 * k + 1);
  }
  return bits;
}

/// A half-line, in Embree's coordinates.
struct Line {
  const Vec3 &start, &direction;
};

/// The meeting of a ray with a triangle that Embree has found.
Met met_at(const EmbreeScene& scene, const Line& line, unsigned triangle, float distance) {
  const PatchId hit = scene.patch_of(triangle);
  const PatchId lit = scene.lit_at(hit, line.start, line.direction, distance);
  return {lit == no_patch ? hit : lit, lit != no_patch,
          scene.outside(line.start + static_cast<double>(distance) * line.direction)};
}

}  // namespace

TangentFrame::TangentFrame(const Vec3& normal)
    : u(normalized(cross(std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, normal))),
      v(cross(normal, u)),
      w(normal) {}

std::array<std::vector<Vec3>, 2> cosine_directions(int count, double shift_u, double shift_v) {
  std::array<std::vector<Vec3>, 2> sets;
  for (int k = 0; k < count; ++k) {
    const double square = fraction((k + 0.5) / count + shift_u);
    const double turn = mirrored_bits(static_cast<std::uint32_t>(k / 2)) + plastic_step * (k % 2);
    const double angle = 2 * std::numbers::pi * fraction(turn + shift_v);
    const double radius = std::sqrt(square);
    at(sets, k % 2)
        .push_back({radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - square)});
  }
  const auto place = [](const Vec3& w) {
    const auto step = [](double x) { return static_cast<std::uint32_t>(127.5 * (x + 1)); };
    return interleaved(step(w.x), step(w.y));
  };
  for (std::vector<Vec3>& set : sets) {
    std::stable_sort(set.begin(), set.end(),
                     [&](const Vec3& a, const Vec3& b) { return place(a) < place(b); });
  }
  return sets;
}

Vec3 start_of_rays(const EmbreeScene& scene, const Vec3& x, const Vec3& normal) {
  return scene.inside(x) + lift * normal;
}

Met met_by(const EmbreeScene& scene, const Vec3& start, const Vec3& direction) {
  RTCRayHit ray = make_ray(start, direction);
  scene.first_hit(ray, false);
  return has_hit(ray) ? met_at(scene, {start, direction}, ray.hit.primID, ray.ray.tfar) : Met();
}

std::array<Met, ray_packet> met_by(const EmbreeScene& scene, const Vec3& start,
                                   std::span<const Vec3> directions) {
  alignas(64) std::array<int, ray_packet> valid{};
  RTCRayHit16 rays{};
  for (std::size_t k = 0; k < ray_packet; ++k) {
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
  scene.first_hits(valid.data(), rays);
  std::array<Met, ray_packet> met;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID) {
      met[k] = met_at(scene, {start, directions[k]}, rays.hit.primID[k], rays.ray.tfar[k]);
    }
  }
  return met;
}

bool is_covered(const EmbreeScene& scene, const Vec3& x, const Vec3& normal, bool dark_sky) {
  // The normal first, which ends most queries.
  static const std::vector<Vec3> others = cosine_directions(32, 0, 0)[0];
  const Vec3 start = start_of_rays(scene, x, normal);
  const auto is_dark = [&](const Vec3& direction) {
    RTCRayHit ray = make_ray(start, direction);
    scene.first_hit(ray, false);
    return has_hit(ray) ? scene.lit_at(scene.patch_of(ray.hit.primID), start, direction,
                                       ray.ray.tfar) == no_patch
                        : dark_sky;
  };
  const TangentFrame frame(normal);
  return is_dark(normal) && std::all_of(others.begin(), others.end(), [&](const Vec3& direction) {
           return is_dark(frame.turned(direction));
         });
}

}  // namespace transillum
