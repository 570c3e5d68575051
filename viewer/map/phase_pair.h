// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QTimer>
#include <QWidget>

class QAction;
class QActionGroup;
class QToolButton;

namespace transillum::viewer {

/// How the map shows V before and after a step: one phase, both side by side, or both in turn. In
/// turn, each phase is shown for half a second while the window is active.
class PhasePair : public QObject {
  Q_OBJECT

 public:
  enum class Choice { off, side_by_side, blink };
  static constexpr int blink_ms = 500;

  /// @param view the widget that shows the phases
  explicit PhasePair(QWidget& view);

  Choice choice() const { return choice_; }
  void choose(Choice choice);
  /// Whether V before the step is shown now, where the phases are shown in turn.
  bool before() const { return before_; }
  /// Whether the phases alternate at present.
  bool blinks() const { return timer_.isActive(); }
  /// A button with a menu of the choices.
  QToolButton* button() const { return button_; }
  /// Goes to the next choice.
  QAction* action() const { return action_; }

 signals:
  void changed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// Starts to alternate the phases if the map is visible.
  void start_or_stop();

  QWidget& view_;
  Choice choice_ = Choice::off;
  bool before_ = false;
  QTimer timer_;
  QActionGroup* choices_;
  QToolButton* button_;
  QAction* action_;
};

}  // namespace transillum::viewer
