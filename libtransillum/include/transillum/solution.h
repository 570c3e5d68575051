// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Result of a solve: radiosity, its estimated error, and statistics of the run.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/accuracy_goal.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/linear_basis.h"
#include "transillum/scene.h"
#include "transillum/sky.h"
#include "transillum/transfers.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// One finished iteration of eq. 11.
struct IterationRecord {
  /// Largest change of B over the largest reflected light (reflected_light()); not of the mean
  double change = 0;
  double contraction = 0;  ///< absolute change over the one of the iteration before; 0 in the
                           ///< first. semi_iterative: factor per iteration by which the influence
                           ///< of the start decreases
  double seconds = 0;      ///< wall time
  /// semi_iterative, from the eighth iteration in the mean on: largest error of the mean over its
  /// largest reflected light: 95 % of the spread of iterations, and all that is left of the start.
  /// The sets of directions must differ: Sampling::hammersley and centered_hammersley have the
  /// error of one set.
  std::optional<double> error = {};
  /// Bound of the power that further iterations would add, over the reflected power, in the channel
  /// where it is largest. With c the larger of rho_max and the contraction, it is c / (1 - c) times
  /// the power of the last change; infinite where c is not below 1. semi_iterative: bound of what
  /// is left of the start
  double remainder = 0;
  /// The same bound for the dimmest tenth of the lit area, where B - E is at least 1e-6 of the
  /// largest.
  double remainder_dimmest = 0;
  double unlit_area = 0;   ///< fraction of the area of reflecting patches that is not lit
  double change_of_b = 0;  ///< eq. 25 of the paper: largest change of B over the largest B, with E
  Rgb changes = {};        ///< largest change of B of each channel, W/m²; 0 if read from a file
};

/// A solve of an adaptive refinement (refinement.h), after which patches are divided.
struct RefinementRound {
  std::int64_t patches = 0;  ///< patches of the scene so far
  /// Root of the sum of squares over patches of the jump times the root of the area
  /// (RefineBy::jump), or of what the functions of a patch cannot represent (RefineBy::error);
  /// relative to the same root for the radiosity of all patches that emit nothing; of the color
  /// channel where that is largest
  double measure = 0;
  double seconds = 0;  ///< wall time of the round
};

/// The error of one surface: a group, a material or a connected component. Relative errors are
/// relative to `unit`.
struct SurfaceError {
  std::string name;  ///< name of the surface; "others": those with less than 1 % of the area
  std::int64_t patches = 0;  ///< number of patches that are measured
  double area = 0;           ///< their area, m²
  double level = 0;          ///< RMS of the quantity over patches and channels, W/m²
  /// RMS of the quantity over the patches, or 1/1000 of the brightest surface's where that is
  /// larger; each channel by itself, unless it is unlit (below 1e-6 of the brightest one). W/m²
  Rgb unit;
  bool is_dark = false;  ///< all channels are below 1/1000 of the brightest surface's
  // Each error below is the largest over the channels, relative to the unit of its channel.
  Rgb spreads = {};   ///< RMS error by the spread of replicas, of each channel, relative
  double spread = 0;  ///< the same of the channel with the largest limit
  double bias = 0;    ///< RMS of what iterations and the first shot may leave, relative
  double rms = 0;     ///< root of the sum of the squares of both
  double limit = 0;   ///< relative RMS error that this surface does not exceed in 95 % of all runs
  double independent_errors = 1;  ///< see ErrorEstimate::independent_errors
};

/// The errors of the surfaces of a scene. Patches that emit are omitted, unless all do.
struct SurfaceErrors {
  int replicas = 0;                    ///< 0 means no estimate: all other members are empty
  std::vector<SurfaceError> surfaces;  ///< in the order of the scene
  /// Relative RMS error that none of the surfaces exceeds in 95 % of all runs: at least the largest
  /// SurfaceError::limit
  double limit = 0;
  int worst = -1;  ///< index of the surface with the largest limit; -1 if there is none
};

