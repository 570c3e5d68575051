// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QBrush>
#include <QColor>
#include <QPolygonF>
#include <QSizeF>
#include <cstdint>
#include <vector>

#include "map/map_picture.h"
#include "model/requests/recorded_map.h"

class QPainter;

namespace transillum::viewer {

/// The transform that fits the whole scene into a picture of `size` (logical pixels).
MapTransform fit_map(const RecordedMap& map, const QSizeF& size);

/// The height of the strip below the map, with scale bar, legend and axes, in a picture of this
/// height; 0 in a low one (logical pixels).
double scale_bar_room(double height);

/// Fill of back sides: gray with hatching; in vector graphics, plain gray.
inline const QColor plain_back_side{0x43, 0x4a, 0x55};
QBrush back_side_brush(double pixel_ratio);

/// Paints front sides in their patch's color, back sides with back_side_brush(). Any thread.
/// @throws Canceled
MapPicture paint_map(const MapPictureRequest& request, const Cancellation& cancellation = {});

/// Paints the same as vector graphics, on the background that is there, back sides in plain gray.
/// @param request  its pixel ratio is 1
void paint_map(const MapPictureRequest& request, QPainter& painter);

/// Bounds of the step's fragment and of the polygons of V that it cuts, meters; null if there are
/// none.
QRectF step_bounds(const RecordedMap& map, std::int32_t step);

QPolygonF row_polygon(const MapRecord& record, const MapRecord::Row& row,
                      const MapTransform& transform);
/// The row of `rows` that covers `p`, or MapRecord::no_row.
std::int32_t row_at(const MapRecord& record, const std::vector<std::int32_t>& rows, const Vec2& p);

}  // namespace transillum::viewer
