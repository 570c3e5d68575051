// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QBrush>
#include <QPainter>
#include <vector>

#include "colors/color_map.h"
#include "map/map_picture.h"
#include "visibility/fast/corrected_map.h"

namespace transillum::viewer {

/// The color of a relative error, -1 to 1: blue if negative, light gray at zero, orange if
/// positive; saturated from a quarter on.
QColor color_of_surplus(double surplus);

/// Draws whole fragments over one another, the farthest first, then the outlines of those that are
/// partly open. Front sides: with `differences`, color_of_surplus() of the error of the open share;
/// otherwise the patch's color, darker where less is open. Back sides: `back_side`.
/// @throws Canceled
void draw_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                    const std::vector<Color8>& patch_colors, const QBrush& back_side,
                    bool differences, const Cancellation& cancellation);
/// Writes patch number and open share, percent, on fragments with room for it.
void label_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                     double pixel_ratio);

}  // namespace transillum::viewer