/// The error of B due to the finite number of directions, estimated from the spread of
/// independently rotated replicas; no reference is needed. A random rotation makes each replica
/// unbiased (eq. 47), so B ± quantile * standard error contains the B of infinitely many directions
/// in 95 % of all runs. Bounds of what is left of the start (semi-iterative scheme), or of what
/// further iterations would change (others, converged or not), and the estimated error of the first
/// shot (DirectLight::irradiance_error) are included as the root of the sum of squares.
struct ErrorEstimate {
  int replicas = 0;                 ///< 0 means no estimate: all other members are empty
  std::vector<Rgb> standard_error;  ///< standard error of B, W/m², one per patch
  double quantile = 0;  ///< Student's t, two-sided 95 %, replicas - 1 degrees of freedom
  /// RMS error of the channel that is off the most: RMS of its errors over RMS of its reflected
  /// light (reflected_light()), both over patches. The errors of a channel with less than 1e-6 of
  /// the brightest channel's light are relative to 1e-6 of the brightest channel's light.
  double rms = 0;
  /// Limit that the relative RMS error stays below in 95 % of all runs. Larger than `rms` by the
  /// uncertainty of an estimate from few replicas: a quantile of the F distribution, less so the
  /// more independent the errors of the patches are.
  double rms_limit = 0;
  double rms_lowest = 0;  ///< limit exceeded in 95 % of all runs; with rms_limit a 90 % interval
  /// Number of independent errors that would vary as the errors of all patches do together, in the
  /// same channel, >= 1
  double independent_errors = 1;
  Rgb mean_radiosity;        ///< area-weighted mean of B, W/m²
  Rgb mean_standard_error;   ///< standard error of this mean, W/m²
  Rgb mean_reflected;        ///< area-weighted mean of B - E, W/m²
  SurfaceErrors surfaces;    ///< errors of B - E
  SurfaceErrors irradiance;  ///< errors of H; only after a finished iteration
};

/// Statistics of a solve in which lobes take part.
struct GlossyStatistics {
  std::int64_t patches = 0;  ///< patches that have a lobe; 0 if lobes took no part
  std::int64_t lobes = 0;    ///< different ones: by shape and orientation
  /// Largest difference from 1 of the sum over the directions of a lobe that reflects everything,
  /// before it was scaled: above a few percent, the directions are too few for it.
  double sum_error = 0;
  /// The same after scaling: rounding.
  double sum_defect = 0;
  /// Fraction of the light of lobes that scaling could not put around the mirror direction,
  /// largest.
  double spread = 0;
  double exponent = 0;               ///< largest exponent; of ggx, of the Phong lobe as wide
  std::uint64_t radiance_bytes = 0;  ///< memory of radiances by direction
  std::uint64_t lobe_bytes = 0;      ///< memory of the scales of lobes
  std::uint64_t transfer_bytes = 0;  ///< memory of kept transfers; 0: computed in each iteration
};

/// Statistics of a solve run. Times are wall times.
struct SolveStatistics {
  std::int64_t patches = 0;        ///< patches of the scene
  std::int64_t fragments = 0;      ///< fragments of the BSP tree
  int directions = 0;              ///< directions used: M or 2M
  int passes = 0;                  ///< M
  std::int64_t passes_made = 0;    ///< passes made by the engine, in all iterations
  std::int64_t hemicubes = 0;      ///< hemicubes drawn instead of passes; a direction is one pixel
  std::int64_t pairs = 0;          ///< pairs of patches, computed instead of passes
  int iterations = 0;              ///< finished iterations
  int burn_in = 0;                 ///< semi_iterative: iterations omitted from the mean
  int threads = 0;                 ///< threads used
  std::int64_t transfers = 0;      ///< exchanges found, over all different directions
  std::int64_t form_factors = 0;   ///< kept entries; 0 where they are recomputed
  bool kept_form_factors = false;  ///< the exchange sums of all passes are in memory
  /// The tolerance was reached, or changes are rounding; never while the power of the last change
  /// is more than ten tolerances of the emitted power
  bool converged = false;
  double closure_defect_max = 0;      ///< largest ClosureDefect::relative (ALGORITHM.md, oracle 1)
  double closure_defect_grazing = 0;  ///< largest ClosureDefect::grazing
  double closure_defect_moments = 0;  ///< largest ClosureDefect::moments; 0 with Basis::constant
  /// With Basis::linear, the number of corners of patches at which a channel of B is below 0; set
  /// by RadiositySolver::solution()
  std::int64_t negative_corners = 0;
  /// Directions that bring a patch the light of a source: (sum c)² / sum c² of the light c that it
  /// receives along each; mean over pairs of patch and source, each weighted by what it contributes
  /// to the variance of B. 0 without direct light. Below least_light_directions per replica, the
  /// error estimate cannot be trusted.
  double light_directions = 0;
  double escaped = 0;        ///< fraction of projected area with nothing above; 0 if closed
  double energy_defect = 0;  ///< |sum A_i H_i - sum_j s_j A_j B_j| over the second sum
                             ///< (ALGORITHM.md, oracle 4)
  /// Power absorbed, sum A_i (1 - rho_i) H_i, over the power emitted, sum A_i E_i, and received
  /// from the sky; 1 in a closed scene.
  double energy_balance = 0;
  double rho_max = 0;                              ///< largest reflectance
  double predicted_contraction = 0;                ///< rho_max (1 + eps(M)/pi), eq. 22 with eq. 21
  PassCounts counts;                               ///< sum over all different directions
  std::vector<IterationRecord> iteration_records;  ///< one per iteration
  std::vector<RefinementRound> refinement;  ///< rounds that led to the scene; set by the caller
  std::int64_t shot_sources = 0;   ///< patches whose emission was shot before the iteration
  double shot_power_fraction = 0;  ///< their power over all power emitted
  /// Largest difference between the first shot and what the passes see of its sources, over what
  /// the errors of both explain; above 1, one of them is wrong. 0 without a shot, and with engines
  /// that are not exact.
  double shot_disagreement = 0;
  PatchId shot_disagreement_patch = -1;  ///< patch that receives it; -1: all patches together
  /// Pairs of patches with nothing between them, in engine pairs and in the first shot, whose form
  /// factor was integrated numerically because the closed form would lose digits.
  std::int64_t integrated_pairs = 0;
  GlossyStatistics glossy;        ///< statistics of a glossy solve
  double seconds_load = 0;        ///< reading the scene; set by the caller
  double seconds_bsp = 0;         ///< building BSP tree and engine
  double seconds_first_shot = 0;  ///< first shot
  double seconds_transfers = 0;   ///< passes
  double seconds_iterate = 0;     ///< iterating
  double seconds_total = 0;       ///< all of these
};

