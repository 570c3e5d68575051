// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/map_sheet.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "map/map_painter.h"
#include "support/number_text.h"

namespace transillum::viewer {

QPointF axes_origin(const QSizeF& size) { return {size.width() - 26, size.height() - 11}; }

void MapSheet::draw_text(const QPointF& baseline, const QString& text) const {
  painter.fillRect(painter.fontMetrics()
                       .boundingRect(text)
                       .adjusted(-3, -1, 3, 1)
                       .translated(baseline.toPoint()),
                   plate);
  painter.drawText(baseline, text);
}

void MapSheet::draw_caption(const QString& text) const {
  if (!text.isEmpty()) {
    painter.setPen(ink);
    draw_text(QPointF(12, 8 + painter.fontMetrics().ascent()), text);
  }
}

void MapSheet::draw_scale_bar(double scale) const {
  // The largest length of 1, 2 or 5 times a power of ten within a quarter of the width.
  const double max_meters = size.width() / 4.0 / scale;
  const double power = std::pow(10.0, std::floor(std::log10(max_meters)));
  const double lead = max_meters / power;
  const double meters = power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
  const double length = meters * scale;
  const QPointF left(14, size.height() - 14);
  painter.setPen(QPen(ink, 1.5));
  painter.drawLine(left, left + QPointF(length, 0));
  painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
  painter.drawLine(left + QPointF(length, -4), left + QPointF(length, 4));
  draw_text(left + QPointF(length + 8, 4), number_text(meters) + tr(" m"));
}

void MapSheet::draw_axes() const {
  const QPointF origin = axes_origin(size);
  constexpr double length = 20, radius = 4.5;
  painter.setPen(QPen(ink, 1.5));
  const auto arrow = [&](const QPointF& axis, const QString& name, const QPointF& name_offset) {
    const QPointF tip = origin + length * axis;
    const QPointF across(-axis.y(), axis.x());
    painter.drawLine(origin + radius * axis, tip);
    painter.drawLine(tip, tip - 5 * axis + 3 * across);
    painter.drawLine(tip, tip - 5 * axis - 3 * across);
    painter.drawText(tip + name_offset, name);
  };
  arrow({-1, 0}, QStringLiteral("u"), {-12, 4});
  arrow({0, -1}, QStringLiteral("v"), {-14, 7});
  // An arrow seen from its end: omega points away from the viewer.
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(origin, radius, radius);
  const double half = radius / std::sqrt(2.0);
  painter.drawLine(origin - QPointF(half, half), origin + QPointF(half, half));
  painter.drawLine(origin - QPointF(half, -half), origin + QPointF(half, -half));
  painter.drawText(origin + QPointF(7, 4), QStringLiteral("ω"));
}

void MapSheet::draw_legend(const MapPictureRequest& request, const QBrush& back_sides) const {
  if (size.width() < 330) {
    return;  // no room between scale bar and axes
  }
  std::vector<std::pair<QBrush, QString>> entries;
  if (request.extent == MapExtent::step) {
    entries.emplace_back(back_sides, tr("back side"));
  }
  const MapEngineChoice& choice = request.choice;
  if (choice.shows(EngineTraits::Picture::corrected) && choice.differences) {
    entries.emplace_back(theme::inside, tr("too much"));
    entries.emplace_back(theme::outside, tr("too little"));
  } else if (choice.engine && choice.differences) {
    entries.emplace_back(theme::difference, tr("differs"));
  }
  constexpr double box_width = 16, gap = 8, axes = 64;
  const auto width_of = [&](const QString& text) {
    return box_width + 2 * gap + painter.fontMetrics().horizontalAdvance(text);
  };
  double total = 0;
  for (const auto& [brush, text] : entries) {
    total += width_of(text);
  }
  // The legend is between the scale bar with its text and the axes; without room, back sides are
  // omitted.
  const double left = size.width() / 4.0 + 80, right = size.width() - axes;
  if (entries.size() > 1 && left + total > right) {
    total -= width_of(entries.front().second);
    entries.erase(entries.begin());
  }
  // In a low map that leaves its sides free, the entries are one above the other at the left.
  constexpr int low = 140, row = 20, side = 130;
  const auto scale_in = [&](double room) {
    return fit_map(*request.map, QSizeF(room, size.height())).scale;
  };
  const bool stacked =
      size.height() < low && scale_in(size.width() - 2 * side) == scale_in(size.width());
  double x = stacked ? 12 : std::min(std::max(size.width() / 2.0 - 8, left), right - total);
  double y = size.height() - 23 - (stacked ? row : 0);
  for (const auto& [brush, text] : entries) {
    const QRectF box(x, y, box_width, 12);
    painter.setPen(QPen(dim, 1));
    painter.setBrush(brush);
    painter.drawRect(box);
    painter.setPen(ink);
    draw_text(box.bottomRight() + QPointF(gap, -1), text);
    x += stacked ? 0 : width_of(text);
    y -= stacked ? row : 0;
  }
}

}  // namespace transillum::viewer
