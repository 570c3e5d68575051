// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel with three event tables: of the current step, of the selected patch, and along the
// probed line. Events come from the map in Focus.
#include "stepping/step_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QTabWidget>
#include <QTableView>
#include <algorithm>
#include <utility>

#include "stepping/event_filter_row.h"
#include "stepping/event_table.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

StepPanel::StepPanel(Focus& focus, Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), tabs_(new QTabWidget) {
  tabs_->setObjectName("event_tabs");
  tabs_->setDocumentMode(true);
  step_ = add_tab(tr("This step"), "step_events");
  patch_ = add_tab(tr("Selected patch"), "patch_events");
  line_ = add_tab(tr("Line"), "line_events");
  step_.view->setColumnHidden(EventTable::of_step, true);
  for (const Tab& tab : {step_, patch_}) {
    tab.view->setColumnHidden(EventTable::of_pair, true);
  }
  line_.view->setColumnHidden(EventTable::of_parts, true);
  auto* layout = make_column(this, {}, 2);
  layout->addWidget(tabs_);
  filter_ = new EventFilterRow(focus_);
  layout->addWidget(filter_);
  connect(tabs_, &QTabWidget::currentChanged, this, &StepPanel::show_events);
  connect(&focus_, &Focus::moved, this, &StepPanel::show_events);
  connect(&focus_, &Focus::probed, this, [this] {
    if (focus_.probe()) {
      tabs_->setCurrentIndex(2);
    }
    show_events();
  });
  connect(&selection_, &Selection::changed, this, &StepPanel::show_events);
  connect(&focus_, &Focus::filtered, this, [this] {
    listed_map_ = nullptr;
    show_events();
  });
  show_events();
}

StepPanel::Tab StepPanel::add_tab(const QString& title, const char* name) {
  Tab tab{new EventTable(this), new QTableView, new QLabel};
  tab.text->setWordWrap(true);
  tab.text->setContentsMargins(10, 2, 10, 2);
  tab.text->setForegroundRole(QPalette::PlaceholderText);
  tab.view->setObjectName(QString::fromLatin1(name));
  tab.view->setModel(tab.table);
  tab.view->setSelectionBehavior(QAbstractItemView::SelectRows);
  QHeaderView* header = tab.view->horizontalHeader();
  header->setSectionResizeMode(QHeaderView::Interactive);
  header->setSectionResizeMode(EventTable::of_kind, QHeaderView::Stretch);
  set_up_value_table(*tab.view, {"88888", "88888", "", "88888", "0.008888", "8", "0.008888"});
  constexpr int header_and_row = 46;
  tab.view->setMinimumHeight(header_and_row);

  auto* page = new QWidget;
  auto* layout = make_column(page, {}, 0);
  layout->addWidget(tab.text);
  layout->addWidget(tab.view, 1);
  tabs_->addTab(page, title);
  connect(tab.view, &QTableView::clicked, this, [this, tab](const QModelIndex& index) {
    const StepEvent event = tab.table->event(index.row());
    selection_.select(index.column() == EventTable::of_below || event.above == no_patch
                          ? event.below
                          : event.above);
  });
  connect(tab.view, &QTableView::doubleClicked, this, [this, tab](const QModelIndex& index) {
    focus_.go_to_step(tab.table->event(index.row()).step);
  });
  return tab;
}

void StepPanel::show_events() {
  switch (tabs_->currentIndex()) {
    case 0:
      return show_step_tab();
    case 1:
      return show_patch_tab();
    default:
      return show_line_tab();
  }
}

void StepPanel::list(const Tab& tab, const QString& text, std::vector<StepEvent> events) {
  const std::size_t all = events.size();
  std::erase_if(events, [this](const StepEvent& event) { return !focus_.filter().passes(event); });
  const std::size_t hidden = all - events.size();
  // Omits the hint that follows the first sentence: small screens have one line.
  tab.text->setText(hidden == 0 ? text
                                : tr("%1 The filter hides %2 of %3.")
                                      .arg(text.section(QStringLiteral(". "), 0, 0) + '.',
                                           count_text(static_cast<std::int64_t>(hidden)),
                                           count_text(static_cast<std::int64_t>(all))));
  tab.table->set_events(std::move(events));
}

void StepPanel::show_step_tab() {
  const auto map = focus_.map();
  std::vector<StepEvent> events;
  if (map) {
    events = events_of_step(map->history, focus_.position().step);
  }
  const QString text = events.empty() ? tr("No events before the first step.")
                                      : tr("Events of step %1. Click an event to select its patch.")
                                            .arg(count_text(focus_.position().step + 1));
  list(step_, text, std::move(events));
}

void StepPanel::show_patch_tab() {
  const auto map = focus_.map();
  const PatchId patch = selection_.patch();
  if (map != listed_map_ || patch != listed_patch_) {
    listed_map_ = map;
    listed_patch_ = patch;
    std::vector<StepEvent> events;
    if (map) {
      events = events_of_patch(map->history, patch);
    }
    const QString text =
        patch == no_patch
            ? tr("Select a patch to list its events along this direction.")
            : tr("Events of direction %1 for patch %2. Double-click an event to go to its step.")
                  .arg(count_text(map ? map->direction + 1 : 0))
                  .arg(patch);
    list(patch_, text, std::move(events));
  }
  patch_.table->set_current_step(focus_.position().step);
  const int row = patch_.table->row_of_step(focus_.position().step);
  if (row >= 0) {
    patch_.view->scrollTo(patch_.table->index(row, 0));
  }
}

void StepPanel::show_line_tab() {
  const auto map = focus_.map();
  std::vector<StepEvent> events;
  if (map && focus_.probe()) {
    events = events_at_point(map->history, *focus_.probe());
  }
  const auto exchanges = std::count_if(events.begin(), events.end(), [](const StepEvent& event) {
    return event.kind == StepEvent::Kind::exchange;
  });
  const QString text =
      !focus_.probe() ? tr("Click the map to list the patches along a line parallel to ω.")
      : events.empty()
          ? tr("The line hits no patch.")
          : tr("Patches along the line, the nearest to the source first; %1 receiving light "
               "there. The areas are of the fragment at the point, and of the whole pair.")
                .arg(exchanges);
  list(line_, text, std::move(events));
  line_.table->set_current_step(focus_.position().step);
}

}  // namespace transillum::viewer
