// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/hit_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

constexpr int term_count = 6;
using Terms = Eigen::Matrix<double, term_count, 1>;

/// The terms of a quadratic function of the basis functions at a point.
Terms terms_at(double a, double b) { return Terms{{1, a, b, a * b, a * a, b * b}}; }

Rgb limited(const Rgb& x, const Rgb& low, const Rgb& high) {
  return {std::clamp(x.r, low.r, high.r), std::clamp(x.g, low.g, high.g),
          std::clamp(x.b, low.b, high.b)};
}

/// Calls visit(point, weight) for Radon's rule, which is exact for polynomials of degree 5 and
/// whose points are inside the triangle.
template <class Visit>
void for_points_of_triangle(const std::array<Vec3, 3>& corners, Visit visit) {
  const double area = 0.5 * norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double root = std::sqrt(15);
  visit((corners[0] + corners[1] + corners[2]) / 3, area * 9 / 40);
  for (const double sign : {-1.0, 1.0}) {
    const double share = (6 + sign * root) / 21;
    for (std::size_t k = 0; k < 3; ++k) {
      visit(share * (corners[(k + 1) % 3] + corners[(k + 2) % 3]) + (1 - 2 * share) * corners[k],
            area * (155 + sign * root) / 1200);
    }
  }
}

}  // namespace

struct HitLight::DirectLight {
  std::array<Rgb, term_count> coefficients;
  Rgb low, high;                     ///< limits of the exact values
  std::array<Rgb, 3> in_solution{};  ///< its mean and linear terms, which the solution has
};

HitLight::HitLight(const Solution& solution, const PlanePoints& points, const LampLight& lamps)
    : solution_(solution),
      scene_(*solution.scene),
      points_(points),
      lamps_(lamps),
      is_lamp_(scene_.patches().size(), 0),
      bases_(linear_bases(scene_)),
      direct_(scene_.patches().size()),
      slopes_(scene_.patches().size()) {
  for (const PatchId i : lamps.patches()) {
    at(is_lamp_, i) = 1;
  }
}

HitLight::~HitLight() {
  for (const auto& direct : direct_) {
    delete direct.load(std::memory_order_acquire);
  }
  for (const auto& slope : slopes_) {
    delete slope.load(std::memory_order_acquire);
  }
}

Rgb HitLight::exitance(PatchId patch) const {
  return at(is_lamp_, patch) != 0 ? scene_.exitance(patch) : Rgb();
}

Rgb HitLight::reflectance(PatchId patch) const {
  const Rgb& diffuse = scene_.reflectance(patch);
  return solution_.glossy ? diffuse + used_lobe(scene_.material(patch)).reflectance : diffuse;
}

std::unique_ptr<const HitLight::DirectLight> HitLight::fitted(PatchId patch) const {
  Eigen::Matrix<double, term_count, term_count> normal_matrix;
  Eigen::Matrix<double, term_count, 3> right;
  normal_matrix.setZero();
  right.setZero();
  Rgb low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high;
  const LinearBasis& basis = at(bases_, patch);
  double area = 0;
  std::array<Rgb, 3> moments{};
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    const auto corners = scene_.corners(scene_.pieces()[k]);
    const auto fit = [&](const Vec3& x, double weight) {
      const Rgb light = lamps_.at_point(patch, x);
      const auto [a, b] = basis.at(x);
      const Terms terms = terms_at(a, b);
      normal_matrix += weight * terms * terms.transpose();
      right += weight * terms * Eigen::RowVector3d(light.r, light.g, light.b);
      low = {std::min(low.r, light.r), std::min(low.g, light.g), std::min(low.b, light.b)};
      high = {std::max(high.r, light.r), std::max(high.g, light.g), std::max(high.b, light.b)};
      return light;
    };
    for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
      for_points_of_triangle(
          {scene_.point(corners[0]), scene_.point(corners[c]), scene_.point(corners[c + 1])},
          [&](const Vec3& x, double weight) {
            const Rgb light = fit(x, weight);
            const auto [a, b] = basis.at(x);
            area += weight;
            moments[0] += weight * light;
            moments[1] += weight * a * light;
            moments[2] += weight * b * light;
          });
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
      constexpr double part = 1.0 / 20;
      fit(at(points_.points(), points_.of_corner(k, c)).place, part * scene_.patch(patch).area);
    }
  }
  auto direct = std::make_unique<DirectLight>();
  normal_matrix.diagonal().array() += 1e-9 * area;
  const Eigen::Matrix<double, term_count, 3> solved = normal_matrix.ldlt().solve(right);
  for (int k = 0; k < term_count; ++k) {
    at(direct->coefficients, k) = {solved(k, 0), solved(k, 1), solved(k, 2)};
  }
  direct->low = low;
  direct->high = high;
  for (std::size_t k = 0; k < (solution_.linear_terms.empty() ? 1 : 3); ++k) {
    direct->in_solution[k] = 1 / area * moments[k];
  }
  return direct;
}

