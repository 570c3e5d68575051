// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointF>
#include <QRectF>
#include <QString>

class QPainter;

namespace transillum::viewer {

/// Draws a text on a plate near `anchor`, within `bounds`, with a line to it.
void draw_callout(QPainter& painter, const QPointF& anchor, const QString& text,
                  const QRectF& bounds);

}  // namespace transillum::viewer
