// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/line_chart.h"
#include "transillum/study.h"

namespace transillum {

// Files of studies; written as all others are (files.h).

/// sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution; the first column
/// has the names of the series. Points without errors are left out.
void write_study_csv(std::ostream& out, const std::vector<StudySeries>& series, const Study& study);
void write_study_csv(const std::filesystem::path& path, const std::vector<StudySeries>& series,
                     const Study& study);

/// What errors are plotted against.
enum class StudyAxis { passes, seconds };
const std::vector<std::string>& study_axis_names();
/// @throws InputError naming the choices.
StudyAxis study_axis_from_name(const std::string& name);

/// The errors, both axes logarithmic; against the passes with the bound of eq. 37 and fitted slopes
/// in the legend, and without hemicubes, which take none; series differ in marker and dashes as
/// well as in color. Points without errors, or with none, are left out.
/// @param scene what the title calls it
LineChart study_chart(const std::string& scene, const std::vector<StudySeries>& series,
                      const Study& study, ErrorMeasure error = ErrorMeasure::rms,
                      StudyAxis against = StudyAxis::passes, const ChartStyle& style = {});

}  // namespace transillum
