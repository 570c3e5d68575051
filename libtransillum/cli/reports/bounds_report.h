// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// The report of `transillum bounds`: Tables 1 to 3 of the paper and predictions for one
// reflectance.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/bounds.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// Options of `transillum bounds`.
struct BoundsOptions {
  std::optional<double> rho;         ///< default: the scene's, or the paper's eight values
  double accuracy = 0.01;            ///< largest error of B, relative, in the maximum norm
  std::optional<double> size_ratio;  ///< R²/A; default: the scene's, or the paper's 150
  double tolerance = 1e-6;           ///< tolerance of the iteration
  int directions = 1024;
  DirectionSetFamily sets;
  std::shared_ptr<const Scene> scene;
  std::string run;  ///< file with statistics of a solve, or empty
};

/// Numbers of directions for one rho, a row of each table. The paper's values only where it has
/// them: for its reflectances, accuracy and size ratio.
struct BoundsRow {
  double rho = 0;
  std::optional<double> paper_contract, paper_homogeneous, paper_heterogeneous;
  double contract = 0, homogeneous = 0, heterogeneous = 0;  ///< by formula
  std::optional<int> actual_contract, actual_homogeneous;
  std::optional<double> estimated_heterogeneous;
};

/// Predictions for one rho with M directions: proven for Hammersley points (bound), and computed
/// from the measured eps(M).
struct BoundsPrediction {
  double rho = 0;
  double eps_bound = 0, eps = 0;
  double contraction_bound = 0, contraction = 0;
  std::optional<double> iterations_bound, iterations;
  double homogeneous_bound = 0, homogeneous = 0;
  double heterogeneous_bound = 0;
};

/// The error estimate of a solve run, and the passes that would reach the accuracy.
struct RunEstimate {
  std::string scene;
  Sampling sampling = Sampling::antipodal;
  double passes = 0, error = 0;  ///< relative RMS error of B
  double estimated_passes = 0;   ///< to reach the accuracy, without replicas
};

struct BoundsReport {
  BoundsOptions options;
  double size_ratio = 0;  ///< R²/A used
  std::vector<BoundsRow> rows;
  std::optional<BoundsPrediction> prediction;  ///< if there is one rho only
  std::optional<SceneMeasures> measures;
  std::optional<RunEstimate> run;
};

/// Receives the name of each part of the report before it is computed.
using BoundsTask = std::function<void(const std::string&)>;

/// Computes the report.
/// @throws InputError, Canceled
BoundsReport make_bounds_report(const BoundsOptions& options, const BoundsTask& begin,
                                const Cancellation& cancellation);

std::string text_of(const BoundsReport& report);
/// Writes the report as JSON.
void write_bounds_report(const std::string& path, const BoundsReport& report);

}  // namespace transillum::cli
