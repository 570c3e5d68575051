// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

#include "model/requests/recorded_map.h"

namespace transillum::viewer {

/// A polygon of V in a few lines: the step that made it, and for each corner its coordinates and
/// the patch whose edge carries the edge to the next corner.
/// @param r row of the record
QString row_text(const RecordedMap& map, std::int32_t r);

}  // namespace transillum::viewer
