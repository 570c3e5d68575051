// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "radiosity/analysis/power_table.h"

namespace transillum::cli {

/// Powers by group or material as text, and the strongest exchanges between them where they are
/// known. Scenes without color get one number per cell, others three.
std::string power_report(const PowerTable& table, PartsBy by);

}  // namespace transillum::cli
