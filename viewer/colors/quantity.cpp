// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Quantities of the patches: names and units, and values from a snapshot of the solver.
#include "colors/quantity.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "geometry/luminance.h"
#include "model/run_comparison.h"
#include "model/snapshot_values.h"
#include "support/has_index.h"
#include "transillum/at.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("Quantity", text); }

Rgb gray(double value) { return {value, value, value}; }

std::vector<Rgb> grays(const std::vector<double>& values) {
  std::vector<Rgb> result;
  result.reserve(values.size());
  for (const double value : values) {
    result.push_back(gray(value));
  }
  return result;
}

std::vector<Rgb> of_materials(const SolverSnapshot& snapshot, Rgb Material::*member) {
  std::vector<Rgb> values;
  values.reserve(snapshot.radiosity.size());
  for (PatchId i = 0; i < snapshot.loaded->scene->patch_count(); ++i) {
    values.push_back(material_of(snapshot, i).*member);
  }
  return values;
}

PatchValues form_factors_of(const SolverSnapshot& snapshot, PatchId selected, bool from) {
  if (selected < 0 || selected >= snapshot.loaded->scene->patch_count()) {
    return {{}, tr("Click a patch to see its form factors.")};
  }
  if (!snapshot.form_factors) {
    return {{}, why_no_form_factors(snapshot)};
  }
  return {grays(from ? form_factors_from(*snapshot.form_factors, selected)
                     : form_factors_to(*snapshot.form_factors, selected)),
          {}};
}

/// How much of B comes from sky and sun, which no patch shows; empty without them.
QString light_from_outside(const PatchResponse& response, const Rgb& b) {
  QStringList sources;
  const auto add = [&](const Rgb& light, const QString& text) {
    if (luminance(light) > 1e-12 * luminance(b)) {
      sources << text.arg(100 * luminance(light) / luminance(b), 0, 'f', 1);
    }
  };
  add(response.from_sun, tr("%1 % from the sun"));
  add(response.from_sky, tr("%1 % from the sky"));
  return sources.isEmpty() ? QString() : tr("B of the selected patch: %1").arg(sources.join(", "));
}

PatchValues by_response(Quantity quantity, const SolverSnapshot& snapshot, PatchId selected,
                        const PatchResponse* response) {
  const Scene& scene = *snapshot.loaded->scene;
  if (selected < 0 || selected >= scene.patch_count()) {
    return {{}, tr("Click a patch to see what lights it.")};
  }
  if (!snapshot.form_factors) {
    return {{}, why_no_form_factors(snapshot)};
  }
  if (!response || response->loaded != snapshot.loaded || response->receiver != selected) {
    return {{}, tr("Finding what lights the patch…")};
  }
  PatchValues result{response->adjoint.per_watt, {}};
  if (quantity == Quantity::origin) {
    result.note = light_from_outside(*response, at(snapshot.radiosity, selected));
    for (PatchId j = 0; j < scene.patch_count(); ++j) {
      Rgb& value = at(result.values, j);
      value = scene.patch(j).area * (value * material_of(snapshot, j).exitance);
    }
  }
  return result;
}

PatchValues difference(const SolverSnapshot& snapshot, const SolverSnapshot* other) {
  if (!other) {
    return {{}, tr("Keep a run of this scene first (K): it becomes A.")};
  }
  // Percent of each channel of the surface's level; not a number where the patch is omitted.
  const ResultComparison comparison = compare_runs(*other, snapshot);
  const std::vector<Rgb>& units = comparison.units;
  if (std::all_of(units.begin(), units.end(), [](const Rgb& u) { return max_abs(u) == 0; })) {
    return {{}, tr("A reflects no light, which differences would be relative to.")};
  }
  std::vector<Rgb> percent;
  const auto percent_of = [](double unit) {
    return unit > 0 ? 100 / unit : std::numeric_limits<double>::quiet_NaN();
  };
  for (const Rgb& unit : units) {
    percent.push_back({percent_of(unit.r), percent_of(unit.g), percent_of(unit.b)});
  }
  PatchValues result;
  for (std::size_t i = 0; i < snapshot.radiosity.size(); ++i) {
    result.values.push_back(percent[i] * (snapshot.radiosity[i] - other->radiosity[i]));
  }
  result.bases = snapshot.bases ? snapshot.bases : other->bases;
  if (result.bases) {
    const auto part_of = [](const SolverSnapshot& one, std::size_t i) {
      return one.linear_terms.empty() ? LinearTerm{} : one.linear_terms[i];
    };
    for (std::size_t i = 0; i < snapshot.radiosity.size(); ++i) {
      const LinearTerm b = part_of(snapshot, i), a = part_of(*other, i);
      result.linear_terms.push_back(
          {percent[i] * (b.first - a.first), percent[i] * (b.second - a.second)});
    }
  }
  return result;
}

