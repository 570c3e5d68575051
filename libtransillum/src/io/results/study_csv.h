// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "transillum/study.h"

namespace transillum {

/// Writes columns sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution;
/// the first has the names of the series (names_of()). Points without errors are omitted.
void write_study_csv(std::ostream& out, const std::vector<StudySeries>& series, const Study& study);

}  // namespace transillum
