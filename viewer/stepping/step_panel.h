// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "state/focus.h"
#include "state/selection.h"

class QLabel;
class QTabWidget;
class QTableView;

namespace transillum::viewer {

class EventFilterRow;
class EventTable;

/// Tables of events: of the current step, of the selected patch, and along one line parallel to
/// omega.
class StepPanel : public QWidget {
  Q_OBJECT

 public:
  StepPanel(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  EventFilterRow* filter() const { return filter_; }

 private:
  /// One tab: a table with a line of text above it.
  struct Tab {
    EventTable* table;
    QTableView* view;
    QLabel* text;
  };
  Tab add_tab(const QString& title, const char* name);
  void show_events();
  void show_step_tab();
  void show_patch_tab();
  void show_line_tab();
  /// Lists the events that pass the filter, below `text`, which says whether events are hidden.
  void list(const Tab& tab, const QString& text, std::vector<StepEvent> events);

  Focus& focus_;
  Selection& selection_;
  QTabWidget* tabs_;
  Tab step_, patch_, line_;
  EventFilterRow* filter_;
  std::shared_ptr<const RecordedMap> listed_map_;  ///< listed in patch_
  PatchId listed_patch_ = no_patch;
};

}  // namespace transillum::viewer
