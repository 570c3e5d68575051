// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <string>

#include "session/error_report.h"

namespace transillum {

/// A step as a phrase: "divide floor: 2,400 patches, 9 s, 6 % to 2 %".
std::string step_text(const NextStep& step);
/// A relative error: "6 %", "0.012 %"; below 1e-6 "0 %".
std::string error_percentage(double error);

/// Checks, before a long computation, that a report can be written to `path`.
/// @throws InputError unless the name ends in .html or .json and can be written
void check_error_report_path(const std::filesystem::path& path);
/// Writes a report: a page for people, without scripts or other files, or JSON (data/FILES.md).
/// @param solve whose errors were measured
/// @throws InputError, std::runtime_error
void write_error_report(const std::filesystem::path& path, const ErrorReport& report,
                        const MeasuredSolve& solve);

}  // namespace transillum
