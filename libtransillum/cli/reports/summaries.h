// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Results as text for people.

#include <string>
#include <vector>

#include "radiosity/analysis/power_table.h"
#include "session/error_report.h"
#include "transillum/solution.h"
#include "transillum/study.h"

namespace transillum::cli {

/// A short table of a solve.
std::string solve_summary(const Solution& solution);
/// The errors of the worst surface by cause, their total and the cheapest next step.
/// @param total how a solve to a total error ended; empty for others
std::string error_summary(const ErrorReport& report, const std::string& total);
/// Warnings about a result that is not an error, such as too few directions.
std::vector<std::string> solve_warnings(const Solution& solution);

/// Powers by group or material, and the strongest exchanges between them where they are known.
/// Scenes without color get one number per cell, others three.
std::string power_report(const PowerTable& table, SurfaceKind by);

/// A table of a study: errors, slopes, and the passes and time to reach 1 % and 0.1 %.
std::string study_summary(const Scene& scene, const StudyOptions& options, const Study& study,
                          ErrorMeasure error);

}  // namespace transillum::cli
