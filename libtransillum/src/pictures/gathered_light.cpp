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

/// Height above a surface at which rays start, in Embree's unit: a few roundings of a coordinate.
constexpr double lift = 2e-6;
constexpr std::size_t table_count = 64;

std::vector<Vec3> cosine_directions(int count, double shift_u, double shift_v) {
  std::vector<Vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double square = fraction((k + 0.5) / count + shift_u);
    const double angle =
        2 * std::numbers::pi * fraction(mirrored_bits(static_cast<std::uint32_t>(k)) + shift_v);
    const double radius = std::sqrt(square);
    directions.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - square)});
  }
  return directions;
}

}  // namespace

TangentFrame::TangentFrame(const Vec3& normal)
    : u(normalized(cross(std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, normal))),
      v(cross(normal, u)),
      w(normal) {}

GatheredLight::GatheredLight(std::shared_ptr<const Solution> solution,
                             const std::vector<PatchId>& lamps, int rays,
                             const Cancellation& cancellation)
    : solution_(std::move(solution)),
      scene_(*solution_->scene),
      embree_(scene_, cancellation),
      rays_(rays),
      means_(solution_->radiosity),
      is_lamp_(means_.size(), 0),
      terms_(solution_->linear_terms) {
  for (const PatchId i : lamps) {
    at(is_lamp_, i) = 1;
    at(means_, i) = at(means_, i) - scene_.exitance(i);
  }
  if (!terms_.empty()) {
    bases_ = linear_bases(scene_);
  }
  for (std::size_t k = 0; k < table_count; ++k) {
    const auto number = static_cast<double>(k);
    tables_.push_back(cosine_directions(rays, fraction(plastic_step * number),
                                        fraction(plastic_square * number)));
  }
}

Vec3 GatheredLight::start_of(const Vec3& x, const Vec3& normal) const {
  return embree_.inside(x) + lift * normal;
}

GatheredLight::Met GatheredLight::meet(const Vec3& start, const Vec3& direction) const {
  RTCRayHit ray = make_ray(start, direction);
  embree_.first_hit(ray, false);
  if (!has_hit(ray)) {
    return {};
  }
  const PatchId hit = embree_.patch_of(ray.hit.primID);
  const PatchId lit = embree_.lit_at(hit, start, direction, ray.ray.tfar);
  const double distance = static_cast<double>(ray.ray.tfar);
  return {lit == no_patch ? hit : lit, lit != no_patch, distance / embree_.scale(),
          scene_.bounds().center() + (1 / embree_.scale()) * (start + distance * direction)};
}

/// B where a ray meets a patch, without the exitance of lamps.
Rgb GatheredLight::leaving(const Met& met) const {
  Rgb light = at(means_, met.patch);
  if (!bases_.empty()) {
    const auto [first, second] = at(bases_, met.patch).at(met.point);
    light += first * at(terms_, met.patch).first + second * at(terms_, met.patch).second;
    light = {std::max(light.r, 0.0), std::max(light.g, 0.0), std::max(light.b, 0.0)};
  }
  return light;
}

GatheredLight::Gathered GatheredLight::at_point(const Vec3& x, const Vec3& normal,
                                                std::uint64_t variant) const {
  const std::uint64_t bits = mixed(variant + golden_step);
  const std::vector<Vec3>& table = tables_[variant == 0 ? 0 : bits % table_count];
  const double angle = variant == 0 ? 0 : 2 * std::numbers::pi * unit_fraction(bits);
  const TangentFrame about(normal);
  TangentFrame frame = about;
  frame.u = std::cos(angle) * about.u + std::sin(angle) * about.v;
  frame.v = cross(normal, frame.u);
  const Vec3 start = start_of(x, normal);
  Rgb sum;
  double inverse_distances = 0;
  const double nearest = lift / embree_.scale();
  for (const Vec3& local : table) {
    const Vec3 direction = frame.turned(local);
    const Met met = meet(start, direction);
    if (met.patch == no_patch) {
      if (solution_->sky.is_set()) {
        sum += solution_->sky.relative_radiance(direction) * solution_->sky.exitance;
      }
      continue;
    }
    inverse_distances += 1 / std::max(met.distance, nearest);
    if (met.is_lit) {
      sum += leaving(met);
    }
  }
  const double count = static_cast<double>(table.size());
  return {1 / count * sum, inverse_distances > 0 ? count / inverse_distances : HUGE_VAL};
}

Rgb GatheredLight::arriving(const Vec3& x, const Vec3& normal, const Vec3& direction) const {
  const Met met = meet(start_of(x, normal), direction);
  if (met.patch == no_patch) {
    return solution_->sky.is_set()
               ? solution_->sky.relative_radiance(direction) * solution_->sky.exitance
               : Rgb();
  }
  if (!met.is_lit) {
    return {};
  }
  Rgb light = leaving(met);
  if (at(is_lamp_, met.patch) != 0) {
    light += scene_.exitance(met.patch);
  }
  return light;
}

}  // namespace transillum
