// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What stands below a visibility map: scale bar, legend and axes. Sizes are of the whole picture,
// logical pixels; a low picture has no room below the map, and all stands beside it.
#pragma once

#include <QPointF>
#include <QSizeF>
#include <QString>

#include "map/map_picture.h"

class QPainter;

namespace transillum::viewer {

/// Where the axes begin, and where omega leaves the plane.
QPointF axes_origin(const QSizeF& size);
/// @param scale pixels per meter
void draw_scale_bar(QPainter& painter, const QSizeF& size, double scale);
void draw_axes(QPainter& painter, const QSizeF& size);
/// Names the fills of the picture that `shown` determines.
void draw_legend(QPainter& painter, const QSizeF& size, const MapPictureRequest& shown);

/// A text before a dark plate: it may cover the map.
void draw_on_plate(QPainter& painter, const QPointF& baseline, const QString& text);

}  // namespace transillum::viewer
