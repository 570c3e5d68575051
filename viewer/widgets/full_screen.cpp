// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/full_screen.h"

#include <QApplication>
#include <QCursor>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolButton>
#include <algorithm>
#include <iterator>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

/// Whether a panel is of controls whose effect is seen in the scene: alone, it would be of no use.
bool changes_scene(const QWidget& dock) {
  constexpr const char* names[] = {"settings_dock", "material_dock", "move_dock"};
  return std::any_of(std::begin(names), std::end(names), [&dock](const char* name) {
    return dock.objectName() == QLatin1String(name);
  });
}

}  // namespace

FullScreen::FullScreen(QMainWindow& window) : QObject(&window), window_(window) {
  action_ = make_action(this, "full_screen", tr("Full screen"),
                        tr("Show only the view under the pointer, on the whole screen; settings, "
                           "materials and what moves faces have the scene beside them"),
                        Qt::Key_F11);
  action_->setCheckable(true);
  connect(action_, &QAction::triggered, this, &FullScreen::toggle);
  leave_ = named("leave_full_screen", new QToolButton(&window_), tr("Leave the full screen (Esc)"));
  leave_->setText(tr("✕  Esc"));
  leave_->setFocusPolicy(Qt::NoFocus);  // keys are for the view
  leave_->hide();
  connect(leave_, &QToolButton::clicked, action_, &QAction::trigger);
  window_.installEventFilter(this);
}

bool FullScreen::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && active_) {
    place_way_out();
  }
  return QObject::eventFilter(watched, event);
}

// Over the buttons of the title of a panel that is alone, which have no use there; else below,
// where a panel may have buttons of its own, but neither the scene nor the timeline has.
void FullScreen::place_way_out() {
  leave_->adjustSize();
  const int below = window_.height() - leave_->height() - 4;
  leave_->move(window_.width() - leave_->width() - 4, covers_title_ ? 0 : below);
  leave_->raise();
}

QWidget* FullScreen::view_of(QWidget* widget) const {
  for (; widget; widget = widget->parentWidget()) {
    if (widget == window_.centralWidget() ||
        (qobject_cast<QDockWidget*>(widget) && widget->parentWidget() == &window_)) {
      return widget;
    }
  }
  return nullptr;
}

void FullScreen::toggle() {
  if (active_) {
    show_all();
    emit left();
    return;
  }
  QWidget* view = view_of(QApplication::widgetAt(QCursor::pos()));
  if (!view) {
    view = view_of(QApplication::focusWidget());
  }
  QWidget* scene = window_.centralWidget();
  if (!view || view == scene) {
    show_only({scene});
  } else if (changes_scene(*view)) {
    show_only({view, scene});
  } else {
    show_only({view});
  }
}

void FullScreen::show_only(const QList<QWidget*>& views) {
  if (active_) {
    show_all();
  }
  emit beginning();
  active_ = true;
  action_->setChecked(true);
  state_ = window_.saveState();
  states_before_ = window_.windowState();
  // Shortcuts work only while a widget with the action is visible; the menu bar will be hidden.
  for (QAction* menu : window_.menuBar()->actions()) {
    if (menu->menu()) {
      window_.addActions(menu->menu()->actions());
    }
  }
  hidden_ = {window_.menuBar(), window_.statusBar()};
  if (!views.contains(window_.centralWidget())) {
    hidden_ << window_.centralWidget();
  }
  for (QWidget* widget : hidden_) {
    widget->hide();
  }
  for (QWidget* child : window_.findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
    const bool part = child->inherits("QDockWidget") || child->inherits("QToolBar");
    if (part && !views.contains(child)) {
      child->hide();
    }
  }
  window_.showFullScreen();
  const auto* dock = qobject_cast<QDockWidget*>(views.front());
  covers_title_ = views.size() == 1 && dock && !dock->titleBarWidget();
  leave_->show();
  place_way_out();
}

void FullScreen::show_all() {
  if (!active_) {
    return;
  }
  active_ = false;
  action_->setChecked(false);
  leave_->hide();
  window_.setWindowState(states_before_);
  for (QWidget* widget : hidden_) {
    widget->show();
  }
  window_.restoreState(state_);
  emit ended();
}

}  // namespace transillum::viewer
