// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "io/drawing/line_chart.h"
#include "transillum/choice.h"
#include "transillum/study.h"

namespace transillum {

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

}  // namespace transillum
