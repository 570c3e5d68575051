// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/snapshot_values.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "radiosity/analysis/power_table.h"
#include "transillum/at.h"

namespace transillum::viewer {

Solution solution_of(const SolverSnapshot& snapshot, bool complete) {
  Solution solution;
  solution.scene = snapshot.loaded->scene;
  const SolvedLight& light = snapshot;
  static_cast<SolvedLight&>(solution) = light;
  solution.error = snapshot.error;
  solution.statistics = snapshot.statistics;
  solution.complete = snapshot.of_file ? snapshot.loaded->stored->complete : complete;
  solution.accuracy = snapshot.accuracy;
  solution.sky = snapshot.of_file ? snapshot.loaded->stored->sky : snapshot.options.sky;
  if (snapshot.passes_done == 0) {  // the snapshot has zeros in place of what is not known
    const SolvedLight unknown;
    const SolvedLight& known = snapshot.of_file ? *snapshot.loaded->stored : unknown;
    solution.form_factor_sums = known.form_factor_sums;
    solution.sky_fractions = known.sky_fractions;
    solution.sky_irradiance = known.sky_irradiance;
  }
  return solution;
}

Rgb value_at(const Rgb& mean, const LinearTerm& term, const LinearBasis& basis, const Vec3& point) {
  const auto [first, second] = basis.at(point);
  return mean + first * term.first + second * term.second;
}

Rgb radiosity_at(const SolverSnapshot& snapshot, PatchId i, const Vec3& point) {
  const Rgb& mean = at(snapshot.radiosity, i);
  return snapshot.linear_terms.empty()
             ? mean
             : value_at(mean, at(snapshot.linear_terms, i), at(*snapshot.bases, i), point);
}

RunOptions run_options_of(const SolverSnapshot& snapshot, const SceneOptions& scene,
                          const SceneInput& input) {
  RunOptions options{.solve = snapshot.options,
                     .scene = scene,
                     .input = input,
                     .refine = snapshot.refine,
                     .total = snapshot.total.has_value()};
  // Rounds and a total error make their divisions themselves.
  if (!options.refine.is_set() && !options.total) {
    const std::vector<std::string>& divided = snapshot.loaded->divided;
    options.input.divided.insert(options.input.divided.end(), divided.begin(), divided.end());
  }
  return options;
}

bool has_light(const SolverSnapshot& snapshot) {
  const bool emits =
      snapshot.materials ? snapshot.materials->has_light() : snapshot.loaded->scene->has_light();
  return snapshot.options.why_dark(emits).empty();
}

std::optional<double> escaped_share(const SolverSnapshot& snapshot) {
  if (snapshot.statistics.iterations == 0 || snapshot.sky_fractions.empty()) {
    return std::nullopt;
  }
  SurfacePower total;
  for (PatchId i = 0; i < snapshot.loaded->scene->patch_count(); ++i) {
    const double area = snapshot.loaded->scene->patch(i).area;
    total.emitted += area * material_of(snapshot, i).exitance;
    total.escaped += (area * at(snapshot.sky_fractions, i)) * at(snapshot.radiosity, i);
    if (!snapshot.sky_irradiance.empty()) {
      total.from_sky += area * at(snapshot.sky_irradiance, i);
    }
  }
  return transillum::escaped_share(total);
}

std::int64_t count_negative_corners(const SolverSnapshot& snapshot) {
  const Scene& scene = *snapshot.loaded->scene;
  std::int64_t count = 0;
  for (PatchId i = 0; i < std::ssize(snapshot.linear_terms); ++i) {
    for (const PointId corner : scene.outline(i)) {
      const Rgb b = radiosity_at(snapshot, i, scene.point(corner));
      count += std::min({b.r, b.g, b.b}) < 0 ? 1 : 0;
    }
  }
  return count;
}

namespace {

QString tr(const char* text) { return QCoreApplication::translate("FormFactors", text); }

}  // namespace

double form_factor(const FormFactors& form_factors, PatchId i, PatchId j) {
  const auto source = form_factors.source.begin();
  const auto end = source + static_cast<std::ptrdiff_t>(at(form_factors.row_begin, i + 1));
  const auto found =
      std::lower_bound(source + static_cast<std::ptrdiff_t>(at(form_factors.row_begin, i)), end, j);
  return found != end && *found == j ? at(form_factors.value, found - source) : 0.0;
}

std::vector<double> form_factors_from(const FormFactors& form_factors, PatchId i) {
  std::vector<double> row(form_factors.row_begin.size() - 1);
  for (std::size_t k = at(form_factors.row_begin, i); k < at(form_factors.row_begin, i + 1); ++k) {
    at(row, form_factors.source[k]) = form_factors.value[k];
  }
  return row;
}

std::vector<double> form_factors_to(const FormFactors& form_factors, PatchId i) {
  std::vector<double> column(form_factors.row_begin.size() - 1);
  for (PatchId j = 0; j < std::ssize(column); ++j) {
    at(column, j) = form_factor(form_factors, j, i);
  }
  return column;
}

QString why_no_form_factors(const SolverSnapshot& snapshot) {
  if (snapshot.glossy) {
    return tr("With lobes, transfers are kept by direction; there are no form factors.");
  }
  if (snapshot.progress.iteration == 0) {
    return tr("Form factors are available after the first iteration.");
  }
  if (!snapshot.form_factors_fit) {
    return tr("The form factors exceed the memory limit.");
  }
  return tr("Assembling the form factors…");
}

}  // namespace transillum::viewer
