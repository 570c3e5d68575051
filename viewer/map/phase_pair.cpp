// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/phase_pair.h"

#include <QAction>
#include <QActionGroup>
#include <QEvent>
#include <QMenu>
#include <QToolButton>

namespace transillum::viewer {

PhasePair::PhasePair(QWidget& view)
    : QObject(&view),
      view_(view),
      choices_(new QActionGroup(this)),
      button_(new QToolButton),
      action_(new QAction(tr("Before and after: one, side by side, in turn"), this)) {
  button_->setObjectName("map_pair");
  button_->setText(tr("Both"));
  button_->setCheckable(true);
  button_->setPopupMode(QToolButton::InstantPopup);
  button_->setToolTip(tr("Show V before and after the step, side by side or in turn (B)"));
  auto* menu = new QMenu(button_);
  for (const QString& text :
       {tr("One phase"), tr("Before and after side by side"), tr("Before and after in turn")}) {
    QAction* choice = menu->addAction(text);
    choice->setCheckable(true);
    choices_->addAction(choice);
  }
  button_->setMenu(menu);
  connect(choices_, &QActionGroup::triggered, this, [this](QAction* choice) {
    choose(static_cast<Choice>(choices_->actions().indexOf(choice)));
  });
  action_->setObjectName("next_pair");
  action_->setShortcut(Qt::Key_B);
  action_->setToolTip(tr("Show V before and after the step side by side, then in turn (B)"));
  connect(action_, &QAction::triggered, this, [this] {
    choose(static_cast<Choice>((static_cast<int>(choice_) + 1) % choices_->actions().size()));
  });
  timer_.setInterval(blink_ms);
  connect(&timer_, &QTimer::timeout, this, [this] {
    before_ = !before_;
    emit changed();
  });
  view_.installEventFilter(this);
  choose(Choice::off);
}

void PhasePair::choose(Choice choice) {
  choice_ = choice;
  choices_->actions()[static_cast<int>(choice)]->setChecked(true);
  button_->setChecked(choice != Choice::off);
  start_or_stop();
  emit changed();
}

void PhasePair::start_or_stop() {
  const bool seen = view_.isVisible() && view_.isActiveWindow();
  if (choice_ == Choice::blink && seen) {
    timer_.start();
    return;
  }
  timer_.stop();
  if (before_) {
    before_ = false;
    emit changed();
  }
}

bool PhasePair::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::WindowActivate:
    case QEvent::WindowDeactivate:
    case QEvent::Show:
    case QEvent::Hide:
      start_or_stop();
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace transillum::viewer
