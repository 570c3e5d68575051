// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/study.h"

namespace transillum::cli {

/// A table for people: RMS errors, slopes, and what 1 % and 0.1 % cost.
std::string study_summary(const Scene& scene, const StudyOptions& options, const Study& study,
                          ErrorMeasure error);

}  // namespace transillum::cli
