// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <vector>

#include "model/requests/slow_quantities.h"
#include "model/snapshot.h"

namespace transillum::viewer {

/// A quantity of the patches that pictures and tables show.
enum class Quantity {
  radiosity,
  eye_radiance,
  exitance,
  reflectance,
  irradiance,
  form_factor_from,
  form_factor_to,
  form_factor_sum,
  sky_fraction,
  origin,
  response,
  fragments,
  query_time,
  exact_queries,
  error,
  measured_error,
  last_change,
  jump,
  difference
};

/// How a quantity is named and shown.
struct QuantityTraits {
  Quantity quantity;
  const char* name;           ///< in lists of choices
  const char* symbol;         ///< above the color bar
  const char* unit = "";      ///< empty for a number
  const char* meaning;        ///< one sentence
  const char* section = "";   ///< section of ALGORITHM.md; may be empty
  bool is_light = false;      ///< RGB can be shown in true color
  bool has_channels = false;  ///< RGB differ; else all three are equal
  bool is_signed = false;     ///< values can be negative
  bool of_selection = false;  ///< depends on the selected patch
  /// The quantity spans many powers of ten, and 0 means something else than a small value: it is
  /// shown on a logarithmic scale unless the user chooses otherwise, and 0 in zero_color.
  bool spans_decades = false;
  bool by_response = false;     ///< computed from a PatchResponse
  bool by_jumps = false;        ///< computed by find_jumps()
  bool by_costs = false;        ///< computed by measure_costs()
  bool by_measurement = false;  ///< taken from MeasuredErrors
  bool by_eye = false;  ///< depends on the camera; where lobes take part by radiance_toward()
};
/// In the order of the enumeration.
const std::vector<QuantityTraits>& quantity_traits();
const QuantityTraits& traits_of(Quantity quantity);
/// Whether there may be values, or a note, only while a patch is selected.
bool follows_selection(Quantity quantity);
/// The meaning of the quantity and its section, for tool tips.
QString tip_of(Quantity quantity);

/// A quantity of all patches of a snapshot.
struct PatchValues {
  std::vector<Rgb> values;  ///< one per patch, or empty; means where the quantity is linear
  QString missing = {};     ///< the reason for the user if they are empty
  /// The linear terms of the quantity, one per patch; empty if it is constant on patches.
  std::vector<LinearTerm> linear_terms = {};
  /// The bases of linear_terms; null if those are empty.
  std::shared_ptr<const std::vector<LinearBasis>> bases = nullptr;
  bool fitted = false;  ///< the linear terms are of SolverSnapshot::fitted
  QString note = {};    ///< tells the parts of sky and sun that no patch shows; mostly empty
};
/// The value of each patch at the corner where `size` of the value is largest. Without linear
/// parts, these are the values themselves.
std::vector<Rgb> largest_corners(const PatchValues& values, const Scene& scene,
                                 const std::function<double(const Rgb&)>& size);

/// @param selected  patch of the form factors; may be no_patch
/// @param other  snapshot of the same patches to subtract for Quantity::difference; may be null
/// @param response  of the selected patch, for by_response quantities; null while it is being
/// solved
PatchValues values_of(Quantity quantity, const SolverSnapshot& snapshot, PatchId selected,
                      const SolverSnapshot* other, const PatchResponse* response = nullptr);

/// |B - B(n)| with the B(n) before the newest iteration, W/m², one per patch; empty if B(n) was not
/// stored.
std::vector<Rgb> last_change(const SolverSnapshot& snapshot);

/// The number of fragments of each patch in the BSP tree.
std::vector<int> fragment_counts(const LoadedScene& loaded);

}  // namespace transillum::viewer
