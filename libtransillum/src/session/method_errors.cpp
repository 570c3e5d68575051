// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The error of an engine, measured along a few directions of a solve. Input: the solve; another
// engine, whose areas count as true, makes the same passes.
//
// Notation: x_d is the error of B of a patch if all directions had the error of direction d. Its
// mean over the directions estimates what they have in common, its variance what averages out over
// M passes.
#include "session/method_errors.h"

#include <algorithm>
#include <cmath>

#include "radiosity/channel_sums.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"
#include "visibility/transfers/transfer_comparison.h"

namespace transillum {
namespace {

constexpr int most_directions = 4;
/// With more patches, exact arithmetic along one direction takes longer than a solve.
constexpr PatchId most_patches_exact = 5000;
/// Most patches times directions in exact arithmetic. A limit of time would make what a solve to a
/// total error decides depend on the machine.
constexpr int most_exact_work = 10'000;
/// Share of the projected area above which light escapes: the scene is open.
constexpr double most_escaped = 1e-9;

/// Sums over directions of the errors x_d, and of their squares, per patch.
struct DirectionSums {
  std::vector<Rgb> values, squares;
};

/// The error of H of each patch along one direction, if all directions had it, W/m².
std::vector<Rgb> errors_along(const TransferComparison& comparison, const Scene& scene,
                              const std::vector<Rgb>& b, bool two_way) {
  // H_i = 4 / (M A_i) sum A(i,j,omega) B_j over M directions, or 2M of which a pass serves two.
  const double weight = two_way ? 2 : 4;
  std::vector<Rgb> errors(scene.patches().size());
  for (const PairDifference& pair : comparison.pairs) {
    const double area = pair.other - pair.first;
    at(errors, pair.receiver) +=
        (weight * area / scene.patch(pair.receiver).area) * at(b, pair.source);
    if (two_way) {
      at(errors, pair.source) +=
          (weight * area / scene.patch(pair.source).area) * at(b, pair.receiver);
    }
  }
  return errors;
}

/// By how much an error of H grows as light is reflected on: 1 / (1 - the mean reflectance).
double reflections(const Scene& scene) {
  double rho = 0, area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    rho += scene.patch(i).area * sum(scene.reflectance(i)) / 3;
    area += scene.patch(i).area;
  }
  return 1 / (1 - ratio_or_zero(rho, area));
}

/// RMS over the patches of each surface of the error of M passes.
std::vector<Rgb> rms_by_surface(const DirectionSums& sums, const Scene& scene,
                                const Surfaces& surfaces, double compared, double passes) {
  const double growth = reflections(scene);
  std::vector<Rgb> squares(surfaces.surfaces.size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::int32_t s = surfaces.of(i);
    if (s == Surfaces::none) {
      continue;
    }
    for (const auto channel : channels_of_rgb) {
      const double mean = at(sums.values, i).*channel / compared;
      const double variance =
          compared > 1 ? std::max(0.0, at(sums.squares, i).*channel - compared * mean * mean) /
                             (compared - 1)
                       : 0;
      const double common = mean * mean - variance / compared;
      const double factor = growth * scene.reflectance(i).*channel;
      at(squares, s).*channel += factor * factor * (common + variance / passes);
    }
  }
  for (std::size_t s = 0; s < squares.size(); ++s) {
    const auto patches = static_cast<double>(surfaces.surfaces[s].patches);
    squares[s] = root(1 / patches * largest_of({}, squares[s]));
  }
  return squares;
}

/// Areas that patches receive from, and all that they see.
struct ReceivedAreas {
  double projected = 0, lost = 0;

  void add(const std::vector<Coverage>& sides) {
    for (const Coverage& side : sides) {
      projected += side.projected;
      lost += std::abs(side.projected - side.covered);
    }
  }
};

Engine reference_of(const MeasuredSolve& solve) {
  const bool is_exact = solve.options.engine == Engine::exact;
  return is_exact || solve.solution.scene->patch_count() > most_patches_exact ? Engine::local
                                                                              : Engine::exact;
}

}  // namespace

MethodErrors method_errors(const MeasuredSolve& solve, const Surfaces& surfaces,
                           const Cancellation& cancellation) {
  const Scene& scene = *solve.solution.scene;
  MethodErrors result;
  result.reference = reference_of(solve);
  const auto engine = make_engine(solve.options.engine, solve.solution.scene, solve.tree,
                                  solve.options.engine_options);
  const auto reference = make_engine(result.reference, solve.solution.scene, solve.tree);
  DirectionSums sums{std::vector<Rgb>(scene.patches().size()),
                     std::vector<Rgb>(scene.patches().size())};
  ReceivedAreas areas;
  const auto all = static_cast<int>(solve.directions.size());
  const int affordable =
      result.reference == Engine::exact ? std::max(1, most_exact_work / scene.patch_count()) : all;
  const int wanted = std::min({most_directions, affordable, all});
  for (int d = 0; d < wanted; ++d) {
    const Vec3& omega = at(solve.directions, d * (all / wanted));
    const Transfers found = engine(omega, cancellation);
    const TransferComparison comparison = compare(reference(omega, cancellation), found);
    const std::vector<Rgb> errors =
        errors_along(comparison, scene, solve.solution.radiosity, solve.options.two_way);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      sums.values[i] += errors[i];
      sums.squares[i] += errors[i] * errors[i];
    }
    areas.add(found.forward);
    areas.add(found.backward);
    ++result.directions;
  }
  result.rms = rms_by_surface(sums, scene, surfaces, std::max(1, result.directions),
                              solve.solution.statistics.passes);
  if (solve.solution.statistics.escaped <= most_escaped) {
    result.lost = ratio_or_zero(areas.lost, areas.projected);
  }
  return result;
}

}  // namespace transillum
