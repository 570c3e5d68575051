// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"

class QToolButton;

namespace transillum::viewer {

class ClauseLabel;
class PlayControl;
class StepActions;
class TimelineLanes;

/// The position in the run that the window shows, and the controls to change it.
class TimelineBar : public QWidget {
  Q_OBJECT

 public:
  TimelineBar(Focus& focus, Selection& selection, const StepActions& actions,
              QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);
  TimelineLanes* lanes() const { return lanes_; }
  PlayControl* play() const { return play_; }

 private:
  void show_position();

  Focus& focus_;
  PlayControl* play_;
  ClauseLabel* text_;
  QToolButton* stop_;
  TimelineLanes* lanes_;
};

}  // namespace transillum::viewer
