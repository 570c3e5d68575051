// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How wrong a solve is, by surface and cause: directions, patches, iterations and method. Each is
// measured by further work on the same scene; none is assumed (ALGORITHM.md 6.15).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/first_shot.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The four errors of a surface, relative to SurfaceError::unit, each of the channel that is off
/// the most by it.
struct CauseErrors {
  double directions = 0;  ///< too few: limit that holds in 95 % of all runs, by replicas
  double patches = 0;     ///< too large: RMS of B(x) against the functions of patches, estimated
  double iterations = 0;  ///< too few: RMS of a bound of what further ones would change
  double method = 0;      ///< engine, first shot, lost light: RMS
  /// The sum of the four. They may point the same way; were they independent, the root of the sum
  /// of their squares would do, which is at least half of it.
  double total() const { return directions + patches + iterations + method; }
};

/// The errors of one surface, and what they would be after dividing patches.
struct SurfaceCauses {
  std::string name;          ///< SurfaceError::name
  std::int64_t patches = 0;  ///< SurfaceError::patches
  double area = 0;           ///< m²
  Rgb unit;                  ///< SurfaceError::unit, W/m²
  bool is_dark = false;      ///< SurfaceError::is_dark
  CauseErrors errors = {};   ///< now
  double divided_alone = 0;  ///< CauseErrors::patches with the patches of this surface divided
  double divided_all = 0;    ///< CauseErrors::patches with all patches divided
};

/// A change of a solve, and what the error of the worst surface would be after it.
struct NextStep {
  enum class Kind { divide_surface, divide_all, directions, iterations };
  Kind kind = Kind::divide_all;  ///< the change
  std::string surface;           ///< the worst surface
  std::int64_t patches = 0;      ///< number of the scene's patches after it
  int passes = 0;                ///< per iteration after it
  double tolerance = 0;          ///< SolveOptions::tolerance after it
  double seconds = 0;            ///< wall time of the solve after it, by measured rates
  double from = 0, to = 0;       ///< CauseErrors::total() of the worst surface before and after

  /// Decrease of the error, over patches times passes: the work, which no other load changes.
  double gain() const { return (from - to) / (static_cast<double>(patches) * passes); }
};

/// How the errors were measured.
struct ErrorMeasurements {
  int replicas = 0;                  ///< whose spread gives the error by directions
  bool replicas_added = false;       ///< the solve had none: it was repeated with them
  std::int64_t divided_patches = 0;  ///< patches of the scene with divided patches
  double divided_fraction = 1;       ///< fraction of each surface's patches
  double divided_seconds = 0;        ///< wall time of its solve
  int compared_directions = 0;  ///< along which two engines were compared; 0 means no comparison
  Engine reference = Engine::exact;  ///< the other engine
  std::int64_t exact_queries = 0;    ///< PassCounts::exact_queries of the solve
  std::optional<double> lost;  ///< fraction of projected area without anything above it, along
                               ///< these directions; nothing where the scene is open
  double seconds = 0;          ///< wall time of all measurements
};

/// The errors of a solve.
struct ErrorReport {
  std::vector<SurfaceCauses> surfaces;  ///< in the order of SurfaceErrors::surfaces
  int worst = -1;                       ///< index of the largest total; -1 if there is none
  std::vector<NextStep> steps;          ///< by decreasing gain(), without those that gain nothing
  /// Per patch: RMS over the patch of B(x) against its functions, estimated, over the unit of its
  /// surface, of the channel that is off the most; 0 where no error is reported.
  std::vector<double> patch_errors;
  /// Per patch: `patch_errors` and the relative standard error of B, added; likewise.
  std::vector<double> relative_errors;
  ErrorMeasurements measurements;

  /// The total of the worst surface; 0 without surfaces.
  double total() const { return worst < 0 ? 0 : at(surfaces, worst).errors.total(); }
};

/// A finished solve, whose error is asked for.
struct MeasuredSolve {
  Solution solution;  ///< complete
  SolveOptions
      options;  ///< options of the last stage; `directions` and `replicas` are the solution's
  std::shared_ptr<const BspTree> tree;      ///< tree of its scene
  std::shared_ptr<const DirectLight> shot;  ///< null if there is none
  std::vector<Vec3> directions;             ///< omega of the passes of an iteration
};
}  // namespace transillum
