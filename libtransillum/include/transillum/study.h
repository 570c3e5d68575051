// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Studies: the error of B after M passes, as in the paper's figure 5, for any scene, sampling,
// scheme and engine. run_study() solves every series for every M and compares with a reference, B
// of a solve with many more passes (solve_reference()); the points go to the chart and table of
// study_files.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/errors.h"
#include "transillum/export.h"
#include "transillum/radiosity_solver.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// The error of B against a reference, relative to the reference's reflected light, on the patches
/// where that is measured (reflected_light()).
struct RadiosityError {
  double rms = 0;  ///< RMS of the difference over RMS of the light, as ErrorEstimate::rms
  /// Largest magnitude of the difference over the largest of the light, over patches and channels.
  double max = 0;
};
/// Computes the error of `b`. Not finite where nothing is reflected.
/// @param scene the scene, with E.
/// @param b W/m², one per patch; with a linear basis three, the mean first.
/// @param reference likewise.
RadiosityError radiosity_error(const Scene& scene, const std::vector<Rgb>& b,
                               const std::vector<Rgb>& reference);

/// The same for functions: `rms` is the L2 norm of the difference over the L2 norm of the
/// reference, `max` the largest magnitude of a coefficient's difference over the largest of the
/// reference.
/// @param b the coefficients of each patch: its mean, or also its LinearTerm.
/// @param reference three coefficients for each patch.
RadiosityError function_error(const Scene& scene, const std::vector<Rgb>& b,
                              const std::vector<Rgb>& reference);

/// A member of RadiosityError.
enum class ErrorMeasure {
  rms,  ///< RadiosityError::rms
  max,  ///< RadiosityError::max
};
/// Their names (choice.h).
template <>
const Choices& choices_of<ErrorMeasure>();

/// Options of the reference solve: `passes` two-way passes of the Fibonacci lattice under a
/// rotation of its own, so that it shares no direction with the solves studied.
SolveOptions reference_options(int passes);

/// One line in the plot of a study: settings that are solved with increasing M.
struct StudySeries {
  Sampling sampling = Sampling::antipodal;        ///< SolveOptions::sampling
  bool two_way = true;                            ///< SolveOptions::two_way
  Normalization normalize = Normalization::none;  ///< SolveOptions::normalize
  Scheme scheme = Scheme::fixed;                  ///< SolveOptions::scheme
  std::optional<double> first_shot = {};          ///< SolveOptions::first_shot
  Engine engine = Engine::fast;                   ///< SolveOptions::engine
  int resolution = 0;  ///< EngineOptions::resolution; of engine pairs EngineOptions::points
  Basis basis = Basis::constant;  ///< SolveOptions::basis

  /// Exact comparison of all members.
  friend bool operator==(const StudySeries&, const StudySeries&) = default;
};
/// Names for a plot: the sampling, and after slashes the settings in which the series differ, as in
/// `hammersley/one-way/rows`.
std::vector<std::string> names_of(std::span<const StudySeries> series);

/// Default number of iterations in the mean of the semi-iterative scheme, after the burn-in.
inline constexpr int default_averaged_iterations = 16;

/// Estimate of the number of iterations in which a solve makes passes: 1, or in the semi-iterative
/// scheme all of them.
/// @param options of the solve; of the semi-iterative scheme not those that stop by tolerance
/// @param rho_max largest reflectance of the scene, below 1
double expected_iterations_with_passes(const SolveOptions& options, double rho_max);

/// Options of run_study().
struct StudyOptions {
  std::vector<StudySeries> series;  ///< at least one
  std::vector<int> directions;      ///< values of M
  /// Number of direction sets that each M is solved with, each with its own rotation and seed; 1:
  /// one set without a rotation.
  int rotations = 1;
  /// Settings common to all series. In the semi-iterative scheme averaged_iterations = 0 means
  /// default_averaged_iterations.
  SolveOptions solve{.tolerance = 1e-8};

  /// The options of one solve.
  SolveOptions solve_options(const StudySeries& of, int passes, int rotation = 0) const;
  /// Whether errors are measured between functions, because the basis of any series is linear.
  bool of_functions() const;
  /// The options of the reference solve, with a first shot, or a linear basis, if any series has
  /// one.
  /// @param passes 0: four times the largest number studied.
  SolveOptions reference(int passes = 0) const;
  /// @throws InputError, also for series that SolveOptions::validate rejects.
  void validate() const;
};