/// Number of directions per replica that must bring a patch its direct light for its error estimate
/// to be trusted (SolveStatistics::light_directions; decisions/0052-accuracy.md).
inline constexpr double least_light_directions = 3;

class GlossyLight;

/// The light of all patches, one value per patch.
struct SolvedLight {
  std::vector<Rgb> radiosity;   ///< B, W/m²; the mean over the patch where B is linear
  std::vector<Rgb> irradiance;  ///< H, W/m²
  /// RadiositySolver::linear_terms(), with Basis::linear; empty if B is constant on patches
  std::vector<LinearTerm> linear_terms = {};
  /// sum_j F_ij; empty if not known
  std::vector<double> form_factor_sums = {};
  /// RadiositySolver::sky_fractions(); with given form factors, 1 - sum_j F_ij, which counts
  /// what meets back sides as escaping. Empty if not known.
  std::vector<double> sky_fractions = {};
  /// RadiositySolver::sky_irradiance(), the sun's too; part of `irradiance`; empty without both
  std::vector<Rgb> sky_irradiance = {};
  /// RadiositySolver::sky_linear_terms(); empty without a sky, and with Basis::constant
  std::vector<LinearTerm> sky_linear_terms = {};
  /// Radiance by direction after a glossy solve in which lobes took part; else null. `radiosity` is
  /// then E + (rho + reflectance of the lobe) H.
  std::shared_ptr<const GlossyLight> glossy = nullptr;
};

/// The result of a solve run.
struct Solution : SolvedLight {
  std::shared_ptr<const Scene> scene;  ///< the scene
  ErrorEstimate error;                 ///< from replicas, if there are any
  SolveStatistics statistics;          ///< statistics of the run
  bool complete = false;  ///< false: stopped early, radiosity is the best estimate so far
  std::optional<AccuracyReport> accuracy = {};  ///< report of a solve with a goal
  Sky sky = {};                                 ///< SolveOptions::sky
  /// The form factors given to the solve; if null, RadiositySolver::form_factors() may have them.
  std::shared_ptr<const FormFactors> form_factors = nullptr;
  /// A point from which patches are seen; result files then have their radiance toward it.
  std::optional<Vec3> eye = std::nullopt;
};

/// The reflected light B - E of each patch, W/m², which relative changes, errors and differences
/// are relative to. It is 0 for patches that emit, unless all emit or the others reflect nothing.
/// @param b B, W/m², one value per patch; with a linear basis three, the mean first.
std::vector<Rgb> reflected_light(const Scene& scene, const std::vector<Rgb>& b);

/// B at the corners of patch i's outline, W/m². With Basis::linear it may be below 0.
std::vector<Rgb> corner_radiosity(const Solution& solution, PatchId i);

/// The patches whose standard errors may be much too small, because all replicas miss the light of
/// a small source alike. Not measured but expected, by sizes and distances: light of sources that
/// fewer than least_light_directions per replica bring to the patch is more than half of its
/// interval. Blockers are not taken into account, so these may be too many.
/// @param solution of passes with replicas; otherwise, and where all sources were shot first or
/// patches times sources exceed 2^22, the result is empty.
std::vector<PatchId> uncertain_patches(const Solution& solution);

}  // namespace TRANSILLUM_API transillum
