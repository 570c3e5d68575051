// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "state/step_events.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/flat_table.h"

namespace transillum::viewer {

/// Events as a table: step, its patch, the event, the patch above, their areas.
class EventTable : public FlatTable {
  Q_OBJECT

 public:
  using FlatTable::FlatTable;
  enum Column { of_step, of_below, of_kind, of_above, of_area, of_parts, of_pair, column_count };

  void set_events(std::vector<StepEvent> events);
  /// Shows the events of this step in bold.
  void set_current_step(std::int32_t step);
  const StepEvent& event(int row) const { return at(events_, row); }
  /// The last row of a step at or before `step`, or -1.
  int row_of_step(std::int32_t step) const;

  QVariant data(const QModelIndex& index, int role) const override;

 private:
  int rows() const override { return static_cast<int>(events_.size()); }
  int columns() const override { return column_count; }
  ColumnHeader header(int column) const override;
  QString text(const StepEvent& event, int column) const;

  std::vector<StepEvent> events_;
  std::int32_t current_step_ = -1;
  ColumnFormat area_format_, pair_format_;
};

}  // namespace transillum::viewer
