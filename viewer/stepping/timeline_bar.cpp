// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The timeline: step buttons, a text on the current step, the lanes, and the chart of the watched
// values. Input: Focus, Watches and snapshots.
#include "stepping/timeline_bar.h"

#include <QMenu>
#include <QToolButton>

#include "stepping/play_control.h"
#include "stepping/step_actions.h"
#include "stepping/timeline_lanes.h"
#include "stepping/watch_chart.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QToolButton* button_of(QAction* action) {
  auto* button = button_for(action);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  return button;
}

}  // namespace

TimelineBar::TimelineBar(Focus& focus, Selection& selection, Watches& watches,
                         const StepActions& actions, QWidget* parent)
    : QWidget(parent), focus_(focus), play_(new PlayControl(focus, this)) {
  auto* row = make_row({8, 4, 8, 0}, 2);
  for (QAction* action : actions.buttons()) {
    row->addWidget(button_of(action));
  }
  text_ = named("timeline_text", new ClauseLabel);
  stop_ = named("stop_seeking", new QToolButton, tr("Stop the search (Esc)"));
  stop_->setText(tr("Stop search"));
  connect(stop_, &QToolButton::clicked, &focus_, &Focus::stop);
  filter_ = named("filter_shown", new QToolButton,
                  tr("Stepping skips steps without these events; click to show all events"));
  filter_->setIcon(theme::icon(theme::Icon::clear));
  filter_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  connect(filter_, &QToolButton::clicked, this, [this] { focus_.set_filter({}); });
  auto* play = button_of(play_->action());
  play->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  play->setMenu(play_->menu());
  play->setPopupMode(QToolButton::MenuButtonPopup);
  row->addWidget(play);
  QToolButton* newest = button_of(actions.newest());
  newest->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  row->addSpacing(10);
  row->addWidget(text_, 1);
  row->addWidget(stop_);
  row->addWidget(filter_);
  lanes_ = named("timeline_lanes", new TimelineLanes(focus, selection));
  watched_ = named("watch_chart", new WatchChart(focus, selection, watches, *lanes_));
  auto* watch = new QToolButton;
  watch->setText(tr("Watch"));
  watch->setToolTip(tr("Draw an area, the open part of receivers or the size of V over the steps"));
  watch->setAutoRaise(true);
  watch->setPopupMode(QToolButton::InstantPopup);
  watch->setMenu(watched_->menu());
  row->addWidget(watch);
  row->addWidget(newest);

  auto* layout = make_column(this, {}, 2);
  layout->addLayout(row);
  layout->addWidget(lanes_, 1);
  layout->addWidget(watched_);
  connect(&focus_, &Focus::moved, this, &TimelineBar::show_position);
  connect(&focus_, &Focus::target_changed, this, &TimelineBar::show_position);
  connect(&focus_, &Focus::seek_ended, this, [this](bool found) {
    if (!found) {
      text_->set_clauses({tr("No further hit in the run")});
    }
  });
  connect(&focus_, &Focus::seek_stopped, this, [this](int searched) {
    text_->set_clauses(
        {tr("Search stopped: nothing found in %1 directions").arg(count_text(searched))});
  });
  connect(&focus_, &Focus::filtered, this, &TimelineBar::show_filter);
  // After the chart has received the change.
  connect(&watches, &Watches::changed, this, [this] {
    if (watched_->isHidden() == has_chart_) {
      has_chart_ = !has_chart_;
      emit chart_shown();
    }
  });
  show_position();
  show_filter();
}

QMenu* TimelineBar::watch_menu() const { return watched_->menu(); }

void TimelineBar::show_filter() {
  filter_->setVisible(focus_.filter().on());
  filter_->setText(tr("Only %1").arg(text_of(focus_.filter())));
}

void TimelineBar::show_snapshot(const SolverSnapshot& snapshot) {
  const SolveProgress& progress = snapshot.progress;
  const bool between = progress.direction == 0 && progress.iteration > 0;
  lanes_->set_progress(between ? progress.iteration - 1 : progress.iteration,
                       between ? snapshot.passes_of(progress.iteration - 1) : progress.direction);
}

void TimelineBar::show_position() {
  stop_->setVisible(focus_.seeking());
  if (focus_.seeking()) {
    text_->set_clauses(
        {tr("Searching direction %1…").arg(count_text(focus_.target().direction + 1))});
    return;
  }
  const auto map = focus_.map();
  if (!map) {
    text_->set_clauses({});
    return;
  }
  const std::int32_t k = focus_.position().step;
  if (!focus_.at_step()) {
    text_->set_clauses(
        {focus_.following() ? tr("Newest direction, complete") : tr("The whole direction, no step"),
         tr("%1 steps").arg(count_text(map->history.step_count())),
         tr("Next step (.) begins with the first")});
    return;
  }
  if (k < 0) {
    text_->set_clauses({tr("Before the first step: V is empty")});
    return;
  }
  const MapHistory::Step& step = map->history.step(k);
  if (step.row == MapRecord::no_row) {
    text_->set_clauses({tr("Patch <b>%1</b> is edge-on: skipped").arg(step.patch)});
    return;
  }
  const QString facing = step.front_facing ? tr("Patch <b>%1</b> faces ω (receiver)")
                                           : tr("Patch <b>%1</b> faces away from ω (source)");
  const QString cuts =
      step.cut == 1
          ? tr("%1; it cuts 1 piece of V").arg(facing.arg(step.patch))
          : tr("%1; it cuts %2 pieces of V").arg(facing.arg(step.patch), count_text(step.cut));
  const QString size = step.map_size == 1
                           ? tr("then V has 1 polygon")
                           : tr("then V has %1 polygons").arg(count_text(step.map_size));
  QStringList clauses{cuts, tr("exchanges light with %1 of them").arg(count_text(step.exchanges)),
                      size};
  text_->set_clauses(clauses);
}

}  // namespace transillum::viewer
