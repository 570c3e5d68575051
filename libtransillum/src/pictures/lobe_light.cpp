// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Rays of the lobe find lamps seldom if the lobe is wide, points of lamps are seldom within a lobe
// that is narrow: both are used, each with a weight by the density of both (the balance heuristic
// of Veach and Guibas, 1995). Rays are distributed by Phong's power of the cosine, or by the
// normals of microfacets that are visible (Heitz, 2018).
#include "pictures/lobe_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/luminance.h"
#include "pictures/sequences.h"
#include "transillum/at.h"

namespace transillum {
namespace {

Vec3 about(const TangentFrame& frame, double cosine, double angle) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return frame.turned({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

double alpha_of(const Lobe& lobe) { return std::max(lobe.roughness * lobe.roughness, 1e-4); }

/// The normal of a microfacet that is visible from `toward`; both in the surface's frame.
Vec3 visible_normal(const Vec3& toward, double alpha, double u, double v) {
  const Vec3 stretched = normalized({alpha * toward.x, alpha * toward.y, toward.z});
  const TangentFrame frame(stretched);
  // The second axis in the plane of the surface's normal.
  const double across = std::hypot(stretched.x, stretched.y);
  const Vec3 first = across > 1e-9 ? Vec3{-stretched.y, stretched.x, 0} / across : frame.u;
  const Vec3 second = cross(stretched, first);
  const double radius = std::sqrt(u), angle = 2 * std::numbers::pi * v;
  const double a = radius * std::cos(angle), part = 0.5 * (1 + stretched.z);
  const double b = (1 - part) * std::sqrt(1 - a * a) + part * radius * std::sin(angle);
  const Vec3 normal =
      a * first + b * second + std::sqrt(std::max(0.0, 1 - a * a - b * b)) * stretched;
  return normalized({alpha * normal.x, alpha * normal.y, std::max(0.0, normal.z)});
}

}  // namespace

/// A point whose lobe is asked for.
struct LobeLight::Query {
  const Lobe& lobe;
  const LobeFunction& function;
  Vec3 x, normal, toward, mirror;
  TangentFrame frame;  ///< about the mirror direction, or the normal
  const Cancellation& cancellation;

  double reflected(const Vec3& direction) const {
    return function.value(toward, direction, normal) * dot(direction, normal);
  }
  Vec3 sampled(double u, double v) const {
    if (lobe.shape == LobeShape::phong) {
      return about(frame, std::pow(1 - u, 1 / (lobe.exponent + 1)), 2 * std::numbers::pi * v);
    }
    const Vec3 local{dot(toward, frame.u), dot(toward, frame.v), dot(toward, frame.w)};
    const Vec3 half = frame.turned(visible_normal(local, alpha_of(lobe), u, v));
    return 2 * dot(half, toward) * half - toward;
  }
  /// The density of sampled(), by solid angle.
  double density(const Vec3& direction) const {
    if (lobe.shape == LobeShape::phong) {
      return (lobe.exponent + 1) / (2 * std::numbers::pi) *
             std::pow(std::max(dot(direction, mirror), 0.0), lobe.exponent);
    }
    const Vec3 half = normalized(toward + direction);
    const double square = std::pow(alpha_of(lobe), 2), cosine = dot(half, normal);
    const double spread = 1 + (square - 1) * cosine * cosine;
    const double height = dot(toward, normal);
    // G1 / cosine of `toward`.
    const double visible = 2 / (height + std::sqrt(square + (1 - square) * height * height));
    return square / (std::numbers::pi * spread * spread) * visible / 4;
  }
};

LobeLight::LobeLight(const Scene& scene, const GatheredLight& gathered, const LampLight& lamps,
                     int rays, const Cancellation& cancellation)
    : scene_(scene), gathered_(gathered), lamp_light_(lamps), rays_(rays) {
  for (const Material& material : scene.materials()) {
    const Lobe lobe = used_lobe(material);
    lobes_.push_back(
        {lobe, lobe.present() ? std::make_unique<LobeFunction>(lobe, cancellation) : nullptr});
  }
  const std::vector<PatchId>& of_lamps = lamps.patches();
  double power = 0;
  for (const Piece& piece : scene.pieces()) {
    if (!std::binary_search(of_lamps.begin(), of_lamps.end(), piece.patch)) {
      continue;
    }
    const auto corners = scene.corners(piece);
    const Vec3& corner = scene.point(corners[0]);
    for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
      const Vec3 first = scene.point(corners[c]) - corner,
                 second = scene.point(corners[c + 1]) - corner;
      power += 0.5 * norm(cross(first, second)) * luminance(scene.exitance(piece.patch));
      lamps_.push_back({corner, first, second, power});
    }
  }
  lamp_rays_ = power > 0 ? std::max(rays / 2, 1) : 0;
}

/// The light of a ray that the lobe has distributed.
Rgb LobeLight::by_lobe(const Query& query, double u, double v) const {
  const Vec3 direction = query.sampled(u, v);
  const double density = query.density(direction);
  if (!(dot(direction, query.normal) > 0 && density > 0)) {
    return {};
  }
  const auto [light, lamp, place] =
      gathered_.arriving(query.x, query.normal, direction, query.cancellation);
  Rgb sum = 1 / (rays_ * density) * light;
  if (lamp != no_patch) {
    sum += weight_of(query, direction, lamp, place) * scene_.exitance(lamp);
  }
  return query.reflected(direction) * sum;
}

/// The light of a point of the lamps.
Rgb LobeLight::by_lamps(const Query& query, double u, double v) const {
  const double power = u * lamps_.back().end;
  const auto chosen = std::lower_bound(
      lamps_.begin(), lamps_.end() - 1, power,
      [](const LampTriangle& triangle, double value) { return triangle.end < value; });
  const double begin = chosen == lamps_.begin() ? 0 : (chosen - 1)->end;
  const double root = std::sqrt(std::clamp((power - begin) / (chosen->end - begin), 0.0, 1.0));
  const Vec3 y = chosen->corner + root * ((1 - v) * chosen->first + v * chosen->second);
  const double distance = norm(y - query.x);
  const Vec3 direction = (y - query.x) / distance;
  if (!(dot(direction, query.normal) > 0) ||
      !(dot(direction, cross(chosen->first, chosen->second)) < 0)) {
    return {};
  }
  constexpr double rounding = 1e-4;
  const auto [light, lamp, place] =
      gathered_.arriving(query.x, query.normal, direction, query.cancellation);
  if (lamp == no_patch || std::abs(norm(place - query.x) - distance) > rounding * distance) {
    return {};
  }
  return query.reflected(direction) * weight_of(query, direction, lamp, place) *
         scene_.exitance(lamp);
}

/// The weight of a ray to a lamp: one over the sum of the densities of both kinds of rays.
double LobeLight::weight_of(const Query& query, const Vec3& direction, PatchId lamp,
                            const Vec3& place) const {
  const Vec3 to = place - query.x;
  const double cosine = -dot(direction, scene_.patch(lamp).normal);
  const double by_area = luminance(scene_.exitance(lamp)) / lamps_.back().end;
  return 1 / (rays_ * query.density(direction) +
              lamp_rays_ * by_area * dot(to, to) / std::max(cosine, 1e-12));
}

Rgb LobeLight::at_point(PatchId patch, const Vec3& x, const Vec3& toward, std::uint64_t salt,
                        const Cancellation& cancellation) const {
  const auto& [lobe, function] = at(lobes_, scene_.patch(patch).material);
  if (!function) {
    return {};
  }
  const Vec3& normal = scene_.patch(patch).normal;
  const Vec3 mirror = 2 * dot(normal, toward) * normal - toward;
  const Query query{lobe,
                    *function,
                    x,
                    normal,
                    toward,
                    mirror,
                    TangentFrame(lobe.shape == LobeShape::phong ? mirror : normal),
                    cancellation};
  const auto [pixel, number] = split(salt);
  Rgb sum;
  for (int k = 0; k < rays_; ++k) {
    const auto [u, v] = scrambled_point(
        number * static_cast<std::uint32_t>(rays_) + static_cast<std::uint32_t>(k), pixel);
    sum += by_lobe(query, u, v);
  }
  for (int k = 0; k < lamp_rays_; ++k) {
    const auto [u, v] = scrambled_point(
        number * static_cast<std::uint32_t>(lamp_rays_) + static_cast<std::uint32_t>(k), ~pixel);
    sum += by_lamps(query, u, v);
  }
  lamp_light_.visit_sun(patch, x, [&](const Vec3& direction, const Rgb& irradiance) {
    sum += std::numbers::pi * function->value(toward, direction, normal) * irradiance;
  });
  return lobe.reflectance * sum;
}

}  // namespace transillum
