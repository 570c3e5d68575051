// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "session/error_report.h"

namespace transillum {

/// Factors from the squares of what a division by four finds to the squares of the error before
/// it, calibrated on 20 scenes (decisions/0085-error-report.md). Within a patch: 4/3 where B is
/// linear, 2 along the edge of a shadow.
inline constexpr double within_error = 2.2;
/// The same of means: 16/9 where their error falls as the area, 4 where it falls as the size.
inline constexpr double shift_error = 4;
/// Share of the squared error within a patch that a division leaves: 1/4 where B is linear, 1/2
/// along the edge of a shadow.
inline constexpr double left_within = 0.5;
/// Share of the squared error of means that a division of all patches leaves.
inline constexpr double left_shift = 1.0 / 4;

/// The changes that make the worst surface of a report more accurate, by decreasing
/// NextStep::gain(), with times from the rates of the solve and its measurements.
std::vector<NextStep> next_steps(const ErrorReport& report, const MeasuredSolve& solve);
/// The patches that a step divides, in ascending order; empty if it divides none.
/// @param solve whose errors were measured
std::vector<PatchId> divided_patches(const NextStep& step, const MeasuredSolve& solve);
/// The name by which divided_scene() divides the patches of a step; empty if it divides none.
std::string name_of_division(const NextStep& step, const MeasuredSolve& solve);

}  // namespace transillum
