// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Delegate that draws the run of steps below a BSP plane as a bar. Input: a TreeVisit per cell,
// Focus and Selection.
#include "tree/order_bar.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "tree/tree_outline.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

const QColor done_color{0x7f, 0x98, 0xbd}, later_color{0xdc, 0xe1, 0xe8};

}  // namespace

OrderBar::OrderBar(Focus& focus, Selection& selection, QObject* parent)
    : QStyledItemDelegate(parent), focus_(focus), selection_(selection) {}

QRectF OrderBar::bar_in(const QRect& cell) { return QRectF(cell).adjusted(6, 4, -6, -6); }

double OrderBar::left_of(const TreeVisit& visit, const QRectF& bar, std::int32_t step) {
  return bar.left() + bar.width() * (step - visit.begin) / std::max(visit.end - visit.begin, 1);
}

std::int32_t OrderBar::step_at(const TreeVisit& visit, const QRectF& bar, double x) {
  const double fraction = (x - bar.left()) / bar.width();
  const auto step = visit.begin + std::floor(fraction * (visit.end - visit.begin));
  return static_cast<std::int32_t>(std::clamp<double>(step, visit.begin, visit.end - 1));
}

void OrderBar::paint(QPainter* painter, const QStyleOptionViewItem& option,
                     const QModelIndex& index) const {
  QStyledItemDelegate::paint(painter, option, index);
  const auto map = focus_.map();
  const QVariant data = index.data(tree_visit_role);
  if (!data.canConvert<TreeVisit>() || !map) {
    return;
  }
  const auto visit = data.value<TreeVisit>();
  const QRectF bar = bar_in(option.rect);
  const auto part = [&](std::int32_t begin, std::int32_t end, double least_width) {
    const double left = left_of(visit, bar, begin);
    const double width = std::max(left_of(visit, bar, end) - left, least_width);
    return QRectF(std::min(left, bar.right() - width), bar.top(), width, bar.height());
  };
  painter->save();
  painter->setPen(Qt::NoPen);
  const std::int32_t done_end = std::clamp(focus_.position().step + 1, visit.begin, visit.end);
  painter->fillRect(bar, later_color);
  painter->fillRect(part(visit.begin, done_end, 0), done_color);
  if (visit.plane_begin < visit.plane_end) {
    const QRectF in_plane = part(visit.plane_begin, visit.plane_end, 4);
    const bool done = visit.plane_end <= done_end;
    painter->fillRect(in_plane, done ? theme::processed.darker(125) : theme::processed);
  } else {
    painter->fillRect(part(visit.plane_begin, visit.plane_begin, 2), theme::paper);
  }
  if (visit.holds(focus_.position().step)) {
    const QRectF current = part(focus_.position().step, focus_.position().step + 1, 3);
    painter->setBrush(Qt::NoBrush);
    painter->setPen(QPen(theme::ink, 2));
    painter->drawRect(current.adjusted(0, -2, 0, 2));
  }
  // The fragments of the selected patch.
  for (const std::int32_t step : map->history.steps_of(selection_.patch())) {
    if (!visit.holds(step) || map->history.step(step).patch != selection_.patch()) {
      continue;
    }
    QRectF tick = part(step, step + 1, 3);
    tick.moveTop(bar.bottom() + 1);
    tick.setHeight(4);
    painter->fillRect(tick, theme::selection);
  }
  painter->restore();
}

bool OrderBar::editorEvent(QEvent* event, QAbstractItemModel* model,
                           const QStyleOptionViewItem& option, const QModelIndex& index) {
  const bool pressed = event->type() == QEvent::MouseButtonPress;
  if (!pressed && event->type() != QEvent::MouseButtonDblClick) {
    return false;
  }
  const QVariant data = model->data(index, tree_visit_role);
  const auto* mouse = static_cast<QMouseEvent*>(event);
  if (!data.canConvert<TreeVisit>() || mouse->button() != Qt::LeftButton) {
    return false;
  }
  const std::int32_t step = step_at(data.value<TreeVisit>(), bar_in(option.rect), mouse->pos().x());
  if (!pressed) {
    focus_.go_to_step(step);
  } else if (const auto map = focus_.map()) {
    selection_.select(map->history.step(step).patch);
  }
  return true;
}

}  // namespace transillum::viewer
