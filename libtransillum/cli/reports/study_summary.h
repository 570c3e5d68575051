// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/study.h"

namespace transillum::cli {

/// The study as a text table: errors, slopes, and the passes and time to reach 1 % and 0.1 %.
std::string study_summary(const Scene& scene, const StudyOptions& options, const Study& study,
                          ErrorMeasure error);

}  // namespace transillum::cli
