// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>

#include "session/error_report.h"
#include "transillum/cancellation.h"
#include "transillum/solve_session.h"

namespace transillum {

/// Checks that the errors of a solve can be measured.
/// @throws InputError where lobes take part, or with a scheme that renews directions
void check_measurable(const SolveOptions& options, bool lobes_take_part);
/// The solve of a finished session.
/// @throws InputError as check_measurable()
MeasuredSolve measured_solve(const SolveSession& session);

/// A measurement under way.
enum class Measurement { replicas, divided, engines };
using MeasurementObserver = std::function<void(Measurement, double fraction)>;

/// Measures the errors of a solve. Time: mostly the time of a solve with every patch divided, by
/// the same directions, which is about five times the time of the solve itself. Where so many
/// patches do not fit into memory or exceed `most_patches`, a sample of each surface is divided.
/// @param solve the solve.
/// @param cancellation checked throughout.
/// @param observer called on any thread, one at a time.
/// @param most_patches of the scene with divided patches.
/// @throws Canceled, InputError; exceptions of solve()
ErrorReport measure_errors(const MeasuredSolve& solve, const Cancellation& cancellation = {},
                           const MeasurementObserver& observer = {},
                           std::int64_t most_patches = 2'000'000);

}  // namespace transillum
