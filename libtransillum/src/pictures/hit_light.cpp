// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/hit_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "pictures/surface_rays.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Part of all power from which on sources that are gathered are found at points of patches.
constexpr double least_gathered = 0.01;
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

/// Calls visit(point, weight) for the centers of parts² triangles of equal size.
template <class Visit>
void for_parts_of_triangle(const std::array<Vec3, 3>& corners, int parts, Visit visit) {
  const Vec3 first = (corners[1] - corners[0]) / parts, second = (corners[2] - corners[0]) / parts;
  const double weight = 0.5 * norm(cross(first, second));
  for (int j = 0; j < parts; ++j) {
    for (int k = 0; j + k < parts; ++k) {
      visit(corners[0] + (j + 1.0 / 3) * first + (k + 1.0 / 3) * second, weight);
      if (j + k + 1 < parts) {
        visit(corners[0] + (j + 2.0 / 3) * first + (k + 2.0 / 3) * second, weight);
      }
    }
  }
}

/// Calls visit(corners) for triangles that a patch consists of.
template <class Visit>
void for_triangles(const PlanePoints& points, PatchId patch, Visit visit) {
  for (std::size_t k = points.first_piece(patch); k < points.end_piece(patch); ++k) {
    const Corners corners = points.outline(k);
    for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
      visit(std::array{corners[0], corners[c], corners[c + 1]});
    }
  }
}

/// A quadratic function of the basis by least squares, and the moments of its values.
struct Fit {
  Eigen::Matrix<double, term_count, term_count> matrix =
      Eigen::Matrix<double, term_count, term_count>::Zero();
  Eigen::Matrix<double, term_count, 3> right = Eigen::Matrix<double, term_count, 3>::Zero();
  Rgb low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high;     ///< limits of the values
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();  ///< integrals of products of 1 and the basis
  std::array<Rgb, 3> moments{};

  void add(const std::array<double, 2>& place, double weight, const Rgb& light) {
    const Terms terms = terms_at(place[0], place[1]);
    matrix += weight * terms * terms.transpose();
    right += weight * terms * Eigen::RowVector3d(light.r, light.g, light.b);
    low = {std::min(low.r, light.r), std::min(low.g, light.g), std::min(low.b, light.b)};
    high = {std::max(high.r, light.r), std::max(high.g, light.g), std::max(high.b, light.b)};
  }
  void add_moments(const std::array<double, 2>& place, double weight, const Rgb& light) {
    const Eigen::Vector3d terms(1, place[0], place[1]);
    gram += weight * terms * terms.transpose();
    for (std::size_t k = 0; k < 3; ++k) {
      moments[k] += weight * terms[static_cast<Eigen::Index>(k)] * light;
    }
  }
  std::array<Rgb, term_count> coefficients() const {
    auto regular = matrix;
    regular.diagonal().array() += 1e-9 * gram(0, 0);
    const Eigen::Matrix<double, term_count, 3> solved = regular.ldlt().solve(right);
    std::array<Rgb, term_count> found;
    for (int k = 0; k < term_count; ++k) {
      at(found, k) = {solved(k, 0), solved(k, 1), solved(k, 2)};
    }
    return found;
  }
};

/// The first `count` terms of a function of the basis on a part of a patch, from its moments there.
std::array<Rgb, 3> terms_of(const Eigen::Matrix3d& gram, const std::array<Rgb, 3>& moments,
                            int count) {
  Eigen::Matrix3d right;
  for (int k = 0; k < 3; ++k) {
    const Rgb& moment = at(moments, k);
    right.row(k) = Eigen::RowVector3d(moment.r, moment.g, moment.b);
  }
  const Eigen::MatrixXd solved =
      gram.topLeftCorner(count, count).ldlt().solve(right.topRows(count));
  std::array<Rgb, 3> terms{};
  for (int k = 0; k < count; ++k) {
    at(terms, k) = {solved(k, 0), solved(k, 1), solved(k, 2)};
  }
  return terms;
}

}  // namespace

/// The light on the open part of a patch: all of it, or what no solid covers that stands on it.
struct HitLight::PatchLight {
  /// Linear terms, and the values of a patch of which a part is covered.
  struct Detail {
    std::array<Rgb, 2> sources_in_solution{};  ///< linear terms of the sources
    std::array<Rgb, 3> solution{};             ///< B without the exitance of lamps: mean, terms
    std::array<double, 2> center{};            ///< middle in the basis
    Vec3 middle;                               ///< centroid, m
  };
  std::array<Rgb, term_count> sources;   ///< coefficients of a quadratic function
  Rgb low, high;                         ///< limits of its values
  Rgb sources_in_solution;               ///< its mean, which the solution has
  std::unique_ptr<const Detail> detail;  ///< null where functions are constant and all is open
};