/// The radiance is B/pi, the same in all directions.
PatchValues diffuse_radiance(const SolverSnapshot& snapshot) {
  constexpr double fraction = std::numbers::inv_pi;
  PatchValues result{snapshot.radiosity, {}, snapshot.linear_terms, snapshot.bases};
  for (Rgb& value : result.values) {
    value = fraction * value;
  }
  for (LinearTerm& term : result.linear_terms) {
    term = {fraction * term.first, fraction * term.second};
  }
  return result;
}

constexpr QuantityTraits all_traits[] = {
    {.quantity = Quantity::radiosity,
     .name = QT_TRANSLATE_NOOP("Quantity", "Radiosity B"),
     .symbol = "B",
     .unit = "W/m²",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity", "Power per area leaving each patch, current estimate"),
     .section = "2",
     .is_light = true,
     .has_channels = true},
    {.quantity = Quantity::eye_radiance,
     .name = QT_TRANSLATE_NOOP("Quantity", "Radiance toward the eye L"),
     .symbol = "L",
     .unit = "W/(m² sr)",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "Radiance that each patch sends from its center toward the camera: what the camera sees. "
         "A diffuse patch sends B/π in all directions; lobes reflect differently in each"),
     .section = "6.14",
     .is_light = true,
     .has_channels = true,
     .by_eye = true},
    {.quantity = Quantity::exitance,
     .name = QT_TRANSLATE_NOOP("Quantity", "Emitted exitance E"),
     .symbol = "E",
     .unit = "W/m²",
     .meaning = QT_TRANSLATE_NOOP("Quantity", "Power per area emitted by each patch itself"),
     .section = "2",
     .is_light = true,
     .has_channels = true},
    {.quantity = Quantity::reflectance,
     .name = QT_TRANSLATE_NOOP("Quantity", "Reflectance ρ"),
     .symbol = "ρ",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity", "Fraction of the received light that each patch reflects"),
     .section = "2",
     .is_light = true,
     .has_channels = true},
    {.quantity = Quantity::irradiance,
     .name = QT_TRANSLATE_NOOP("Quantity", "Irradiance H"),
     .symbol = "H",
     .unit = "W/m²",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity", "Power per area received by each patch in the last finished iteration"),
     .section = "2",
     .is_light = true,
     .has_channels = true},
    {.quantity = Quantity::form_factor_from,
     .name = QT_TRANSLATE_NOOP("Quantity", "Form factors from selection"),
     .symbol = "F i→j",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity",
                           "Fᵢⱼ from the selected patch i to each patch j: fraction of the light "
                           "leaving i that reaches j"),
     .section = "2",
     .of_selection = true,
     .spans_decades = true},
    {.quantity = Quantity::form_factor_to,
     .name = QT_TRANSLATE_NOOP("Quantity", "Form factors to selection"),
     .symbol = "F j→i",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity",
                           "F_ji from each patch j to the selected patch i: fraction of the light "
                           "leaving j that reaches i"),
     .section = "2",
     .of_selection = true,
     .spans_decades = true},
    {.quantity = Quantity::form_factor_sum,
     .name = QT_TRANSLATE_NOOP("Quantity", "Sum of form factors"),
     .symbol = "Σ F",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity", "Sum over j of Fᵢⱼ for each patch i; 1 in a closed scene"),
     .section = "6.1"},
    {.quantity = Quantity::sky_fraction,
     .name = QT_TRANSLATE_NOOP("Quantity", "Fraction of sky"),
     .symbol = "sky",
     .meaning = QT_TRANSLATE_NOOP("Quantity",
                                  "Fraction of the light leaving each patch that meets no other "
                                  "patch and escapes; where no back sides are seen, 1 − Σ F"),
     .section = "6.8"},
    {.quantity = Quantity::origin,
     .name = QT_TRANSLATE_NOOP("Quantity", "What lights the selection"),
     .symbol = "Bᵢ from j",
     .unit = "W/m²",
     .meaning = QT_TRANSLATE_NOOP("Quantity",
                                  "Fraction of the radiosity of the selected patch i that comes "
                                  "from the emission of each patch "
                                  "j, by all light paths; these, sky and sun sum to Bᵢ"),
     .section = "6.7",
     .has_channels = true,
     .of_selection = true,
     .spans_decades = true,
     .by_response = true},
    {.quantity = Quantity::response,
     .name = QT_TRANSLATE_NOOP("Quantity", "What would light the selection"),
     .symbol = "ΔBᵢ per W",
     .unit = "1/m²",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "Increase of the radiosity of the selected patch i per watt that each patch j would emit, "
         "by all light paths"),
     .section = "6.7",
     .has_channels = true,
     .of_selection = true,
     .spans_decades = true,
     .by_response = true},
    {.quantity = Quantity::fragments,
     .name = QT_TRANSLATE_NOOP("Quantity", "Number of fragments"),
     .symbol = "fragments",
     .meaning = QT_TRANSLATE_NOOP("Quantity", "Number of fragments of each patch in the BSP tree"),
     .section = "4"},
    {.quantity = Quantity::query_time,
     .name = QT_TRANSLATE_NOOP("Quantity", "Time per pass"),
     .symbol = "t",
     .unit = "µs",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "Time of the visibility queries of each patch in one direction, by engine fast on one "
         "thread: faces where it is long make the solve slow"),
     .spans_decades = true,
     .by_costs = true},
    {.quantity = Quantity::exact_queries,
     .name = QT_TRANSLATE_NOOP("Quantity", "Exact queries per pass"),
     .symbol = "exact",
     .meaning = QT_TRANSLATE_NOOP("Quantity",
                                  "Visibility queries of each patch in one direction that engine "
                                  "fast repeated with exact predicates, which are slow"),
     .by_costs = true},
    {.quantity = Quantity::error,
     .name = QT_TRANSLATE_NOOP("Quantity", "Error estimate of B"),
     .symbol = "± B",
     .unit = "W/m²",
     .meaning =
         QT_TRANSLATE_NOOP("Quantity", "Standard error of B, from the spread of the replicas"),
     .section = "6.3",
     .has_channels = true},
    {.quantity = Quantity::measured_error,
     .name = QT_TRANSLATE_NOOP("Quantity", "Measured error of B"),
     .symbol = "error of B",
     .unit = "% of level",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "Error of B by the size of each patch and by the directions, relative to the reflected "
         "light of its surface, as measured in Surfaces, Errors"),
     .section = "6.15",
     .by_measurement = true},
    {.quantity = Quantity::last_change,
     .name = QT_TRANSLATE_NOOP("Quantity", "Change in the last iteration"),
     .symbol = "|Δ B|",
     .unit = "W/m²",
     .meaning = QT_TRANSLATE_NOOP("Quantity", "Absolute change of B since the previous iteration"),
     .section = "6",
     .has_channels = true},
    {.quantity = Quantity::jump,
     .name = QT_TRANSLATE_NOOP("Quantity", "Jump to neighbors"),
     .symbol = "jump",
     .unit = "W/m²",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "Difference between B of each patch and B of its neighbors along its edges (root mean "
         "square; paint and lamps do not count): where it is large, patches are too large"),
     .section = "6.13",
     .by_jumps = true},
    {.quantity = Quantity::difference,
     .name = QT_TRANSLATE_NOOP("Quantity", "Difference from A"),
     .symbol = "B − A",
     .unit = "% of level",
     .meaning = QT_TRANSLATE_NOOP(
         "Quantity",
         "B of the current run, or of the run chosen in Kept runs, minus B of the kept run A, "
         "relative to the level of its surface: the RMS of its reflected light in A, or a "
         "thousandth of the brightest surface's where that is more. Patches that emit, or reflect "
         "nothing, are omitted"),
     .has_channels = true,
     .is_signed = true},
};

}  // namespace

