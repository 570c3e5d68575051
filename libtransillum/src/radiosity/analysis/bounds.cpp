// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The error bounds and tables of the paper (sections 5 and 6), evaluated for proven and for
// measured discrepancies. Input: numbers of directions, direction sets, or a Scene.
#include "transillum/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "sampling/discrepancy.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;

void check_rho(double rho) {
  if (!(rho >= 0 && rho < 1)) {
    throw InputError(fmt::format("reflectance: {} is not at least 0 and less than 1", rho));
  }
}

void check_positive(const char* name, double value) {
  if (!(value > 0 && std::isfinite(value))) {
    throw InputError(fmt::format("{}: {} is not a finite number greater than 0", name, value));
  }
}

/// The smallest M >= 1 with enough(M), by bisection: monotone, since (log2 M + 7)/M falls.
double smallest(const std::function<bool(double)>& enough) {
  double high = 1;
  while (!enough(high)) {
    high *= 2;
  }
  double low = high / 2;  // not enough, or below 1
  // Beyond 2^53 neighbors are farther apart than 1.
  while (high - low > std::max(1.0, high * 0x1p-52)) {
    const double middle = std::floor((low + high) / 2);
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

/// The smallest number of directions that is enough, up to 256 by trying all; beyond, one that is
/// enough while the next smaller one is not.
std::optional<int> smallest_set(const std::function<bool(int)>& enough) {
  constexpr int all_tried = 256, max_directions = 1 << 16;
  for (int m = 1; m <= all_tried; ++m) {
    if (enough(m)) {
      return m;
    }
  }
  int low = all_tried, high = all_tried;
  do {
    low = high;
    high *= 2;
    if (high > max_directions) {
      return std::nullopt;
    }
  } while (!enough(high));
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

double star_discrepancy_bound(double directions) {
  return (std::log2(directions) + 7) / (2 * directions);
}

double quadrature_error_bound(double directions) {
  // Eq. 2 with the variation 4 pi of eq. 19.
  return 4 * pi * star_discrepancy_bound(directions);
}

double contraction_bound(double rho, double eps) { return rho * (1 + eps / pi); }

std::optional<double> iterations_to(double tolerance, double contraction) {
  check_positive("tolerance", tolerance);
  if (!(contraction < 1)) {
    return std::nullopt;
  }
  if (tolerance >= 1) {
    return 0;
  }
  if (contraction <= 0) {
    return 1;
  }
  return std::ceil(std::log(tolerance) / std::log(contraction));
}

double homogeneous_error_bound(double rho, double eps) { return rho / (1 - rho) * eps / pi; }

double heterogeneous_error_bound(double rho, double size_ratio, double star_discrepancy) {
  return 16 * pi * rho / (1 - rho) * size_ratio * star_discrepancy;
}

double directions_to_contract(double rho) {
  check_rho(rho);
  return smallest(
      [rho](double m) { return contraction_bound(rho, quadrature_error_bound(m)) < 1; });
}

double directions_if_homogeneous(double rho, double accuracy) {
  check_rho(rho);
  check_positive("accuracy", accuracy);
  return smallest([rho, accuracy](double m) {
    return homogeneous_error_bound(rho, quadrature_error_bound(m)) <= accuracy;
  });
}

double directions_if_heterogeneous(double rho, double accuracy, double size_ratio) {
  check_rho(rho);
  check_positive("accuracy", accuracy);
  check_positive("size ratio", size_ratio);
  return smallest([=](double m) {
    return heterogeneous_error_bound(rho, size_ratio, star_discrepancy_bound(m)) <= accuracy;
  });
}

const PaperTables& paper_tables() {
  static const PaperTables tables{{0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
                                  {5, 9, 15, 24, 37, 61, 111, 272},
                                  {900, 1600, 2500, 3800, 5700, 9000, 15200, 34000},
                                  {3e6, 5e6, 8e6, 12e6, 18e6, 29e6, 52e6, 120e6}};
  return tables;
}

std::vector<DirectionSample> DirectionSetFamily::make(int directions) const {
  auto samples = make_directions(sampling, directions, seed);
  return rotation ? rotated(std::move(samples), *rotation) : samples;
}

double measured_quadrature_error(const DirectionSetFamily& sets, int directions,
                                 const Cancellation& cancellation) {
  static const std::vector<Vec3> normals = spread_normals(512);
  return summary_of(quadrature_errors(normals, sets.make(directions), sets.two_way, cancellation))
      .max;
}

std::optional<int> actual_directions_to_contract(const DirectionSetFamily& sets, double rho,
                                                 const Cancellation& cancellation) {
  check_rho(rho);
  return smallest_set([&](int m) {
    return contraction_bound(rho, measured_quadrature_error(sets, m, cancellation)) < 1;
  });
}

std::optional<int> actual_directions_if_homogeneous(const DirectionSetFamily& sets, double rho,
                                                    double accuracy,
                                                    const Cancellation& cancellation) {
  check_rho(rho);
  check_positive("accuracy", accuracy);
  return smallest_set([&](int m) {
    return homogeneous_error_bound(rho, measured_quadrature_error(sets, m, cancellation)) <=
           accuracy;
  });
}

std::optional<double> estimated_directions_if_heterogeneous(const DirectionSetFamily& sets,
                                                            double rho, double accuracy,
                                                            double size_ratio,
                                                            const Cancellation& cancellation) {
  check_rho(rho);
  check_positive("accuracy", accuracy);
  check_positive("size ratio", size_ratio);
  if (sets.sampling == Sampling::antipodal) {
    return std::nullopt;
  }
  if (rho == 0) {
    return 1;
  }
  constexpr int few = 1024, many = 16 * few;
  const double of_few = star_discrepancy(sets.make(few), cancellation);
  const double of_many = star_discrepancy(sets.make(many), cancellation);
  const double power = std::log(of_few / of_many) / std::log(many / few);
  const double error = heterogeneous_error_bound(rho, size_ratio, of_few);
  return std::max(1.0, std::ceil(few * std::pow(error / accuracy, 1 / power)));
}

SceneMeasures measure(const Scene& scene, const Cancellation& cancellation) {
  SceneMeasures measures;
  measures.smallest_area = HUGE_VAL;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    measures.rho_max = std::max(measures.rho_max, max_abs(scene.reflectance(i)));
    if (scene.patch(i).area >= measures.smallest_area) {
      continue;
    }
    measures.smallest_area = scene.patch(i).area;
    measures.smallest = i;
  }
  // Any direction is within 0.08 rad of one of these axes (tested), so the extent along the nearest
  // axis is at least cos 0.08 times the distance of the two farthest points.
  for (const auto& axis : make_directions(Sampling::fibonacci, 1024, 0)) {
    cancellation.throw_if_canceled();
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3& p : scene.points()) {
      const double height = dot(p, axis.direction);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    measures.extent = std::max(measures.extent, (high - low) / std::cos(0.08));
  }
  measures.size_ratio = measures.extent * measures.extent / measures.smallest_area;
  return measures;
}

double estimated_passes(Sampling sampling, double passes, double error, double accuracy) {
  check_positive("passes", passes);
  check_positive("error", error);
  check_positive("accuracy", accuracy);
  const double slope = sampling == Sampling::random ? 0.5 : 0.75;
  return std::max(1.0, std::ceil(passes * std::pow(error / accuracy, 1 / slope)));
}

double estimated_passes_by_replicas(Sampling sampling, double passes, double replicas, double error,
                                    double accuracy) {
  check_positive("replicas", replicas);
  // The error of one of R independent sets of M/R passes is sqrt(R) times the error of their mean.
  return estimated_passes(sampling, passes / replicas, error * std::sqrt(replicas), accuracy);
}

}  // namespace transillum
