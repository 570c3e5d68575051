// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/directions.h"
#include "transillum/scene.h"

namespace transillum {

// What the paper proves about M directions; rho is the largest reflectance, 0 <= rho < 1, and eps
// the error of the quadrature of the cosine, eq. 17 (radians; the integral is pi).

/// D* of M >= 1 points of Hammersley's at most (eq. 20; the logarithm is to base 2).
double star_discrepancy_bound(double directions);
/// eps of M >= 1 points of Hammersley's at most (eq. 21).
double quadrature_error_bound(double directions);
/// The factor by which a step shrinks changes, at most: rho (1 + eps/pi) (eq. 22).
double contraction_bound(double rho, double eps);
/// Steps after which the iteration, begun with 0, is within `tolerance` of its limit, relative and
/// in the maximum norm (eq. 25). None where the contraction is not below 1.
std::optional<double> iterations_to(double tolerance, double contraction);
/// ||B* - B|| / ||B|| in the maximum norm where the environment is nearly homogeneous (eq. 37).
double homogeneous_error_bound(double rho, double eps);
/// The same in any environment, by the ratio max R²/A_i of scene to patches and D* (eq. 43).
double heterogeneous_error_bound(double rho, double size_ratio, double star_discrepancy);

// The smallest M for which these bounds, with eq. 20 and 21, promise something. Whole; as double,
// for it may be beyond any integer. @throws InputError unless 0 <= rho < 1, accuracy > 0 and
// size_ratio > 0, all finite.

/// The iteration contracts (eq. 24): Table 1.
double directions_to_contract(double rho);
/// Error at most `accuracy` where nearly homogeneous: Table 2.
double directions_if_homogeneous(double rho, double accuracy);
/// Error at most `accuracy` anywhere: Table 3.
double directions_if_heterogeneous(double rho, double accuracy, double size_ratio);

/// The paper's tables as printed, for rho = 0.2 … 0.9, accuracy 0.01 and size ratio 150.
struct PaperTables {
  static constexpr int rows = 8;
  static constexpr double accuracy = 0.01, size_ratio = 150;
  std::array<double, rows> rho, to_contract, if_homogeneous, if_heterogeneous;
};
const PaperTables& paper_tables();

/// What a family of sets does in truth, instead of what is proven for Hammersley's.
struct DirectionSetFamily {
  Sampling sampling = Sampling::fibonacci;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> rotation = {};
  bool two_way = true;

  std::vector<DirectionSample> make(int directions) const;
};
/// eps of a set: the largest magnitude of eq. 17 over 518 normals spread over the sphere.
double measured_quadrature_error(const DirectionSetFamily& sets, int directions,
                                 const Cancellation& cancellation = {});
/// The smallest M up to 65,536 for which eq. 24 holds with the measured eps; none if there is none.
/// Beyond 256, found by doubling and halving: some smaller M may do by luck.
/// @throws Canceled
std::optional<int> actual_directions_to_contract(const DirectionSetFamily& sets, double rho,
                                                 const Cancellation& cancellation = {});
/// The same for the bound of eq. 37.
std::optional<int> actual_directions_if_homogeneous(const DirectionSetFamily& sets, double rho,
                                                    double accuracy,
                                                    const Cancellation& cancellation = {});

/// About as many as the bound of eq. 43 asks for with the sets' own D*, measured with 1,024 and
/// 16,384 directions and continued as a power of M.
/// @throws Canceled
double estimated_directions_if_heterogeneous(const DirectionSetFamily& sets, double rho,
                                             double accuracy, double size_ratio,
                                             const Cancellation& cancellation = {});

/// What of a scene the bounds ask for.
struct SceneMeasures {
  double rho_max = 0;           ///< over patches and channels
  double extent = 0;            ///< R, m: no two points are farther apart; at most 0.4 % too much
  double smallest_area = 0;     ///< m², of a patch
  PatchId smallest = no_patch;  ///< that patch
  double size_ratio = 0;        ///< max_i R²/A_i
};
SceneMeasures measure(const Scene& scene, const Cancellation& cancellation = {});

/// Passes that bring the error to `accuracy`, by a run of `passes` passes of the same sampling with
/// an error of `error` (both in one norm): error falls as M^-1/2 at random, and else as M^-3/4,
/// which is what integrands with kinks allow at worst.
double estimated_passes(Sampling sampling, double passes, double error, double accuracy);
/// The same from the error of a run of `passes` passes in `replicas` replicas, as they give it.
/// What is estimated is without replicas, as one set.
double estimated_passes_by_replicas(Sampling sampling, double passes, double replicas, double error,
                                    double accuracy);

}  // namespace transillum