const std::vector<QuantityTraits>& quantity_traits() {
  static const std::vector<QuantityTraits> traits(std::begin(all_traits), std::end(all_traits));
  return traits;
}

const QuantityTraits& traits_of(Quantity quantity) { return at(quantity_traits(), quantity); }

bool follows_selection(Quantity quantity) {
  return traits_of(quantity).of_selection || traits_of(quantity).by_costs;
}

QString tip_of(Quantity quantity) {
  const QuantityTraits& traits = traits_of(quantity);
  return symbol_tip(tr(traits.meaning), traits.section);
}

std::vector<Rgb> last_change(const SolverSnapshot& snapshot) {
  const SolveProgress& progress = snapshot.progress;
  // Between two iterations, this is the change of the one just finished.
  const int before = progress.direction > 0 ? progress.iteration : progress.iteration - 1;
  const auto& kept = snapshot.kept_radiosity;
  if (!has_index(kept, before)) {
    return {};
  }
  const auto& old = at(kept, before);
  if (!old) {
    return {};
  }
  std::vector<Rgb> change;
  change.reserve(snapshot.radiosity.size());
  for (std::size_t i = 0; i < snapshot.radiosity.size(); ++i) {
    const Rgb d = snapshot.radiosity[i] - (*old)[i];
    change.push_back({std::abs(d.r), std::abs(d.g), std::abs(d.b)});
  }
  return change;
}

