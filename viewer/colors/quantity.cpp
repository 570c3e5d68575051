// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/quantity.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "model/form_factor_views.h"
#include "transillum/at.h"

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

PatchValues difference(const SolverSnapshot& snapshot, const SolverSnapshot* other) {
  if (!other) {
    return {{}, tr("Keep a run first, to compare others with it (Compare).")};
  }
  if (other->radiosity.size() != snapshot.radiosity.size()) {
    return {{}, tr("The kept run has other patches: there is no difference to show.")};
  }
  PatchValues result;
  for (std::size_t i = 0; i < snapshot.radiosity.size(); ++i) {
    result.values.push_back(snapshot.radiosity[i] - other->radiosity[i]);
  }
  return result;
}

}  // namespace

const std::vector<QuantityTraits>& quantity_traits() {
  static const std::vector<QuantityTraits> traits{
      {Quantity::radiosity, QT_TRANSLATE_NOOP("Quantity", "Radiosity B"), "B", "W/m²",
       QT_TRANSLATE_NOOP("Quantity", "What leaves each patch, as estimated so far"), true, true,
       false, false},
      {Quantity::exitance, QT_TRANSLATE_NOOP("Quantity", "Emitted exitance E"), "E", "W/m²",
       QT_TRANSLATE_NOOP("Quantity", "What each patch emits by itself"), true, true, false, false},
      {Quantity::reflectance, QT_TRANSLATE_NOOP("Quantity", "Reflectance ρ"), "ρ", "",
       QT_TRANSLATE_NOOP("Quantity", "The share of light that each patch sends back"), true, true,
       false, false},
      {Quantity::irradiance, QT_TRANSLATE_NOOP("Quantity", "Irradiance H"), "H", "W/m²",
       QT_TRANSLATE_NOOP("Quantity", "What reaches each patch, in the last finished iteration"),
       true, true, false, false},
      {Quantity::form_factor_from, QT_TRANSLATE_NOOP("Quantity", "Seen by the selected patch"),
       "F i→j", "",
       QT_TRANSLATE_NOOP("Quantity",
                         "F_ij from the selected patch i to each patch j: how much of what i can "
                         "see is j"),
       false, false, false, true},
      {Quantity::form_factor_to, QT_TRANSLATE_NOOP("Quantity", "Seeing the selected patch"),
       "F j→i", "",
       QT_TRANSLATE_NOOP("Quantity",
                         "F_ji from each patch j to the selected patch i: how much of what j can "
                         "see is i"),
       false, false, false, true},
      {Quantity::form_factor_sum, QT_TRANSLATE_NOOP("Quantity", "Sum of form factors"), "Σ F", "",
       QT_TRANSLATE_NOOP("Quantity",
                         "How much of what each patch can see is patches; near 1 where enclosed"),
       false, false, false, false},
      {Quantity::fragments, QT_TRANSLATE_NOOP("Quantity", "Number of fragments"), "fragments", "",
       QT_TRANSLATE_NOOP("Quantity", "How many parts the BSP tree has cut each patch into"), false,
       false, false, false},
      {Quantity::error, QT_TRANSLATE_NOOP("Quantity", "Error estimate of B"), "± B", "W/m²",
       QT_TRANSLATE_NOOP("Quantity", "Standard error of B, from the spread of the replicas"), false,
       true, false, false},
      {Quantity::last_change, QT_TRANSLATE_NOOP("Quantity", "Change in the last iteration"),
       "|Δ B|", "W/m²",
       QT_TRANSLATE_NOOP("Quantity", "How much B differs from the iteration before"), false, true,
       false, false},
      {Quantity::difference, QT_TRANSLATE_NOOP("Quantity", "Difference to the kept run"), "B − A",
       "W/m²", QT_TRANSLATE_NOOP("Quantity", "B less that of the kept run"), false, true, true,
       false},
  };
  return traits;
}

const QuantityTraits& traits_of(Quantity quantity) { return at(quantity_traits(), quantity); }

std::vector<Rgb> last_change(const SolverSnapshot& snapshot) {
  const SolveProgress& progress = snapshot.progress;
  // Between two iterations, the change is that of the one just finished.
  const int before = progress.direction > 0 ? progress.iteration : progress.iteration - 1;
  const auto& kept = snapshot.kept_radiosity;
  if (before < 0 || static_cast<std::size_t>(before) >= kept.size()) {
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
                      const SolverSnapshot* other) {
  switch (quantity) {
    case Quantity::exitance:
      return {of_materials(snapshot, &Material::exitance), {}};
    case Quantity::reflectance:
      return {of_materials(snapshot, &Material::reflectance), {}};
    case Quantity::irradiance:
      if (snapshot.progress.iteration == 0 && !snapshot.of_file) {
        return {{}, tr("There is an irradiance when the first iteration is done.")};
      }
      return {snapshot.irradiance, {}};
    case Quantity::form_factor_from:
    case Quantity::form_factor_to:
      return form_factors_of(snapshot, selected, quantity == Quantity::form_factor_from);
    case Quantity::form_factor_sum:
      return {grays(snapshot.form_factor_sums), {}};
    case Quantity::fragments: {
      const std::vector<int> counts = fragment_counts(*snapshot.loaded);
      return {grays({counts.begin(), counts.end()}), {}};
    }
    case Quantity::error:
      if (snapshot.error.replicas == 0) {
        return {{},
                snapshot.options.replicas > 1
                    ? tr("The error estimate is there when every replica has had a direction.")
                    : tr("The error of B is estimated from the spread of replicas, and this solve "
                         "has none.")};
      }
      return {snapshot.error.standard_error, {}};
    case Quantity::last_change: {
      PatchValues result{last_change(snapshot), {}};
      if (result.values.empty()) {
        result.missing = tr("Nothing has changed yet.");
      }
      return result;
    }
    case Quantity::difference:
      return difference(snapshot, other);
    case Quantity::radiosity:
      break;
  }
  return {snapshot.radiosity, {}};
}

}  // namespace transillum::viewer
