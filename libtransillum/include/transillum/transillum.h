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
#include "transillum/errors.h"
#include "transillum/export.h"
#include "transillum/vec3.h"

// Scenes: from a file, a generator or arrays to patches.
#include "transillum/linear_basis.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"
#include "transillum/scene.h"
#include "transillum/solids.h"

// Solving: options, progress, solution.
#include "transillum/accuracy_goal.h"
#include "transillum/adjoint.h"
#include "transillum/first_shot.h"
#include "transillum/form_factor_solve.h"
#include "transillum/glossy.h"
#include "transillum/patch_sums.h"
#include "transillum/radiosity_solver.h"
#include "transillum/refinement.h"
#include "transillum/relight.h"
#include "transillum/run_options.h"
#include "transillum/shading.h"
#include "transillum/sky.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"
#include "transillum/sun.h"

// Directions and what is proven or measured about them.
#include "transillum/bounds.h"
#include "transillum/directions.h"

// Visibility along one direction: order, engines, transfers.
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/transfers.h"

// Visibility maps of one direction, for display.
#include "transillum/visibility_map.h"

// Form factors by other methods, for comparison.
#include "transillum/form_factors.h"
#include "transillum/hemicube.h"
#include "transillum/pair_form_factors.h"
#include "transillum/point_sensors.h"

// Studies of the error against the number of passes.
#include "transillum/study.h"

// Pictures that a camera sees.
#include "transillum/picture.h"

// Files: results, checkpoints, form factors, maps, pictures.
#include "transillum/checkpoint.h"
#include "transillum/files.h"
#include "transillum/map_files.h"
