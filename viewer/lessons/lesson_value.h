// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "transillum/material_changes.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum::viewer {

class JsonObject;
struct ViewState;

/// The kind of a value; `i` is LessonValue::patch, `j` one of LessonValue::others. Areas are in m²,
/// on the transillumination plane of LessonValue::direction unless stated otherwise.
enum class LessonValueKind {
  constant,          ///< LessonValue::number
  patches,           ///< number of patches
  fragments,         ///< number of fragments of the BSP tree
  directions,        ///< number of directions used: M or 2M
  iterations,        ///< number of iterations of the solve
  contraction,       ///< factor between the changes of its last two iterations
  steps,             ///< number of steps of the direction
  polygons,          ///< largest number of polygons of V along the direction
  area,              ///< area of patch i itself
  exitance,          ///< for patch i: luminance, W/m²
  reflectance,       ///< for patch i: luminance
  radiosity,         ///< for patch i: luminance, W/m²
  irradiance,        ///< for patch i: luminance, W/m²
  radiance,          ///< for patch i toward LessonValue::eye: luminance, W/(m² sr)
  jump,              ///< for patch i: radiosity_jumps(), W/m²
  projected_area,    ///< for patch i
  visible_area,      ///< A(i, j, omega), summed over others: patches above i, front or back
  seen,              ///< number of patches j with a visible area, for patch i
  above,             ///< number of patches directly above one of LessonValue::others
  form_factor,       ///< F_ij, summed over others
  form_factor_sum,   ///< for patch i
  function_error,    ///< L2 error of B as a function, over L2 of B, without sources, against linear
                     ///< functions on patches of at most LessonValue::reference_area
  rms_error,         ///< RMS error of B against LessonValue::reference passes, over RMS of B
  estimated_error,   ///< ErrorEstimate::rms
  largest_error,     ///< ErrorEstimate::rms_limit
  light_directions,  ///< SolveStatistics::light_directions per replica
  covered,  ///< fraction of all B, of patches that do not emit, whose 95 % interval contains the
            ///< reference
  ratio     ///< ratio of the two values of LessonValue::of
};

/// A number that the program computes for a page of a lesson, as its file names it.
struct LessonValue {
  LessonValueKind kind = LessonValueKind::constant;
  double number = 0;            ///< the value of a constant
  PatchId patch = no_patch;     ///< i; each patch in turn if it is no_patch
  std::vector<PatchId> others;  ///< j; if there are none, each patch in turn or all together
  bool all = false;             ///< j: all patches together
  std::string material;         ///< for `above`: count only patches of this material
  int iteration = 0;            ///< iteration of the direction, from 0
  int direction = 0;            ///< from 0
  int reference = 0;            ///< passes of the reference of rms_error
  double patch_area = 0;        ///< for function_error: SceneOptions::max_patch_area, m²
  double reference_area = 0;    ///< for function_error: max_patch_area of the reference, m²
  Vec3 eye;                     ///< eye of a radiance, m
  std::vector<MaterialChange> changes;  ///< for a radiance: changes of the scene's materials
  SolveOptions solve;                   ///< the run of the page, with the value's own changes
  std::vector<LessonValue> of;          ///< the two values of a ratio
};

/// Reads a number, or an object with the key `figure`.
/// @param page_options  the JSON of the page's `options`
/// @param page  the page's state
/// @throws InputError that begins with `where`
LessonValue lesson_value_from_json(const nlohmann::json& value, const std::string& where,
                                   const nlohmann::json& page_options, const ViewState& page);
/// The options of the page's run, changed by the key `with` of an object.
/// @throws InputError
SolveOptions run_from_json(JsonObject& object, const nlohmann::json& page_options,
                           const ViewState& page);
/// Whether it is measured along one direction.
bool is_of_direction(LessonValueKind kind);
/// Whether the value has one value for each patch, not one for the scene: the file omits the
/// patch.
bool is_per_patch(const LessonValue& wanted);
/// Whether the value is computed: true for all but constants.
bool is_computed(const LessonValue& wanted);
/// The names of all values in files.
std::vector<std::string> lesson_value_names();

}  // namespace transillum::viewer
