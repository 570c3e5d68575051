// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "map/map_picture.h"
#include "state/map_sketch.h"

class QPainter;

namespace transillum::viewer {

/// Fills convex polygons of the plane that share edges, in the color of a region.
void fill_parts(QPainter& painter, const std::vector<std::vector<Vec2>>& parts,
                const MapTransform& shown, int alpha);
/// Draws the answer to a question over the map. Once the program's region is known, what the answer
/// lacks and what it has too much are hatched in two colors.
void draw_sketch(QPainter& painter, const MapSketch& sketch, const MapTransform& shown);

}  // namespace transillum::viewer
