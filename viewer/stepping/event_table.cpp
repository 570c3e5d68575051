// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Table model of step events (state/step_events.h), with bold rows for the current step.
#include "stepping/event_table.h"

#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "widgets/theme.h"

namespace transillum::viewer {

void EventTable::set_events(std::vector<StepEvent> events) {
  if (events == events_) {
    return;  // a reset between its two clicks would lose a double-click
  }
  beginResetModel();
  events_ = std::move(events);
  double area = 0, pair_area = 0;
  for (const StepEvent& event : events_) {
    area = std::max(area, event.area);
    pair_area = std::max(pair_area, event.pair_area);
  }
  area_format_ = ColumnFormat(area);
  pair_format_ = ColumnFormat(pair_area);
  endResetModel();
}

void EventTable::set_current_step(std::int32_t step) {
  if (step == current_step_) {
    return;
  }
  current_step_ = step;
  if (!events_.empty()) {
    emit dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1), {Qt::FontRole});
  }
}

int EventTable::row_of_step(std::int32_t step) const {
  int row = -1;
  for (int k = 0; k < rowCount() && event(k).step <= step; ++k) {
    row = k;
  }
  return row;
}

QString EventTable::text(const StepEvent& event, int column) const {
  switch (column) {
    case of_step:
      return QString::number(event.step + 1);
    case of_below:
      return QString::number(event.below);
    case of_kind:
      return text_of(event.kind);
    case of_above:
      return event.above == no_patch ? QString() : QString::number(event.above);
    case of_area:
      return event.kind == StepEvent::Kind::edge_on ? QString() : area_format_.text(event.area);
    case of_parts:
      return event.above == no_patch ? QString() : QString::number(event.parts);
    default:
      return event.kind == StepEvent::Kind::exchange ? pair_format_.text(event.pair_area)
                                                     : QString();
  }
}

QVariant EventTable::data(const QModelIndex& index, int role) const {
  const StepEvent& event = this->event(index.row());
  switch (role) {
    case Qt::DisplayRole:
      return text(event, index.column());
    case Qt::TextAlignmentRole:
      return QVariant(index.column() == of_kind ? Qt::AlignLeft | Qt::AlignVCenter
                                                : Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ForegroundRole:
      return event.kind == StepEvent::Kind::exchange ? QVariant(theme::exchange_ink) : QVariant();
    case Qt::FontRole:
      return font_cell(event.step == current_step_);
    case Qt::ToolTipRole:
      return index.column() == of_area && event.kind != StepEvent::Kind::edge_on
                 ? QVariant(number_text(event.area))
             : index.column() == of_pair && event.kind == StepEvent::Kind::exchange
                 ? QVariant(number_text(event.pair_area))
                 : QVariant();
    default:
      return {};
  }
}

ColumnHeader EventTable::header(int column) const {
  switch (column) {
    case of_step:
      return {tr("Step")};
    case of_below:
    case of_above:
      return {tr("Patch")};
    case of_kind:
      return {};
    case of_area:
      return {area_format_.header(tr("Area, m²")),
              tr("On the transillumination plane: of the fragment, or of what it covers of the "
                 "patch above")};
    case of_parts:
      return {tr("Pieces left"), tr("Number of parts of the cut polygon that remain in V")};
    default:
      return {pair_format_.header(tr("Pair, m²")),
              tr("Area over which the two patches exchange light along this direction")};
  }
}

}  // namespace transillum::viewer
