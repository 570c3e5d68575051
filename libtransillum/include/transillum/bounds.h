// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/directions.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// @name Bounds proven in the paper
/// M is the number of directions; rho the largest reflectance, 0 <= rho < 1; eps the quadrature
/// error of the cosine, eq. 17 (the integral is pi).
/// @{

/// Upper bound of D* of M >= 1 Hammersley points (eq. 20; logarithm to base 2).
double star_discrepancy_bound(double directions);
/// Upper bound of eps of M >= 1 Hammersley points (eq. 21).
double quadrature_error_bound(double directions);
/// Upper bound of the factor by which an iteration reduces changes: rho (1 + eps/pi) (eq. 22).
double contraction_bound(double rho, double eps);
/// Number of iterations, starting with 0, to reach a relative error of `tolerance` in the maximum
/// norm (eq. 25). Nothing unless the contraction is below 1.
std::optional<double> iterations_to(double tolerance, double contraction);
/// Upper bound of ||B* - B|| / ||B|| in the maximum norm in a nearly homogeneous environment
/// (eq. 37).
double homogeneous_error_bound(double rho, double eps);
/// The same in any environment (eq. 43).
/// @param rho largest reflectance.
/// @param size_ratio max_i R²/A_i of scene extent and patch areas.
/// @param star_discrepancy D* of the directions.
double heterogeneous_error_bound(double rho, double size_ratio, double star_discrepancy);
/// @}

/// @name Sufficient numbers of directions
/// The smallest M for which these bounds hold with eq. 20 and 21: a whole number, as double because
/// it may exceed every integer type. @throws InputError unless 0 <= rho < 1, accuracy > 0 and
/// size_ratio > 0, all finite.
/// @{

/// For the iteration to contract (eq. 24): Table 1.
double directions_to_contract(double rho);
/// For an error of at most `accuracy` in a nearly homogeneous environment: Table 2.
double directions_if_homogeneous(double rho, double accuracy);
/// For an error of at most `accuracy` in any environment: Table 3.
double directions_if_heterogeneous(double rho, double accuracy, double size_ratio);
/// @}

/// The paper's Tables 1 to 3 as printed, for rho = 0.2 … 0.9.
struct PaperTables {
  static constexpr int rows = 8;              ///< number of values of rho
  static constexpr double accuracy = 0.01;    ///< relative error in Tables 2 and 3
  static constexpr double size_ratio = 150;   ///< size ratio in Table 3
  std::array<double, rows> rho;               ///< largest reflectance
  std::array<double, rows> to_contract;       ///< M of Table 1
  std::array<double, rows> if_homogeneous;    ///< M of Table 2
  std::array<double, rows> if_heterogeneous;  ///< M of Table 3
};
/// The paper's tables.
const PaperTables& paper_tables();

/// A family of direction sets, one for each M, whose errors are measured instead of bounded.
struct DirectionSetFamily {
  Sampling sampling = Sampling::antipodal;     ///< the sequence
  std::uint64_t seed = 1;                      ///< seed of the sequence, if it uses one
  std::optional<std::uint64_t> rotation = {};  ///< seed of a rotation of all directions, if any
  bool two_way = true;                         ///< count the opposites too

  /// The set of M = `directions` directions.
  std::vector<DirectionSample> make(int directions) const;
};
/// eps of a set: the largest magnitude of eq. 17 over 518 normals spread over the sphere.
/// @throws Canceled
double measured_quadrature_error(const DirectionSetFamily& sets, int directions,
                                 const Cancellation& cancellation = {});
/// The smallest M up to 65,536 for which eq. 24 holds with the measured eps; nothing if there is
/// none. Above 256 it is found by doubling and bisection, so that eq. 24 may also hold for some
/// smaller M.
/// @throws Canceled
std::optional<int> actual_directions_to_contract(const DirectionSetFamily& sets, double rho,
                                                 const Cancellation& cancellation = {});
/// The same for the bound of eq. 37.
/// @throws Canceled
std::optional<int> actual_directions_if_homogeneous(const DirectionSetFamily& sets, double rho,
                                                    double accuracy,
                                                    const Cancellation& cancellation = {});

/// Estimate of the M that the bound of eq. 43 requires with D* of these sets, measured for 1,024
/// and 16,384 directions and extrapolated as a power of M.
/// Nothing for antipodal sets, which are evenly spread on the sphere, not on the unit square of D*.
/// @throws Canceled
std::optional<double> estimated_directions_if_heterogeneous(const DirectionSetFamily& sets,
                                                            double rho, double accuracy,
                                                            double size_ratio,
                                                            const Cancellation& cancellation = {});

/// The properties of a scene that the bounds depend on.
struct SceneMeasures {
  double rho_max = 0;           ///< largest reflectance over patches and channels
  double extent = 0;            ///< R, m: upper bound of all distances, at most 0.4 % too large
  double smallest_area = 0;     ///< area of the smallest patch, m²
  PatchId smallest = no_patch;  ///< the patch with that area
  double size_ratio = 0;        ///< max_i R²/A_i
};
/// Measures a scene.
/// @throws Canceled
SceneMeasures measure(const Scene& scene, const Cancellation& cancellation = {});

/// Estimate of the number of passes for an error of `accuracy`, from a solve run with `passes`
/// passes of the same sampling and an error of `error`, both in the same norm. The error is assumed
/// to decrease as M^-1/2 for random sampling and as M^-3/4 otherwise, the worst case for integrands
/// with kinks.
double estimated_passes(Sampling sampling, double passes, double error, double accuracy);
/// The same from the error estimate of `passes` passes in `replicas` replicas. The result is the
/// number of passes in a single set.
double estimated_passes_by_replicas(Sampling sampling, double passes, double replicas, double error,
                                    double accuracy);

}  // namespace TRANSILLUM_API transillum
