// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/bounds.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// What `transillum bounds` is asked.
struct BoundsQuestion {
  std::optional<double> rho;         ///< else the scene's, or the paper's eight
  double accuracy = 0.01;            ///< relative, in the maximum norm
  std::optional<double> size_ratio;  ///< R²/A; else the scene's, or the paper's 150
  double tolerance = 1e-6;           ///< of the iteration
  int directions = 1024;
  DirectionSetFamily sets;
  std::shared_ptr<const Scene> scene;
  std::string run;  ///< statistics of a solve, or empty
};

/// A rho's line of the tables. The paper's figures where it has them, for its accuracy and ratio.
struct BoundsRow {
  double rho = 0;
  std::optional<double> paper_contract, paper_homogeneous, paper_heterogeneous;
  double contract = 0, homogeneous = 0, heterogeneous = 0;  ///< by formula
  std::optional<int> actual_contract, actual_homogeneous;
  double estimated_heterogeneous = 0;
};

/// What M directions promise for a rho: proven for Hammersley's, and with the measured eps(M).
struct BoundsPrediction {
  double rho = 0;
  double eps_bound = 0, eps = 0;
  double contraction_bound = 0, contraction = 0;
  std::optional<double> steps_bound, steps;
  double homogeneous_bound = 0, homogeneous = 0;
  double heterogeneous_bound = 0;
};

/// What a solve says of its own error.
struct RunEstimate {
  std::string scene;
  Sampling sampling = Sampling::fibonacci;
  double passes = 0, error = 0;  ///< RMS of B, relative
  double estimated_passes = 0;   ///< to the accuracy, without replicas
};

struct BoundsReport {
  BoundsQuestion question;
  double size_ratio = 0;  ///< the one that was used
  std::vector<BoundsRow> rows;
  std::optional<BoundsPrediction> prediction;  ///< where there is one rho
  std::optional<SceneMeasures> measures;
  std::optional<RunEstimate> run;
};

/// @throws InputError, Canceled
BoundsReport answer(const BoundsQuestion& question, const Cancellation& cancellation);

std::string text_of(const BoundsReport& report);
void write_bounds_report(const std::string& path, const BoundsReport& report);

}  // namespace transillum::cli
