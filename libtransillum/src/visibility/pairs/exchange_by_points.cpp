// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// ExchangeFinder: exchanges of two polygons by points of one of them, each of which sees a part of
// the other past blockers; moments also where nothing blocks.
#include <algorithm>
#include <array>
#include <cmath>

#include "transillum/at.h"
#include "visibility/pairs/adaptive_points.h"
#include "visibility/pairs/patch_exchange.h"
#include "visibility/pairs/point_view.h"
#include "visibility/pairs/refined_cells.h"
#include "visibility/pairs/sampled_polygon.h"

namespace transillum {
namespace {

/// Calls visit(point, weight) for the points of a quadrature over a polygon, whose weights sum to
/// its area: the three-point rule on each of `divisions`² congruent parts of each triangle of its
/// fan about the first corner; the triangle's center if `divisions` is 0.
template <class Visit>
void for_points_of(Outline polygon, int divisions, Visit&& visit) {
  constexpr double sixth = 1.0 / 6;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
    const double twice_area = norm(cross(a, b));
    if (divisions == 0) {
      visit(polygon[0] + (a + b) / 3, twice_area / 2);
      continue;
    }
    const double weight = twice_area * sixth / (divisions * divisions);
    const auto visit_triangle = [&](double u, double v, double size) {
      for (const auto& [s, t] : {std::pair{1.0, 1.0}, {4.0, 1.0}, {1.0, 4.0}}) {
        visit(polygon[0] + (u + size * s * sixth) * a + (v + size * t * sixth) * b, weight);
      }
    };
    const double size = 1.0 / divisions;
    for (int i = 0; i < divisions; ++i) {
      for (int j = 0; i + j < divisions; ++j) {
        visit_triangle(i * size, j * size, size);
        if (i + j + 1 < divisions) {
          visit_triangle((i + 1) * size, (j + 1) * size, -size);
        }
      }
    }
  }
}
/// Adds the moments of an exchange of `area`: the points say where on the receiver it is.
/// @param half with half the points in a row
void add_moments_of(double area, const PointSums& sums, const PointSums& half,
                    PatchExchange& exchange) {
  for (std::size_t a = 0; a < 2; ++a) {
    const auto moment_of = [&](const PointSums& found) {
      return found.seen > 0 ? area * found.moments[a] / found.seen : 0.0;
    };
    const double moment = moment_of(sums);
    exchange.moments[a] += moment;
    exchange.moment_errors[a] += (moment - moment_of(half)) / 3;
  }
}

void add_moments_of(const RefinedCells::Exchange& found, PatchExchange& exchange) {
  for (std::size_t a = 0; a < 2; ++a) {
    exchange.moments[a] += found.moments[a];
    exchange.moment_errors[a] += found.moment_errors[a];
  }
}

/// The part of what points would see without blockers.
double part_seen(const PointSums& sums) { return sums.free > 0 ? sums.seen / sums.free : 0; }

/// The exchange of a cell past blockers, m²; at most `exact`, its exchange without them. Blockers
/// may hide next to nothing, as the other half of a bent quad does. The sum over points is then off
/// by the error of the quadrature without blockers, and `exact` replaces it.
double seen_part(const PointSums& sums, double exact) {
  constexpr double nearly_all = 0.999;
  const double part = part_seen(sums);
  return part > nearly_all ? std::min(part, 1.0) * exact : std::min(sums.seen, exact);
}

/// The error of the larger absolute value.
double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

/// Whether points see so little, or nearly everything, that they may have missed a strip along an
/// edge of their cell, from which alone the other polygon is seen, or hidden.
bool may_miss_strip(const PointSums& sums) {
  constexpr double next_to_nothing = 0.01;
  return sums.seen <= next_to_nothing * sums.free ||
         sums.free - sums.seen <= next_to_nothing * sums.free;
}

}  // namespace

