// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

/// The transillum library: radiosity of diffuse scenes by the transillumination method.
///
/// A Scene is made from a file or from arrays; solve() computes the radiosity of its patches, or a
/// RadiositySolver does so in observable steps. Below that, a BspTree orders the scene along any
/// direction and a TransferEngine computes what patches exchange along it. Everything else is built
/// on these: visibility maps for display, form factors, relighting, studies of the error.
///
/// Invalid input throws InputError, a solve that fails throws SolveError, a canceled operation
/// throws Canceled. Lengths are in meters, radiosity in W/m². Results do not depend on the number
/// of threads.
namespace transillum {}

// Basics: vectors and colors, checked input, cancellation, errors.
#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/did_you_mean.h"
#include "transillum/division.h"
#include "transillum/errors.h"
#include "transillum/export.h"
#include "transillum/solve_errors.h"
#include "transillum/unit_vector.h"
#include "transillum/vec3.h"

// Scenes: from a file, a generator or arrays to patches.
#include "transillum/coplanar_overlap.h"
#include "transillum/linear_basis.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"
#include "transillum/patch_count.h"
#include "transillum/picking.h"
#include "transillum/scene.h"

// Solving: options, progress, solution, settings for user interfaces.
#include "transillum/accuracy_goal.h"
#include "transillum/adjoint.h"
#include "transillum/first_shot.h"
#include "transillum/form_factor_solve.h"
#include "transillum/function_comparison.h"
#include "transillum/glossy.h"
#include "transillum/light_paths.h"
#include "transillum/option_table.h"
#include "transillum/option_values.h"
#include "transillum/patch_sums.h"
#include "transillum/power_table.h"
#include "transillum/radiosity.h"
#include "transillum/refinement.h"
#include "transillum/relight.h"
#include "transillum/result_comparison.h"
#include "transillum/run_options.h"
#include "transillum/shares.h"
#include "transillum/sky.h"
#include "transillum/solve_session.h"

// Directions and what is proven or measured about them.
#include "transillum/bounds.h"
#include "transillum/directions.h"
#include "transillum/discrepancy.h"

// Visibility along one direction: order, engines, transfers.
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/patch_engine.h"
#include "transillum/transfer_comparison.h"
#include "transillum/transfers.h"

// Visibility maps of one direction, for display.
#include "transillum/corrected_map.h"
#include "transillum/hemicube_image.h"
#include "transillum/map_history.h"
#include "transillum/map_region.h"
#include "transillum/pixel_map.h"
#include "transillum/visibility_map.h"

// Form factors by other methods, for comparison.
#include "transillum/exact_form_factors.h"
#include "transillum/form_factors.h"
#include "transillum/hemicube.h"
#include "transillum/pair_form_factors.h"
#include "transillum/point_sensors.h"
#include "transillum/small_form_factors.h"

// Studies of the error against the number of passes.
#include "transillum/reference_cache.h"
#include "transillum/study.h"
#include "transillum/study_checkpoint.h"

// Files: results, maps, charts, JSON.
#include "transillum/checkpoint.h"
#include "transillum/files.h"
#include "transillum/form_factor_files.h"
#include "transillum/json_text.h"
#include "transillum/line_chart.h"
#include "transillum/map_files.h"
#include "transillum/sensor_files.h"
#include "transillum/shard_files.h"
#include "transillum/study_files.h"
