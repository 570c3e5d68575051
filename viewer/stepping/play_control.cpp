// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "stepping/play_control.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <cmath>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double degrees_per_second = 20;
constexpr double speeds[] = {1, 2, 5, 10, 25};

}  // namespace

PlayControl::PlayControl(Focus& focus, QObject* parent)
    : QObject(parent), focus_(focus), menu_(std::make_unique<QMenu>()) {
  action_ =
      make_action(this, "play", tr("Play"),
                  tr("Play polygons, directions or iterations as an animation (L)"), Qt::Key_L);
  action_->setIcon(theme::icon(theme::Icon::run));
  action_->setCheckable(true);
  connect(action_, &QAction::toggled, this, &PlayControl::toggle);
  connect(&timer_, &QTimer::timeout, this, &PlayControl::show_next);
  connect(&focus_, &Focus::seek_ended, this, [this](bool found) {
    if (!found) {
      action_->setChecked(false);  // no further step passes the filter of events
    }
  });
  connect(&focus_, &Focus::target_changed, this, &PlayControl::show_state);
  connect(&focus_, &Focus::moved, this, &PlayControl::show_state);
  make_menu();
  set_speed(per_second_);
  show_state();
}

PlayControl::~PlayControl() = default;

void PlayControl::make_menu() {
  by_group_ = add_group(tr("Play"));
  const std::pair<By, QString> parts[] = {{By::polygons, tr("Polygons of a direction")},
                                          {By::directions, tr("Directions")},
                                          {By::iterations, tr("Iterations")}};
  for (const auto& [by, text] : parts) {
    QAction* choice = by_group_->addAction(text);
    choice->setCheckable(true);
    choice->setChecked(by == by_);
    choice->setData(static_cast<int>(by));
    menu_->addAction(choice);
  }
  connect(by_group_, &QActionGroup::triggered, this,
          [this](const QAction* choice) { by_ = static_cast<By>(choice->data().toInt()); });
  speed_group_ = add_group(tr("Pictures per second"));
  for (const double speed : speeds) {
    QAction* choice = speed_group_->addAction(QString::number(speed));
    choice->setCheckable(true);
    choice->setChecked(speed == per_second_);
    choice->setData(speed);
    menu_->addAction(choice);
  }
  connect(speed_group_, &QActionGroup::triggered, this,
          [this](const QAction* choice) { set_speed(choice->data().toDouble()); });
  menu_->addSeparator();
  turns_ = new QAction(tr("Turn the camera"), this);
  menu_->addAction(turns_);
  turns_->setObjectName("play_turns");
  turns_->setCheckable(true);
  turns_->setToolTip(tr("Turn the camera about the vertical while playing"));
}

QActionGroup* PlayControl::add_group(const QString& title) {
  menu_->addSection(title);
  return new QActionGroup(this);
}

void PlayControl::set_by(By by) {
  by_ = by;
  for (QAction* choice : by_group_->actions()) {
    choice->setChecked(choice->data().toInt() == static_cast<int>(by));
  }
}

void PlayControl::set_speed(double per_second) {
  per_second_ = per_second;
  timer_.setInterval(static_cast<int>(std::lround(1000 / per_second)));
}

void PlayControl::toggle(bool on) {
  action_->setText(on ? tr("Stop") : tr("Play"));
  action_->setIcon(theme::icon(on ? theme::Icon::pause : theme::Icon::run));
  on ? timer_.start() : timer_.stop();
  show_state();
}

void PlayControl::stop() { action_->setChecked(false); }

void PlayControl::show_state() {
  enable_if(*action_, action_->isChecked() || (focus_.passes() > 0 && focus_.map()),
            tr("No direction is shown yet"));
}

void PlayControl::show_next() {
  if (!focus_.arrived() || !may_go_on_()) {
    return;
  }
  if (!advance()) {
    action_->setChecked(false);
    return;
  }
  if (turns_->isChecked()) {
    emit turned(degrees_per_second / per_second_);
  }
}

bool PlayControl::advance() {
  const RunPosition before = focus_.target();
  switch (by_) {
    case By::polygons:
      return focus_.step_by(1);
    case By::directions:
      focus_.direction_by(1);
      break;
    case By::iterations:
      focus_.iteration_by(1);
      break;
  }
  return !(focus_.target() == before);
}

}  // namespace transillum::viewer
