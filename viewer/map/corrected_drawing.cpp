// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Draws a CorrectedMap: whole fragments, the farthest first, by open share or by its error.
#include "map/corrected_drawing.h"

#include <algorithm>
#include <cmath>

#include "map/polygon_label.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double full_color_at = 0.25;
/// Fragments with a smaller open share get no outline and no label.
constexpr double hidden = 1e-6;

QColor between(const QColor& from, const QColor& to, double share) {
  const auto channel = [share](int a, int b) {
    return static_cast<int>(std::lround(a + share * (b - a)));
  };
  return {channel(from.red(), to.red()), channel(from.green(), to.green()),
          channel(from.blue(), to.blue())};
}

double open_share(const CorrectedMap::Part& part) {
  return std::clamp(part.open / part.area, 0.0, 1.0);
}

QPolygonF polygon_of(const CorrectedMap& map, const CorrectedMap::Part& part,
                     const MapTransform& transform) {
  QPolygonF polygon;
  for (const Vec2& p : map.outline(part)) {
    polygon.append(transform.to_pixels(p));
  }
  return polygon;
}

QColor color_of(const CorrectedMap::Part& part, const FragmentColors& colors) {
  if (colors.differences) {
    return color_of_surplus((part.open - part.exact) / part.area);
  }
  const Color8& c = at(colors.of_patches, part.patch);
  return between(theme::scene_background, QColor(c[0], c[1], c[2]), 0.25 + 0.75 * open_share(part));
}

}  // namespace

QColor color_of_surplus(double surplus) {
  const double share = std::min(std::abs(surplus) / full_color_at, 1.0);
  return between(QColor(0xd8, 0xdc, 0xe0), surplus < 0 ? theme::outside : theme::inside, share);
}

void draw_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                    const FragmentColors& colors, const Cancellation& cancellation) {
  painter.save();
  std::vector<QPolygonF> outlines;
  std::size_t done = 0;
  for (const CorrectedMap::Part& part : map.parts) {
    if (done++ % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    const QPolygonF polygon = polygon_of(map, part, transform);
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(Qt::NoPen);
    painter.setBrush(part.front_facing ? colors.back_side : QBrush(color_of(part, colors)));
    painter.drawPolygon(polygon);
    const bool open = !part.front_facing && part.open > hidden * part.area;
    if (open && part.area * transform.scale * transform.scale > 60) {
      outlines.push_back(polygon);
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 150), 1.2 * theme::scale()));
  for (const QPolygonF& polygon : outlines) {
    if (done++ % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    painter.drawPolygon(polygon);
  }
  painter.restore();
}

void label_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                     double pixel_ratio) {
  PolygonLabels labels(painter, pixel_ratio);
  for (const CorrectedMap::Part& part : map.parts) {
    if (part.front_facing || part.open <= hidden * part.area) {
      continue;
    }
    const QString share = QString::number(100 * open_share(part), 'f', 0);
    labels.write(polygon_of(map, part, transform),
                 QObject::tr("%1: %2 %").arg(part.patch).arg(share));
  }
}

}  // namespace transillum::viewer
