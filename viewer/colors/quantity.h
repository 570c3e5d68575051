// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

#include "model/snapshot.h"

namespace transillum::viewer {

/// What of its patches a picture shows.
enum class Quantity {
  radiosity,
  exitance,
  reflectance,
  irradiance,
  form_factor_from,
  form_factor_to,
  form_factor_sum,
  fragments,
  error,
  last_change,
  difference
};

/// How a quantity is told and shown.
struct QuantityTraits {
  Quantity quantity;
  const char* name;     ///< in a list of choices
  const char* symbol;   ///< at the color bar
  const char* unit;     ///< or ""
  const char* meaning;  ///< one sentence
  bool is_light;        ///< red, green and blue make a color that can be shown as it is
  bool has_channels;    ///< red, green and blue differ; else all three are the value
  bool is_signed;
  bool of_selection;  ///< changes with the selected patch
};
/// In the order of the enumeration.
const std::vector<QuantityTraits>& quantity_traits();
const QuantityTraits& traits_of(Quantity quantity);

/// A quantity of all patches of a snapshot.
struct PatchValues {
  std::vector<Rgb> values;  ///< one a patch, or empty
  QString missing;          ///< what is to be done where they are empty
};

/// @param selected whose form factors are meant; no_patch for none
/// @param other what a difference is to, may be null
PatchValues values_of(Quantity quantity, const SolverSnapshot& snapshot, PatchId selected,
                      const SolverSnapshot* other);

/// |B - B a step before|, W/m², one a patch; empty where that is not kept.
std::vector<Rgb> last_change(const SolverSnapshot& snapshot);

/// How many fragments the order has cut each patch into.
std::vector<int> fragment_counts(const LoadedScene& loaded);

}  // namespace transillum::viewer