/// Calls visit(cell, size) for the parts of the sampled polygon within which what it sees of the
/// other has no kinks; size as SampledPolygon::size.
template <class Visit>
void ExchangeFinder::for_each_cell(const SampledPolygon& sampled,
                                   const std::vector<Corners>& blockers, Visit visit) const {
  const double whole = norm(area_vector(sampled.polygon));
  for (const Corners& cell : smooth_cells(sampled.polygon, sampled.other, blockers, tolerance_)) {
    visit(cell, sampled.size * std::sqrt(norm(area_vector(cell)) / whole));
  }
}

std::vector<Corners> ExchangeFinder::polygons_of(const Numbers& blockers) const {
  std::vector<Corners> polygons;
  for (const std::int32_t number : blockers) {
    polygons.push_back(at(blockers_, number).outline);
  }
  return polygons;
}

/// Sums over points of the sampled polygon: what they see of the other, and where on the receiver.
class ExchangeFinder::PointQuadrature {
 public:
  /// @param polygons blockers
  PointQuadrature(const SampledPolygon& sampled, const std::vector<Corners>& polygons,
                  const Query& query, double scale)
      : sampled_(sampled),
        query_(query),
        scale_(scale),
        is_free_(polygons.empty()),
        view_(sampled.other, polygons),
        free_view_(sampled.other, {}) {}

  PointSums operator()(Outline cell, int divisions) {
    PointSums sums;
    for_points_of(cell, divisions, [&](const Vec3& x, double weight) {
      const double seen = weight * see(x, weight, sums.moments);
      sums.seen += seen;
      sums.free += is_free_ ? seen : weight * free_view_.form_factor(x, sampled_.normal);
    });
    return sums;
  }

  /// Sums over points near the corners of a cell.
  PointSums near_corners(Outline cell) {
    constexpr double off_edges = 1.0 / 64;  // corners often lie on blockers
    const Vec3 middle = middle_of(cell);
    const double weight = norm(area_vector(cell)) / static_cast<double>(cell.size());
    PointSums sums;
    for (const Vec3& corner : cell) {
      const Vec3 x = corner + off_edges * (middle - corner);
      sums.seen += weight * view_.form_factor(x, sampled_.normal, query_.tick);
      sums.free += weight * free_view_.form_factor(x, sampled_.normal);
    }
    return sums;
  }

  /// A second estimate of the error of a cell's exchange, as two sums may agree by chance: from the
  /// parts seen with half of the divisions and with a quarter of them; with one division, from the
  /// center and the corners.
  /// @param half by half of the divisions
  /// @param exact without blockers
  double error_of_fewer(Outline cell, int divisions, const PointSums& half, double exact) {
    const PointSums least = divisions > 1 ? (*this)(cell, divisions / 4) : near_corners(cell);
    // Half the distance between points leaves a quarter of the error.
    return exact * (part_seen(half) - part_seen(least)) / 12;
  }

  /// By how much a cell may exchange more than its points say, or less if negative, where these may
  /// have missed a strip: what corners see may reach to the next points.
  /// @param exact without blockers
  double missed_strip(Outline cell, int divisions, const PointSums& sums, double exact) {
    const PointSums near = near_corners(cell);
    return exact * (part_seen(near) - part_seen(sums)) / (3 * std::max(divisions, 1));
  }

 private:
  /// The form factor from x. Adds its moments times `weight`.
  double see(const Vec3& x, double weight, std::array<double, 2>& moments) {
    if (query_.receiver == nullptr) {
      return view_.form_factor(x, sampled_.normal, query_.tick);
    }
    const LinearBasis& basis = *query_.receiver;
    if (sampled_.p_is_sampled) {
      const double one = view_.form_factor(x, sampled_.normal, query_.tick);
      const std::array<double, 2> at_x = basis.at(x / scale_);
      for (std::size_t a = 0; a < 2; ++a) {
        moments[a] += weight * at_x[a] * one;
      }
      return one;
    }
    const PointView::Moments seen = view_.moments(x, sampled_.normal, query_.tick);
    const std::array<double, 2> at_foot = basis.at(seen.foot / scale_);
    for (std::size_t a = 0; a < 2; ++a) {
      moments[a] += weight * (at_foot[a] * seen.one + dot(basis.gradient[a], seen.first) / scale_);
    }
    return seen.one;
  }

