// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/polygon_text.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QFont small_font(const QPainter& painter, double pixel_ratio) {
  QFont font = painter.font();
  font.setPixelSize(static_cast<int>(std::lround(11 * pixel_ratio * theme::scale())));
  return font;
}

}  // namespace

PolygonLabels::PolygonLabels(QPainter& painter, double pixel_ratio)
    : painter_(painter), ratio_(pixel_ratio), metrics_(small_font(painter, pixel_ratio)) {
  painter_.setFont(small_font(painter, pixel_ratio));
}

void PolygonLabels::write(const QPolygonF& polygon, const QString& text) {
  const QRectF box = polygon.boundingRect();
  const QSizeF size(metrics_.horizontalAdvance(text) + 4 * ratio_, metrics_.height());
  // At half its height, a triangle is half as wide as its bounding box.
  if (box.width() < 1.6 * size.width() || box.height() < 1.6 * size.height()) {
    return;
  }
  QPointF middle;
  for (const QPointF& p : polygon) {
    middle += p / polygon.size();
  }
  const QRectF place(middle - QPointF(size.width(), size.height()) / 2, size);
  painter_.setPen(Qt::NoPen);
  painter_.setBrush(QColor(0, 0, 0, 150));
  painter_.drawRoundedRect(place, 2 * ratio_, 2 * ratio_);
  painter_.setPen(theme::on_dark);
  painter_.drawText(place, Qt::AlignCenter, text);
}

namespace {

constexpr std::size_t most_corners = 16;  ///< listed

QString tr(const char* text) { return QCoreApplication::translate("RowText", text); }

QString step_text(std::int32_t step) { return count_text(std::int64_t{step} + 1); }

/// Whether the patch has an edge on the line; otherwise a cut of the tree made the edge.
bool is_of_outline(const Scene& scene, PatchId patch, const BspTree::Line& line) {
  const auto outline = scene.outline(patch);
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
    if (std::minmax(a, b) == std::minmax(line.a, line.b)) {
      return true;
    }
  }
  return false;
}

QString edge_text(const RecordedMap& map, std::int32_t origin, LineId line) {
  const MapRecord::Row& whole = map.row(origin);
  const QString text =
      tr("patch %1, step %2").arg(QString::number(whole.patch), step_text(whole.made));
  return is_of_outline(*map.loaded->scene, whole.patch, at(map.loaded->tree->lines(), line))
             ? text
             : tr("%1 (a cut of the tree)").arg(text);
}

}  // namespace

QString row_text(const RecordedMap& map, std::int32_t r) {
  const MapRecord::Row& row = map.row(r);
  QStringList lines;
  lines << (row.parent == MapRecord::no_row
                ? tr("Whole fragment, inserted by step %1").arg(step_text(row.made))
                : tr("Cut by step %1 (patch %2) from the fragment of step %3")
                      .arg(step_text(row.made), QString::number(map.history.cut_by(r)),
                           step_text(map.row(map.history.whole_of(r)).made)));
  lines << tr("Corner u, v in m, and the patch whose edge leads to the next:");
  const auto outline = map.record().outline(row);
  const auto edges = map.record().edge_lines(row);
  const auto origins = map.history.edge_origins(r);
  for (std::size_t k = 0; k < std::min(outline.size(), most_corners); ++k) {
    lines << QStringLiteral("%1:  %2, %3;  %4")
                 .arg(k + 1)
                 .arg(number_text(outline[k].x), number_text(outline[k].y),
                      edge_text(map, origins[k], edges[k]));
  }
  if (outline.size() > most_corners) {
    lines << tr("and %1 more").arg(outline.size() - most_corners);
  }
  return lines.join(QLatin1Char('\n'));
}

}  // namespace transillum::viewer
