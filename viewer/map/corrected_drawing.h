// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QBrush>
#include <QPainter>
#include <vector>

#include "colors/color_map.h"
#include "map/map_picture.h"
#include "transillum/corrected_map.h"

namespace transillum::viewer {

/// How much more (or less) of something an engine takes as open than there is, -1 to 1, as a
/// color: blue for less, light gray for right, orange for more; full from a quarter on.
QColor color_of_surplus(double surplus);

/// Draws whole fragments over one another, the farthest first, and all their outlines. Lit sides:
/// with `differences` by color_of_surplus() of the share taken as open, else in their patch's
/// color, the darker the less of them counts as open; back sides by `back_side`.
/// @throws Canceled
void draw_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                    const std::vector<Color8>& patch_colors, const QBrush& back_side,
                    bool differences, const Cancellation& cancellation);
/// Writes the share that counts as open on what has room for it.
void label_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                     double pixel_ratio);

}  // namespace transillum::viewer
