// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPolygonF>
#include <vector>

class QPainter;

namespace transillum::viewer {

/// Fills convex polygons that share edges, in the color of regions.
void fill_parts(QPainter& painter, const std::vector<QPolygonF>& parts, int alpha);

/// Draws a polygon by the user over the region that it should match, and hatches where they differ.
/// Logical pixels.
/// @param right  convex polygons of the region; empty while it is hidden
void draw_sketch(QPainter& painter, const QPolygonF& outline, const std::vector<QPolygonF>& right);

}  // namespace transillum::viewer