  const SampledPolygon& sampled_;
  const Query& query_;
  double scale_;  ///< from meters
  bool is_free_;  ///< no blockers
  PointView view_, free_view_;
};

/// Adds the exchange of two polygons past blockers, by points of one of them.
void ExchangeFinder::add_partial(const FacingPolygons& facing, const Numbers& blockers,
                                 const Query& query, PatchExchange& exchange) const {
  const std::vector<Corners> polygons = polygons_of(blockers);
  const SampledPolygon sampled(facing, tolerance_, polygons);
  PointQuadrature by_points(sampled, polygons, query, scale_);
  RefinedCells refined(facing, sampled.p_is_sampled, std::ref(by_points));
  const double smaller = std::min(norm(area_vector(facing.p)), norm(area_vector(facing.q)));
  for_each_cell(sampled, polygons, [&](const Corners& cell, double cell_size) {
    const int divisions = divisions_of(cell_size);
    const PointSums sums = by_points(cell, divisions);
    const double exact = refined.exact(cell);
    if (!query.estimate) {
      exchange.area += seen_by_enough(by_points, refined, cell, divisions, sums, exact, smaller);
      return;
    }
    if (refined.misses(sums.free, exact)) {
      const RefinedCells::Exchange found = refined(cell);
      exchange.area += found.area;
      exchange.error += found.error;
      add_moments_of(found, exchange);
      return;
    }
    const double area = seen_part(sums, exact);
    exchange.area += area;
    const double strip =
        may_miss_strip(sums) ? by_points.missed_strip(cell, divisions, sums, exact) : 0;
    if (sums.seen == 0) {
      exchange.error += strip;
      return;
    }
    PointSums half;
    double error = cell_size * cell_size * sums.seen;
    if (divisions > 0) {
      half = by_points(cell, divisions / 2);
      // Half the distance between points takes three quarters of the error away.
      error = larger((sums.seen - half.seen) / 3,
                     by_points.error_of_fewer(cell, divisions, half, exact));
    }
    exchange.error += larger(error, strip);
    if (query.receiver != nullptr) {
      if (divisions < moment_divisions_) {
        add_moments_of(area, by_points(cell, moment_divisions_),
                       by_points(cell, moment_divisions_ / 2), exchange);
      } else {
        add_moments_of(area, sums, half, exchange);
      }
    }
  });
}

/// The exchange of a cell past blockers, by more points where fewer do not suffice.
/// @param sums by `divisions`
/// @param exact without blockers
/// @param smaller area of the smaller of both polygons, whose form factor is the larger
double ExchangeFinder::seen_by_enough(PointQuadrature& by_points, RefinedCells& refined,
                                      const Corners& cell, int divisions, const PointSums& sums,
                                      double exact, double smaller) const {
  // Estimated errors, with the usual density of 32: 0.2 % of what is seen, or a form factor of
  // 2e-6.
  constexpr double tolerated_part = 2, tolerated_factor = 2e-3;
  const double scale = 1 / (density_ * density_), least = scale * tolerated_factor * smaller;
  const auto tolerated = [&](double seen) {
    return std::max(scale * tolerated_part * seen, least);
  };
  const double seen = seen_part(sums, exact);
  if (exact <= least) {
    return seen;
  }
  const bool strip_matters =
      may_miss_strip(sums) &&
      std::abs(by_points.missed_strip(cell, divisions, sums, exact)) > 3 * tolerated(seen);
  if (!strip_matters && divisions == 0 && sums.seen == 0) {
    return seen;
  }
  if (!strip_matters && divisions > 0) {
    const PointSums half = by_points(cell, divisions / 2);
    const double error = larger((seen - seen_part(half, exact)) / 3,
                                by_points.error_of_fewer(cell, divisions, half, exact));
    const double missed = sums.free > 0 ? std::abs(exact / sums.free - 1) * seen : 0;
    if (std::abs(error) + missed <= tolerated(seen)) {
      return seen;
    }
  }
  AdaptivePoints adaptive(
      [&](Outline triangle) {
        const PointSums inside = by_points(triangle, 1), near = by_points.near_corners(triangle);
        const double free = refined.exact(triangle);
        const auto seen_of = [&](const PointSums& found) {
          return found.free > 0 ? std::min(1.0, found.seen / found.free) * free : 0;
        };
        return AdaptivePoints::Seen{seen_of(inside), seen_of(near)};
      },
      tolerated);
  return std::min(adaptive(cell, divisions), exact);
}

