// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Polygons of V in words: labels on them, and tool tips.
#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>
#include <QString>

#include "model/requests/recorded_map.h"

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

/// A polygon of V in a few lines: the step that made it, and for each corner its coordinates and
/// the patch whose edge carries the edge to the next corner.
/// @param r row of the record
QString row_text(const RecordedMap& map, std::int32_t r);

}  // namespace transillum::viewer
