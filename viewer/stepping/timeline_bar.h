// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"
#include "state/watches.h"

class QMenu;
class QToolButton;

namespace transillum::viewer {

class ClauseLabel;
class PlayControl;
class StepActions;
class TimelineLanes;
class WatchChart;

/// The position in the run that the window shows, and the controls to change it.
class TimelineBar : public QWidget {
  Q_OBJECT

 public:
  TimelineBar(Focus& focus, Selection& selection, Watches& watches, const StepActions& actions,
              QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);
  TimelineLanes* lanes() const { return lanes_; }
  PlayControl* play() const { return play_; }
  /// The menu of values that can be watched.
  QMenu* watch_menu() const;

 signals:
  /// The chart of the watched values has been shown or hidden.
  void chart_shown();

 private:
  void show_position();
  void show_filter();

  Focus& focus_;
  PlayControl* play_;
  ClauseLabel* text_;
  QToolButton* stop_;
  QToolButton* filter_;
  TimelineLanes* lanes_;
  WatchChart* watched_;
  bool has_chart_ = false;
};

}  // namespace transillum::viewer
