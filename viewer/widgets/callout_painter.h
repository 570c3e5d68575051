// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointF>
#include <QRectF>
#include <QString>
#include <vector>

class QPainter;

namespace transillum::viewer {

/// Draws a text on a plate near `anchor`, within `bounds`, with a line to it.
/// @param taken  plates drawn before, which are avoided where there is room; this one is added
void draw_callout(QPainter& painter, const QPointF& anchor, const QString& text,
                  const QRectF& bounds, std::vector<QRectF>& taken);

}  // namespace transillum::viewer
