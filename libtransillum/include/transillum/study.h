// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
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
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

// How wrong B is after M passes: the paper's figure 5, for any scene, sampling and scheme.

/// How far B is off.
struct RadiosityError {
  double rms = 0;  ///< RMS of the difference over RMS of the reference, over patches and channels
  double max = 0;  ///< largest magnitude of the difference over the largest of the reference
};
/// @param b, reference W/m², one a patch. Not finite where the reference is 0.
RadiosityError radiosity_error(const std::vector<Rgb>& b, const std::vector<Rgb>& reference);

/// Which of the two.
enum class ErrorMeasure { rms, max };
const std::vector<std::string>& error_measure_names();
/// @throws InputError naming the choices.
ErrorMeasure error_measure_from_name(const std::string& name);

/// Options of the solve that others are compared with: so many passes of the default sampling, both
/// ways, under a rotation of its own, so that it shares no direction with anything studied.
SolveOptions reference_options(int passes);

/// One line in the plot of a study: what is solved with more and more directions.
struct StudySeries {
  Sampling sampling = Sampling::fibonacci;
  bool two_way = true;
  Normalization normalize = Normalization::none;
  Scheme scheme = Scheme::fixed;
  std::optional<double> first_shot = {};  ///< SolveOptions::first_shot
  Engine engine = Engine::fast;
  int resolution = 0;  ///< EngineOptions::resolution

  friend bool operator==(const StudySeries&, const StudySeries&) = default;
};
/// Names for a plot: the sampling, and behind slashes what else sets the series apart from one
/// another, as in `hammersley/one-way/rows`.
std::vector<std::string> names_of(std::span<const StudySeries> series);

/// Steps that the mean of the semi-iterative scheme is usually taken of, after those of burn_in.
inline constexpr int default_averaged_iterations = 16;

struct StudyOptions {
  std::vector<StudySeries> series;
  std::vector<int> directions;  ///< M
  /// Each M is solved with so many sets, each turned by a rotation and sown by a seed of its own;
  /// 1: with the one set as it is.
  int rotations = 1;
  /// Patches that emit are left out of the errors: what they emit is known, and may outshine all
  /// that is not.
  bool without_sources = false;
  /// All that the series leave open. For the semi-iterative scheme iterations 0 means those of
  /// burn_in and default_averaged_iterations.
  SolveOptions solve{.tolerance = 1e-8};

  /// The options of one solve.
  SolveOptions solve_options(const StudySeries& of, int passes, int rotation = 0) const;
  /// Of the solve to compare with: so many passes, 0: four times the most that are studied. It
  /// shoots first where any of the series does.
  SolveOptions reference(int passes = 0) const;
  /// @throws InputError, also for series that SolveOptions::validate refuses.
  void validate() const;
};

/// One M of one series.
struct StudyPoint {
  std::size_t series = 0;  ///< in StudyOptions::series
  /// M; of the semi-iterative scheme M times the steps; of hemicubes one a patch, whatever M.
  std::int64_t passes = 0;
  std::int64_t directions = 0;  ///< passes, or twice as many; of hemicubes the pixels of one
  double rms_error = 0;         ///< of several rotations, the RMS
  double max_error = 0;         ///< of several rotations, the largest
  double bound = 0;  ///< NaN of hemicubes; of errors where the environment is nearly homogeneous,
                     ///< by eq. 37 and 21
  double seconds =
      0;  ///< processor time of passes and iteration, of all threads; mean of rotations
  /// Why there are no errors here (NaN): too few directions for the iteration to converge, or too
  /// little memory for what was asked.
  std::string failure;

  double error(ErrorMeasure measure) const {
    return measure == ErrorMeasure::rms ? rms_error : max_error;
  }
};

/// Where a study stands.
struct StudyProgress {
  std::size_t series = 0;  ///< under way
  int directions = 0;      ///< M under way
  double share = 0;        ///< of all passes, done
  double passes_per_second = 0;
  double seconds_left = 0;             ///< estimated
  std::span<const StudyPoint> points;  ///< done so far, by M, then series; valid during the call
};
using StudyObserver = std::function<void(const StudyProgress&)>;

struct Study {
  std::vector<StudyPoint> points;  ///< by series, then M
  bool complete = false;           ///< false: canceled; the points are those done by then
};

/// B to compare with, W/m², one a patch.
/// @throws InputError, Canceled, std::runtime_error
std::vector<Rgb> solve_reference(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const SolveOptions& options,
                                 const std::function<void(const SolveProgress&)>& observer = {},
                                 const Cancellation& cancellation = {});

/// Solves for every series and M, the small ones first, and compares with `reference`, B of the
/// scene. The scene is sorted once, in `tree`.
/// @throws InputError, std::runtime_error
Study run_study(const std::shared_ptr<const Scene>& scene,
                const std::shared_ptr<const BspTree>& tree, const StudyOptions& options,
                const std::vector<Rgb>& reference, const StudyObserver& observer = {},
                const Cancellation& cancellation = {});

/// The points of one series.
std::vector<StudyPoint> points_of(const Study& study, std::size_t series);

/// error = factor * passes ^ slope, by least squares of the logarithms of the errors.
struct PowerLaw {
  double slope = 0, factor = 0;
};
/// Of the points of one series with an error above 0; none if these are fewer than two.
std::optional<PowerLaw> fitted_power_law(std::span<const StudyPoint> points,
                                         ErrorMeasure measure = ErrorMeasure::rms);

/// What a series takes to an accuracy, between its points by power laws.
struct StudyCost {
  double passes = 0, seconds = 0;
  bool at_most = false;  ///< the first point is as good already
};
/// Where the error of the points of one series falls below `accuracy` for good; none if it does
/// not.
std::optional<StudyCost> cost_of(std::span<const StudyPoint> points, double accuracy,
                                 ErrorMeasure measure = ErrorMeasure::rms);

}  // namespace transillum
