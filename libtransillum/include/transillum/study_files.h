// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/line_chart.h"
#include "transillum/study.h"

namespace TRANSILLUM_API transillum {

/// Writes columns sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution;
/// the first has the names of the series (names_of()). Points without errors are omitted.
void write_study_csv(std::ostream& out, const std::vector<StudySeries>& series, const Study& study);

/// The horizontal axis of study_chart().
enum class StudyAxis {
  passes,   ///< number of passes
  seconds,  ///< processor time
};
/// Their names (choice.h).
template <>
const Choices& choices_of<StudyAxis>();

/// A chart of the errors, both axes logarithmic. Against passes it shows the bound of eq. 37, has
/// fitted slopes in the legend and omits hemicubes, which make no passes. Series differ in marker,
/// dashes and color. Points without errors, or with an error of 0, are omitted.
/// @param scene name of the scene, for the title.
/// @param series as in StudyOptions::series.
/// @param study the points.
/// @param error which error is shown.
/// @param against the horizontal axis.
/// @param style colors, fonts and line widths.
LineChart study_chart(const std::string& scene, const std::vector<StudySeries>& series,
                      const Study& study, ErrorMeasure error = ErrorMeasure::rms,
                      StudyAxis against = StudyAxis::passes, const ChartStyle& style = {});

}  // namespace TRANSILLUM_API transillum