std::vector<int> fragment_counts(const LoadedScene& loaded) {
  std::vector<int> counts(static_cast<std::size_t>(loaded.scene->patch_count()));
  for (const BspTree::Fragment& fragment : loaded.tree->fragments()) {
    ++at(counts, fragment.patch);
  }
  return counts;
}

PatchValues values_of(Quantity quantity, const SolverSnapshot& snapshot, PatchId selected,
                      const SolverSnapshot* other, const PatchResponse* response) {
  switch (quantity) {
    case Quantity::exitance:
      return {of_materials(snapshot, &Material::exitance), {}};
    case Quantity::reflectance:
      return {of_materials(snapshot, &Material::reflectance), {}};
    case Quantity::irradiance:
      if (snapshot.progress.iteration == 0 && !snapshot.of_file) {
        return {{}, tr("Irradiance is available after the first iteration.")};
      }
      return {snapshot.irradiance, {}};
    case Quantity::form_factor_from:
    case Quantity::form_factor_to:
      return form_factors_of(snapshot, selected, quantity == Quantity::form_factor_from);
    case Quantity::form_factor_sum:
      return {grays(snapshot.form_factor_sums), {}};
    case Quantity::sky_fraction:
      if (snapshot.sky_fractions.empty()) {
        return {{}, tr("The file does not contain the fraction of sky.")};
      }
      return {grays(snapshot.sky_fractions), {}};
    case Quantity::origin:
    case Quantity::response:
      return by_response(quantity, snapshot, selected, response);
    case Quantity::fragments: {
      const std::vector<int> counts = fragment_counts(*snapshot.loaded);
      return {grays({counts.begin(), counts.end()}), {}};
    }
    case Quantity::query_time:
    case Quantity::exact_queries:
      return {{}, tr("Measuring passes…")};
    case Quantity::error:
      if (snapshot.error.replicas == 0) {
        return {{},
                snapshot.options.replicas > 1
                    ? tr("The error estimate is available when every replica has a direction.")
                    : tr("The error estimate needs replicas (solve settings); this solve run has "
                         "none.")};
      }
      return {snapshot.error.standard_error, {}};
    case Quantity::measured_error:
      return {{}, tr("Measure the errors first: panel Surfaces, Errors.")};
    case Quantity::last_change: {
      PatchValues result{last_change(snapshot), {}};
      if (result.values.empty()) {
        result.missing = tr("There is no previous iteration yet.");
      }
      return result;
    }
    case Quantity::jump:
      return {{}, tr("Comparing neighbors…")};
    case Quantity::eye_radiance:
      return snapshot.glossy ? PatchValues{{}, tr("Computing the radiance toward the eye…")}
                             : diffuse_radiance(snapshot);
    case Quantity::difference:
      return difference(snapshot, other);
    case Quantity::radiosity:
      break;
  }
  return {snapshot.radiosity, {}, snapshot.linear_terms, snapshot.bases};
}

std::vector<Rgb> largest_corners(const PatchValues& values, const Scene& scene,
                                 const std::function<double(const Rgb&)>& size) {
  std::vector<Rgb> largest = values.values;
  for (PatchId i = 0; i < std::ssize(values.linear_terms); ++i) {
    const Rgb mean = at(largest, i);
    for (const PointId corner : scene.outline(i)) {
      const Rgb value =
          value_at(mean, at(values.linear_terms, i), at(*values.bases, i), scene.point(corner));
      if (size(value) > size(at(largest, i))) {
        at(largest, i) = value;
      }
    }
  }
  return largest;
}

}  // namespace transillum::viewer