HitLight::HitLight(const Solution& solution, const EmbreeScene& embree, const PlanePoints& points,
                   const LampLight& lamps)
    : solution_(solution),
      scene_(*solution.scene),
      embree_(embree),
      points_(points),
      lamps_(lamps),
      has_gathered_sources_(solution.sky.is_bright() || lamps.gathered_part() > least_gathered),
      is_lamp_(scene_.patches().size(), 0),
      bases_(linear_bases(scene_)),
      light_(scene_.patches().size()),
      slopes_(scene_.patches().size()) {
  for (const PatchId i : lamps.patches()) {
    at(is_lamp_, i) = 1;
  }
}

HitLight::~HitLight() = default;

Rgb HitLight::exitance(PatchId patch) const {
  return at(is_lamp_, patch) != 0 ? scene_.exitance(patch) : Rgb();
}

Rgb HitLight::mean_on(PatchId patch) const {
  return at(solution_.radiosity, patch) - exitance(patch);
}

bool HitLight::is_open(PatchId patch, const Vec3& x) const {
  return !is_covered(embree_, x, scene_.patch(patch).normal, !solution_.sky.is_set());
}

/// Irradiance by lamps, and by rays that meet other sources.
Rgb HitLight::sources_at(PatchId patch, const Vec3& x, const Cancellation& cancellation) const {
  const Rgb by_lamps = lamps_.at_point(patch, x, cancellation);
  if (!has_gathered_sources_) {
    return by_lamps;
  }
  static const std::vector<Vec3> table = cosine_directions(128, 0, 0)[0];
  const Vec3& normal = scene_.patch(patch).normal;
  const TangentFrame frame(normal);
  const Vec3 start = start_of_rays(embree_, x, normal);
  std::array<Vec3, ray_packet> directions;
  Rgb sum;
  for (std::size_t first = 0; first < table.size(); first += ray_packet) {
    std::transform(&table[first], &table[first] + ray_packet, directions.begin(),
                   [&](const Vec3& local) { return frame.turned(local); });
    const std::array<Met, ray_packet> met = met_by(embree_, start, directions);
    for (std::size_t k = 0; k < ray_packet; ++k) {
      if (met[k].is_lit) {
        sum += scene_.exitance(met[k].patch) - exitance(met[k].patch);
      } else if (met[k].patch == no_patch && solution_.sky.is_set()) {
        sum += solution_.sky.relative_radiance(directions[k]) * solution_.sky.exitance;
      }
    }
  }
  return by_lamps + 1 / static_cast<double>(table.size()) * sum;
}

bool HitLight::is_partly_open(PatchId patch) const {
  constexpr int parts = 4;
  bool any_open = false, any_covered = false;
  for_triangles(points_, patch, [&](const std::array<Vec3, 3>& triangle) {
    for_parts_of_triangle(triangle, parts, [&](const Vec3& x, double) {
      (is_open(patch, x) ? any_open : any_covered) = true;
    });
  });
  return any_open && any_covered;
}

/// The solution has the mean of a whole patch. If a part is covered, it is dark, and no ray meets
/// it: the rest has all light.
std::unique_ptr<const HitLight::PatchLight> HitLight::light_of(
    PatchId patch, const Cancellation& cancellation) const {
  const bool is_partial = is_partly_open(patch);
  const LinearBasis& basis = at(bases_, patch);
  Fit fit;
  Vec3 middle;
  const auto add = [&](const Vec3& x, double weight) {
    if (!is_partial || is_open(patch, x)) {
      const Rgb light = sources_at(patch, x, cancellation);
      fit.add(basis.at(x), weight, light);
      fit.add_moments(basis.at(x), weight, light);
      middle = middle + weight * x;
    }
  };
  for_triangles(points_, patch, [&](const std::array<Vec3, 3>& triangle) {
    constexpr int parts = 12;
    is_partial ? for_parts_of_triangle(triangle, parts, add)
               : for_points_of_triangle(triangle, add);
  });
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    for (std::size_t c = 0; c < scene_.corners(scene_.pieces()[k]).size(); ++c) {
      constexpr double part = 1.0 / 20;
      const Vec3& x = at(points_.points(), points_.of_corner(k, c)).place;
      if (!is_partial || is_open(patch, x)) {
        fit.add(basis.at(x), part * scene_.patch(patch).area, sources_at(patch, x, cancellation));
      }
    }
  }
  auto light = std::make_unique<PatchLight>();
  light->sources = fit.coefficients();
  light->low = fit.low;
  light->high = fit.high;
  const double whole = fit.gram(0, 0);
  light->sources_in_solution = 1 / whole * fit.moments[0];
  const bool is_linear = !solution_.linear_terms.empty();
  if (!is_linear && !is_partial) {
    return light;
  }
  PatchLight::Detail detail;
  detail.middle = basis.center;
  detail.solution[0] = mean_on(patch);
  if (is_linear) {
    const LinearTerm& terms = at(solution_.linear_terms, patch);
    detail.solution = {detail.solution[0], terms.first, terms.second};
    detail.sources_in_solution = {1 / whole * fit.moments[1], 1 / whole * fit.moments[2]};
  }
  if (is_partial) {
    // A small or narrow part does not determine linear terms.
    constexpr double least_determinant = 1e-3;
    const double area = scene_.patch(patch).area;
    const int count = is_linear && (fit.gram / area).determinant() > least_determinant ? 3 : 1;
    const std::array<Rgb, 3> known = terms_of(fit.gram, fit.moments, count);
    light->sources_in_solution = known[0];
    detail.sources_in_solution = {known[1], known[2]};
    // Lamps that are gathered emit from all of the part.
    const Rgb emitted = scene_.exitance(patch) - exitance(patch);
    detail.solution[0] = detail.solution[0] - emitted;
    detail.solution = terms_of(fit.gram / area, detail.solution, count);
    detail.solution[0] += emitted;
    detail.middle = 1 / whole * middle;
    detail.center = {fit.gram(0, 1) / whole, fit.gram(0, 2) / whole};
  }
  light->detail = std::make_unique<const PatchLight::Detail>(detail);
  return light;
}