/// The result of one series for one M.
struct StudyPoint {
  std::size_t series = 0;  ///< index in StudyOptions::series
  /// M; in the semi-iterative scheme M times the iterations; for hemicubes and
  /// pairs the number of patches.
  std::int64_t passes = 0;
  std::int64_t directions = 0;  ///< passes, or twice as many; for hemicubes the pixels of one, for
                                ///< pairs PairOptions::points
  double rms_error = 0;         ///< RMS over the rotations
  double max_error = 0;         ///< largest over the rotations
  double bound = 0;             ///< error bound in a nearly homogeneous environment, by eq. 37 and
                                ///< 21; NaN for hemicubes and pairs
  double seconds = 0;           ///< processor time of passes and iteration, all threads; mean over
                                ///< the rotations
  /// Why the errors are NaN: too few directions for convergence, or insufficient memory. Empty:
  /// they are not.
  std::string failure;
  Remedy remedy = Remedy::none;  ///< the change that would avoid the failure

  /// rms_error or max_error.
  double error(ErrorMeasure measure) const {
    return measure == ErrorMeasure::rms ? rms_error : max_error;
  }
};

/// Progress of run_study().
struct StudyProgress {
  std::size_t series = 0;              ///< being solved
  int directions = 0;                  ///< M being solved
  double fraction = 0;                 ///< fraction of all passes that are done, [0,1]
  double passes_per_second = 0;        ///< rate of the current solve
  double seconds_left = 0;             ///< estimated
  std::span<const StudyPoint> points;  ///< done so far, by M, then series; valid during the call
};
/// Called on the thread of run_study().
using StudyObserver = std::function<void(const StudyProgress&)>;

/// The result of run_study().
struct Study {
  std::vector<StudyPoint> points;  ///< sorted by series, then M
  bool complete = false;           ///< false: canceled; the points are those done by then
};

/// B of the reference solve.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param options StudyOptions::reference().
/// @param observer if set, called after every pass.
/// @param cancellation checked during the solve.
/// @returns B, W/m², one per patch; with Basis::linear three coefficients per patch.
/// @throws InputError, Canceled, std::runtime_error
std::vector<Rgb> solve_reference(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const SolveOptions& options,
                                 const std::function<void(const SolveProgress&)>& observer = {},
                                 const Cancellation& cancellation = {});

/// The reference of a study, and the points that are already known.
struct StudyStart {
  std::span<const Rgb> reference;  ///< radiosity by solve_reference()
  /// Points of an earlier call with the same arguments, in the order of StudyProgress::points; they
  /// are not solved again.
  std::span<const StudyPoint> done = {};
};

/// Solves every series for every M, small M first, and compares with the reference.
/// @param scene the scene.
/// @param tree BSP tree of `scene`, used by all solves.
/// @param options series, values of M and common settings.
/// @param start the reference, and points of an earlier call.
/// @param observer if set, called after every pass and every point.
/// @param cancellation when set, the points done so far are returned.
/// @throws InputError, std::runtime_error
Study run_study(const std::shared_ptr<const Scene>& scene,
                const std::shared_ptr<const BspTree>& tree, const StudyOptions& options,
                const StudyStart& start, const StudyObserver& observer = {},
                const Cancellation& cancellation = {});

/// The points of one series, by M.
std::vector<StudyPoint> points_of(const Study& study, std::size_t series);

/// error = factor * passes ^ slope.
struct PowerLaw {
  double slope = 0;   ///< exponent, usually negative
  double factor = 0;  ///< error of one pass
};
/// Least-squares fit to the logarithms of the errors of one series; points with an error of 0 or
/// NaN are ignored. Nothing if fewer than two remain.
std::optional<PowerLaw> fitted_power_law(std::span<const StudyPoint> points,
                                         ErrorMeasure measure = ErrorMeasure::rms);

/// The cost of reaching an accuracy, interpolated between the points of a series by power laws.
struct StudyCost {
  double passes = 0;     ///< number of passes
  double seconds = 0;    ///< processor time
  bool at_most = false;  ///< an upper bound: the first point already has the accuracy
};
/// The cost from which the error of a series stays below `accuracy`; nothing if it does not.
std::optional<StudyCost> cost_of(std::span<const StudyPoint> points, double accuracy,
                                 ErrorMeasure measure = ErrorMeasure::rms);

}  // namespace TRANSILLUM_API transillum
