// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <utility>

#include "state/focus.h"

class QAction;
class QActionGroup;
class QMenu;

namespace transillum::viewer {

/// Plays a run as an animation: moves the focus forward at a chosen speed until the end of the run,
/// or until it is stopped. It waits for a direction that is still being recorded.
class PlayControl : public QObject {
  Q_OBJECT

 public:
  /// The unit by which the focus moves from one picture of the animation to the next.
  enum class By { polygons, directions, iterations };

  /// @param focus must outlive this object
  explicit PlayControl(Focus& focus, QObject* parent = nullptr);
  ~PlayControl() override;

  /// Starts and stops the animation.
  QAction* action() const { return action_; }
  /// The menu that sets what is played, how fast, and whether the camera turns.
  QMenu* menu() const { return menu_.get(); }
  By by() const { return by_; }
  void set_by(By by);
  /// @param per_second pictures, above 0
  void set_speed(double per_second);
  double speed() const { return per_second_; }
  /// Whether another picture follows.
  bool playing() const { return timer_.isActive(); }
  void stop();
  /// Waits with the next picture while `may_go_on` returns false.
  void set_gate(std::function<bool()> may_go_on) { may_go_on_ = std::move(may_go_on); }

 signals:
  /// The camera is to turn about the vertical.
  void turned(double degrees);

 private:
  void make_menu();
  QActionGroup* add_group(const QString& title);
  void toggle(bool on);
  /// Without a direction to play from, only a play that is under way can be stopped.
  void show_state();
  void show_next();
  /// Shows the next position. @returns false at the end of the run
  bool advance();

  Focus& focus_;
  By by_ = By::polygons;
  double per_second_ = 5;
  std::function<bool()> may_go_on_ = [] { return true; };
  QTimer timer_;
  QAction* action_;
  QAction* turns_;
  QActionGroup *by_group_, *speed_group_;
  std::unique_ptr<QMenu> menu_;
};

}  // namespace transillum::viewer