const HitLight::PatchLight& HitLight::light_on(PatchId patch,
                                               const Cancellation& cancellation) const {
  return at(light_, patch).get([&] { return light_of(patch, cancellation); });
}

/// The mean irradiance of a patch by what reflects.
Rgb HitLight::rest_on(PatchId patch, const Cancellation& cancellation) const {
  const PatchLight& light = light_on(patch, cancellation);
  const Rgb mean = light.detail ? light.detail->solution[0] : mean_on(patch);
  const Rgb sent = mean + exitance(patch) - scene_.exitance(patch);
  const Rgb reflected = reflectance_of(solution_, patch), direct = light.sources_in_solution;
  const auto rest = [](double b, double rho, double sources) {
    return rho > 0 ? std::max(b / rho - sources, 0.0) : 0;
  };
  return {rest(sent.r, reflected.r, direct.r), rest(sent.g, reflected.g, direct.g),
          rest(sent.b, reflected.b, direct.b)};
}

/// By least squares from the patches of the same plane that touch it; limited to their difference
/// and to half of the patch's own light, so that a dark room stays dark beside a lit one.
HitLight::Slope HitLight::slope_by_neighbors(PatchId patch,
                                             const Cancellation& cancellation) const {
  const LinearBasis& basis = at(bases_, patch);
  const Rgb own = rest_on(patch, cancellation);
  const auto& detail = light_on(patch, cancellation).detail;
  const std::array<double, 2> center = detail ? detail->center : std::array<double, 2>();
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
  Rgb low = own, high = own;
  double size = 0;
  std::vector<PatchId> neighbors;
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    for (std::size_t c = 0; c < scene_.corners(scene_.pieces()[k]).size(); ++c) {
      const std::int32_t n = points_.of_corner(k, c);
      const auto meeting = points_.patches_at(n);
      neighbors.insert(neighbors.end(), meeting.begin(), meeting.end());
      const auto [a, b] = basis.at(at(points_.points(), n).place);
      size = std::max({size, std::abs(a), std::abs(b)});
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  for (const PatchId j : neighbors) {
    if (j == patch || max_abs(reflectance_of(solution_, j)) == 0) {
      continue;
    }
    const auto& other_detail = light_on(j, cancellation).detail;
    const auto [a, b] = basis.at(other_detail ? other_detail->middle : at(bases_, j).center);
    const Rgb other = rest_on(j, cancellation), change = other - own;
    const Eigen::Vector2d apart(a - center[0], b - center[1]);
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

Rgb HitLight::at_point(PatchId patch, const Vec3& x, const Cancellation& cancellation) const {
  const Rgb reflected = reflectance_of(solution_, patch);
  if (max_abs(reflected) == 0) {
    return scene_.exitance(patch) - exitance(patch);
  }
  const auto [a, b] = at(bases_, patch).at(x);
  const PatchLight& on_patch = light_on(patch, cancellation);
  const auto& c = on_patch.sources;
  const Rgb value = c[0] + a * (c[1] + b * c[3] + a * c[4]) + b * (c[2] + b * c[5]);
  Rgb change = limited(value, on_patch.low, on_patch.high) - on_patch.sources_in_solution;
  Rgb light = mean_on(patch);
  std::array<double, 2> center{};
  if (on_patch.detail) {
    const auto& [known, s, own_center, middle] = *on_patch.detail;
    change = change - a * known[0] - b * known[1];
    light = s[0] + a * s[1] + b * s[2];
    center = own_center;
  }
  if (solution_.linear_terms.empty()) {
    const auto& [first, second] = at(slopes_, patch).get([&] {
      return std::make_unique<const Slope>(slope_by_neighbors(patch, cancellation));
    });
    change += (a - center[0]) * first + (b - center[1]) * second;
  }
  light += reflected * change;
  return {std::max(light.r, 0.0), std::max(light.g, 0.0), std::max(light.b, 0.0)};
}

}  // namespace transillum
