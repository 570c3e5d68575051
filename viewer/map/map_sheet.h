// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QBrush>
#include <QColor>
#include <QCoreApplication>
#include <QPointF>
#include <QSizeF>
#include <QString>

#include "map/map_picture.h"
#include "widgets/theme.h"

class QPainter;

namespace transillum::viewer {

/// Where the axes begin, and where omega leaves the plane, in a picture of this size (logical
/// pixels).
QPointF axes_origin(const QSizeF& size);

/// Draws what explains a picture of a map, over it: scale bar, axes, legend, caption.
/// A low picture has no room below the map, and all stands beside it.
struct MapSheet {
  Q_DECLARE_TR_FUNCTIONS(MapSheet)

 public:
  QPainter& painter;
  QSizeF size;  ///< size of the picture, logical pixels
  QColor ink = theme::on_dark;
  QColor dim = theme::on_dark_dim;
  QColor plate{29, 33, 39, 178};  ///< behind texts, which may cover the map

  void draw_text(const QPointF& baseline, const QString& text) const;
  /// At the top left.
  void draw_caption(const QString& text) const;
  /// At the bottom left.
  /// @param scale  pixels per meter
  void draw_scale_bar(double scale) const;
  /// The axes u and v, and omega away from the viewer, at the bottom right.
  void draw_axes() const;
  /// The meaning of hatching and colors, between scale bar and axes; omitted where there is no
  /// room.
  void draw_legend(const MapPictureRequest& request, const QBrush& back_sides) const;
};

}  // namespace transillum::viewer
