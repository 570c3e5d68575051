// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>

namespace transillum::viewer {

/// Writes labels on the polygons that have room for them.
class PolygonLabels {
 public:
  /// Keeps a reference to `painter` and changes its font. `pixel_ratio`: device per logical pixels.
  PolygonLabels(QPainter& painter, double pixel_ratio);

  void write(const QPolygonF& polygon, const QString& text);

 private:
  QPainter& painter_;
  double ratio_;
  QFontMetricsF metrics_;
};

}  // namespace transillum::viewer