/// Adds the exchange of two polygons with nothing between: in closed form, but for its moments.
void ExchangeFinder::add_whole(const FacingPolygons& facing, const Query& query,
                               PatchExchange& exchange) const {
  bool integrated = false;
  const double area = polygon_exchange(facing, &integrated);
  exchange.area += area;
  exchange.integrated = exchange.integrated || integrated;
  if (query.receiver == nullptr) {
    return;
  }
  // The values at points have no kinks: half as many in a row are enough.
  const SampledPolygon sampled(facing, tolerance_);
  PointQuadrature by_points(sampled, {}, query, scale_);
  const int divisions = std::max(divisions_of(sampled.size / 2), moment_divisions_);
  const PointSums sums = by_points(sampled.polygon, divisions);
  RefinedCells refined(facing, sampled.p_is_sampled, std::ref(by_points), area);
  if (refined.misses(sums.free, area)) {
    add_moments_of(refined(sampled.polygon), exchange);
    return;
  }
  add_moments_of(area, sums, by_points(sampled.polygon, divisions / 2), exchange);
}

/// Adds the moments of two polygons past blockers, by points of one of them.
void ExchangeFinder::add_moments(const FacingPolygons& facing, const Numbers& blockers,
                                 const LinearBasis& of_p, const LinearBasis& of_q,
                                 const std::function<void()>& tick, TransferMoments& sum) const {
  const std::vector<Corners> polygons = polygons_of(blockers);
  const SampledPolygon sampled(facing, tolerance_, polygons);
  const LinearBasis& own = sampled.p_is_sampled ? of_p : of_q;
  const LinearBasis& other = sampled.p_is_sampled ? of_q : of_p;
  PointView view(sampled.other, polygons);
  for_each_cell(sampled, polygons, [&](const Corners& cell, double cell_size) {
    // The rule of three points is exact for products of two linear functions, the rule of one point
    // is not. Without blockers, the values at the points have no kinks: half as many points in a
    // row are enough.
    const int divisions = divisions_of(blockers.empty() ? cell_size / 2 : cell_size);
    for_points_of(cell, std::max(1, divisions), [&](const Vec3& x, double weight) {
      const PointView::Moments seen = view.moments(x, sampled.normal, tick);
      const auto own_at = own.at(x / scale_), other_at = other.at(seen.foot / scale_);
      const std::array<double, 3> a{1, own_at[0], own_at[1]};
      const Vec3 first = seen.first / scale_;
      const std::array<double, 3> b{seen.one,
                                    other_at[0] * seen.one + dot(other.gradient[0], first),
                                    other_at[1] * seen.one + dot(other.gradient[1], first)};
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t l = 0; l < 3; ++l) {
          (sampled.p_is_sampled ? sum.of(k, l) : sum.of(l, k)) += weight * a[k] * b[l];
        }
      }
    });
  });
}

/// Into how many parts to divide the sides of the triangles of a cell; 0: a point suffices.
int ExchangeFinder::divisions_of(double size) const {
  constexpr double min_divisions = 0.2;
  const double ideal = density_ * size;
  return ideal < min_divisions
             ? 0
             : static_cast<int>(std::clamp(std::ceil(ideal), 1.0, 2 * std::max(density_, 1.0)));
}

}  // namespace transillum