/// The value behind `place`, which `make` gives if it is unknown.
template <class Value, class Make>
const Value& HitLight::kept(std::atomic<const Value*>& place, Make make) const {
  if (const Value* const known = place.load(std::memory_order_acquire)) {
    return *known;
  }
  std::unique_ptr<const Value> made = make();
  const Value* expected = nullptr;
  if (place.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) {
    return *made.release();
  }
  return *expected;
}

const HitLight::DirectLight& HitLight::direct_on(PatchId patch) const {
  return kept(at(direct_, patch), [&] { return fitted(patch); });
}

const HitLight::Slope& HitLight::slope_on(PatchId patch) const {
  return kept(at(slopes_, patch),
              [&] { return std::make_unique<const Slope>(slope_by_neighbors(patch)); });
}

/// The mean irradiance of a patch by what is not a lamp.
Rgb HitLight::rest_on(PatchId patch) const {
  const Rgb light = at(solution_.radiosity, patch) - scene_.exitance(patch);
  const Rgb reflected = reflectance(patch), direct = direct_on(patch).in_solution[0];
  const auto rest = [](double b, double rho, double lamps) {
    return rho > 0 ? std::max(b / rho - lamps, 0.0) : 0;
  };
  return {rest(light.r, reflected.r, direct.r), rest(light.g, reflected.g, direct.g),
          rest(light.b, reflected.b, direct.b)};
}

/// By least squares from the patches of the same plane that touch it; limited to their difference
/// and to half of the patch's own light, so that a dark room stays dark beside a lit one.
HitLight::Slope HitLight::slope_by_neighbors(PatchId patch) const {
  const LinearBasis& basis = at(bases_, patch);
  const Rgb own = rest_on(patch);
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
  Rgb low = own, high = own;
  double size = 0;
  std::vector<PatchId> neighbors;
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    for (std::size_t c = 0; c < scene_.corners(scene_.pieces()[k]).size(); ++c) {
      const PlanePoint& point = at(points_.points(), points_.of_corner(k, c));
      neighbors.insert(neighbors.end(), point.patches.begin(), point.patches.end());
      const auto [a, b] = basis.at(point.place);
      size = std::max({size, std::abs(a), std::abs(b)});
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  for (const PatchId j : neighbors) {
    if (j == patch || max_abs(reflectance(j)) == 0) {
      continue;
    }
    const auto [a, b] = basis.at(scene_.patch(j).center);
    const Rgb other = rest_on(j), change = other - own;
    const Eigen::Vector2d apart(a, b);
    const double weight = 1 / apart.squaredNorm();
    matrix += weight * apart * apart.transpose();
    right += weight * apart * Eigen::RowVector3d(change.r, change.g, change.b);
    low = {std::min(low.r, other.r), std::min(low.g, other.g), std::min(low.b, other.b)};
    high = {std::max(high.r, other.r), std::max(high.g, other.g), std::max(high.b, other.b)};
  }
  if (!(matrix.determinant() > 1e-3 * matrix.trace() * matrix.trace()) || size == 0) {
    return {};
  }
  const Eigen::Matrix<double, 2, 3> slopes = matrix.inverse() * right;
  const auto limited_slope = [&](int channel, double value, double below, double above) {
    const double most = std::abs(slopes(0, channel)) * size + std::abs(slopes(1, channel)) * size;
    const double allowed = std::min(std::max(value - below, above - value), value / 2);
    const double factor = most > allowed ? allowed / most : 1;
    return std::pair(factor * slopes(0, channel), factor * slopes(1, channel));
  };
  const auto r = limited_slope(0, own.r, low.r, high.r), g = limited_slope(1, own.g, low.g, high.g),
             b = limited_slope(2, own.b, low.b, high.b);
  return {{r.first, g.first, b.first}, {r.second, g.second, b.second}};
}

Rgb HitLight::at_point(PatchId patch, const Vec3& x) const {
  const auto [a, b] = at(bases_, patch).at(x);
  Rgb light = at(solution_.radiosity, patch) - exitance(patch);
  const bool is_linear = !solution_.linear_terms.empty();
  if (is_linear) {
    const LinearTerm& term = at(solution_.linear_terms, patch);
    light += a * term.first + b * term.second;
  }
  const Rgb reflected = reflectance(patch);
  if (max_abs(reflected) > 0) {
    const DirectLight& direct = direct_on(patch);
    const auto& c = direct.coefficients;
    const Rgb value = c[0] + a * (c[1] + b * c[3] + a * c[4]) + b * (c[2] + b * c[5]);
    Rgb change = limited(value, direct.low, direct.high) - direct.in_solution[0] -
                 a * direct.in_solution[1] - b * direct.in_solution[2];
    if (!is_linear) {
      const Slope& slope = slope_on(patch);
      change += a * slope.first + b * slope.second;
    }
    light += reflected * change;
  }
  return {std::max(light.r, 0.0), std::max(light.g, 0.0), std::max(light.b, 0.0)};
}

}  // namespace transillum
