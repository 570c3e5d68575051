// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/dock_layouts.h"

#include <QChildEvent>
#include <QDockWidget>
#include <QMenu>
#include <QSettings>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <optional>
#include <utility>

#include "support/checked_bytes.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

// Raise this number when docks are added, removed or renamed: older saved layouts then become
// invalid.
constexpr int layout_version = 11;

struct Widths {
  int left, right;
};
Widths usual_widths_of(Layout layout) {
  switch (layout) {
    case Layout::teach:
      return {400, 480};
    case Layout::debug:
      return {350, 470};
    default:
      return {290, 464};
  }
}

// A larger font needs wider sides, but the scene must keep enough width.
Widths widths_of(Layout layout, int window_width) {
  constexpr double most_fraction = 0.64;
  const Widths usual = usual_widths_of(layout);
  const double sum = usual.left + usual.right;
  const double factor = std::clamp(most_fraction * window_width / sum, 1.0, theme::scale());
  return {static_cast<int>(factor * usual.left), static_cast<int>(factor * usual.right)};
}

}  // namespace

DockLayouts::DockLayouts(QMainWindow& window) : QObject(&window), window_(window) {
  window_.setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowNestedDocks |
                         QMainWindow::AllowTabbedDocks);
  window_.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window_.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  window_.installEventFilter(this);
}

QDockWidget* DockLayouts::add(const QString& title, const char* name, QWidget* content,
                              std::vector<Place> places) {
  auto* dock = named(name, new QDockWidget(title, &window_));
  dock->setWidget(content);
  // Qt moves a tab behind others off screen but reports it as visible: its content would continue
  // to work, and would not be notified when it comes to the front. Without the next lines, a dock
  // with hidden content gets no space, nor do its neighbors.
  QSizePolicy policy = content->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  content->setSizePolicy(policy);
  connect(dock, &QDockWidget::visibilityChanged, content,
          [dock, content](bool visible) { content->setVisible(visible || dock->isHidden()); });
  // A floating panel becomes a window like others, which can be maximized.
  connect(dock, &QDockWidget::topLevelChanged, dock, [dock](bool floating) {
    if (floating) {
      dock->setWindowFlags(Qt::Window | Qt::CustomizeWindowHint | Qt::WindowTitleHint |
                           Qt::WindowSystemMenuHint | Qt::WindowMinMaxButtonsHint |
                           Qt::WindowCloseButtonHint);
      dock->show();
    }
  });
  dock->installEventFilter(this);
  docks_.push_back({dock, std::move(places)});
  return dock;
}

void DockLayouts::choose(Layout layout) {
  if (held_) {
    return;
  }
  if (layout == current_) {
    reset();
    return;
  }
  at(kept_, current_) = plain_state();
  arrange(layout);
  if (const QByteArray& kept = at(kept_, layout); !kept.isEmpty()) {
    window_.restoreState(kept, layout_version);
  }
}

void DockLayouts::reset() {
  if (!held_) {
    arrange(current_);
  }
}

void DockLayouts::arrange(Layout layout) {
  current_ = layout;
  emit switched();
  end_alone();
  for (const Dock& dock : docks_) {
    // In this order: a dock that has been removed does not come back from floating.
    dock.widget->setFloating(false);
    window_.removeDockWidget(dock.widget);
  }
  QList<QDockWidget*> shown;
  QList<int> heights;
  for (const Dock& dock : docks_) {
    place(dock, layout, shown, heights);
  }
  place_others(shown);
  window_.resizeDocks(shown, heights, Qt::Vertical);
  follow_type();
  enlarged_ = false;
  // Qt may leave an empty tab bar.
  QTimer::singleShot(0, this, [this] {
    for (QTabBar* bar : window_.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
      if (bar->count() == 0) {
        bar->hide();
      }
    }
  });
}

// Docks without a place in this layout open as tabs, on the side of their place in another layout:
// beside the other docks, they would make the window higher than small screens.
void DockLayouts::place_others(const QList<QDockWidget*>& shown) {
  for (const Dock& dock : docks_) {
    if (!dock.widget->isHidden() || dock.places.empty()) {
      continue;
    }
    const auto beside = std::find_if(shown.rbegin(), shown.rend(), [&](QDockWidget* other) {
      return window_.dockWidgetArea(other) == dock.places.front().area;
    });
    window_.addDockWidget(dock.places.front().area, dock.widget);
    if (beside != shown.rend()) {
      window_.tabifyDockWidget(*beside, dock.widget);
    }
    dock.widget->hide();
  }
}

/// @param shown, heights the docks in front in the layout so far, and their heights
void DockLayouts::place(const Dock& dock, Layout layout, QList<QDockWidget*>& shown,
                        QList<int>& heights) {
  dock.widget->hide();
  for (const Place& place : dock.places) {
    if (place.layout != layout) {
      continue;
    }
    window_.addDockWidget(place.area, dock.widget);
    dock.widget->show();
    if (place.behind) {
      window_.tabifyDockWidget(shown.back(), dock.widget);
      shown.back()->raise();
      continue;
    }
    shown << dock.widget;
    heights << place.height;
  }
}

void DockLayouts::arrange_sizes() {
  QList<QDockWidget*> shown;
  QList<int> heights;
  for (const Dock& dock : docks_) {
    for (const Place& place : dock.places) {
      if (place.layout == current_ && !place.behind && !dock.widget->isHidden()) {
        shown << dock.widget;
        heights << place.height;
      }
    }
  }
  window_.resizeDocks(shown, heights, Qt::Vertical);
  follow_type();
}

void DockLayouts::follow_type() {
  const Widths widths = widths_of(current_, window_.width());
  for (const Dock& dock : docks_) {
    for (const Place& place : dock.places) {
      if (place.layout != current_ || place.behind || dock.widget->isHidden()) {
        continue;
      }
      if (place.area == Qt::LeftDockWidgetArea) {
        window_.resizeDocks({dock.widget}, {widths.left}, Qt::Horizontal);
      } else if (place.area == Qt::RightDockWidgetArea) {
        window_.resizeDocks({dock.widget}, {widths.right}, Qt::Horizontal);
      }
    }
  }
  fit_bottom();
}

void DockLayouts::fit_bottom() {
  constexpr double fraction = 0.18, most_fraction = 0.24;
  for (const Dock& dock : docks_) {
    for (const Place& place : dock.places) {
      if (place.layout == current_ && place.area == Qt::BottomDockWidgetArea &&
          !dock.widget->isHidden()) {
        const double usual = std::min(theme::scale() * place.height, fraction * window_.height());
        // In a low window, the panels above need the room more.
        const double wanted = dock.widget->widget()->sizeHint().height();
        const bool has_room = wanted < most_fraction * window_.height();
        window_.resizeDocks({dock.widget},
                            {static_cast<int>(has_room ? std::max(usual, wanted) : usual)},
                            Qt::Vertical);
      }
    }
  }
}

bool DockLayouts::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildPolished) {
    // The window creates the tab bars of its docks; names must not be cut off.
    auto* bar = qobject_cast<QTabBar*>(static_cast<QChildEvent*>(event)->child());
    if (bar) {
      bar->setElideMode(Qt::ElideNone);
      bar->setUsesScrollButtons(true);
    }
  }
  const bool moves = event->type() == QEvent::Resize || event->type() == QEvent::Move;
  if (moves || event->type() == QEvent::LayoutRequest) {
    QTimer::singleShot(0, this, &DockLayouts::repaint_moved);
  }
  return QObject::eventFilter(watched, event);
}

void DockLayouts::repaint_moved() {
  std::vector<QRect> places;
  for (const Dock& dock : docks_) {
    places.push_back(dock.widget->isVisible() ? dock.widget->geometry() : QRect());
  }
  if (places != places_) {
    places_ = std::move(places);
    window_.update();
  }
}

void DockLayouts::hold(bool held) {
  if (held && !held_) {
    held_state_ = state();
  }
  held_ = held;
}

QByteArray DockLayouts::state() const { return held_ ? held_state_ : with_checksum(plain_state()); }

QByteArray DockLayouts::plain_state() const {
  return alone_.isEmpty() ? window_.saveState(layout_version) : before_alone_;
}

bool DockLayouts::restore(int layout, const QByteArray& state) {
  const std::optional<QByteArray> checked = without_checksum(state);
  if (layout < 0 || layout >= layout_count || !checked) {
    return false;
  }
  if (held_) {
    return true;
  }
  arrange(static_cast<Layout>(layout));
  return window_.restoreState(*checked, layout_version);
}

namespace {

QString key_of(int layout) { return QStringLiteral("window/kept/%1").arg(layout); }

}  // namespace

void DockLayouts::save(QSettings& settings) const {
  settings.setValue("window/state", state());
  settings.setValue("window/layout", static_cast<int>(current_));
  for (int k = 0; k < layout_count; ++k) {
    settings.setValue(key_of(k), with_checksum(at(kept_, k)));
  }
}

bool DockLayouts::load(const QSettings& settings) {
  for (int k = 0; k < layout_count; ++k) {
    at(kept_, k) = without_checksum(settings.value(key_of(k)).toByteArray()).value_or(QByteArray());
  }
  return restore(settings.value("window/layout", -1).toInt(),
                 settings.value("window/state").toByteArray());
}

void DockLayouts::add_to(QMenu& menu) {
  for (const Dock& dock : docks_) {
    menu.addAction(dock.widget->toggleViewAction());
  }
  menu.addSeparator();
  const auto add_layout = [&](Layout layout, const char* name, const QString& text,
                              const char* key) {
    QAction* action = menu.addAction(
        text, this, [this, layout] { choose(layout); }, QKeySequence(QString::fromLatin1(key)));
    action->setObjectName(QString::fromLatin1(name));
  };
  add_layout(Layout::teach, "layout_teach", tr("Lay out to teach"), "Ctrl+1");
  add_layout(Layout::inspect, "layout_inspect", tr("Lay out to inspect a solve"), "Ctrl+2");
  add_layout(Layout::debug, "layout_debug", tr("Lay out to debug a map"), "Ctrl+3");
  menu.addAction(tr("Reset the layout"), this, &DockLayouts::reset,
                 QKeySequence(QStringLiteral("Ctrl+0")))
      ->setObjectName("layout_reset");
}

namespace {

std::string panel_name(const QDockWidget& dock) {
  return dock.objectName().remove(QStringLiteral("_dock")).toStdString();
}

}  // namespace

bool DockLayouts::bring_to_front(const std::string& panel) {
  for (const Dock& dock : docks_) {
    if (panel_name(*dock.widget) != panel) {
      continue;
    }
    if (!held_) {
      dock.widget->show();
      dock.widget->raise();
    }
    return true;
  }
  return false;
}

void DockLayouts::end_alone() {
  if (!alone_.isEmpty()) {
    alone_.clear();
    emit alone({});
  }
}

void DockLayouts::show_alone(const std::string& panel) {
  const QString name = QString::fromStdString(panel);
  if (held_ || name == alone_) {
    emit alone(alone_);
    return;
  }
  if (!alone_.isEmpty()) {
    end_alone();
    window_.restoreState(before_alone_, layout_version);
  }
  const auto found = std::find_if(docks_.begin(), docks_.end(), [&](const Dock& dock) {
    return panel_name(*dock.widget) == panel;
  });
  if (found == docks_.end()) {
    return;
  }
  before_alone_ = window_.saveState(layout_version);
  alone_ = name;
  for (const Dock& dock : docks_) {
    const bool bottom = window_.dockWidgetArea(dock.widget) == Qt::BottomDockWidgetArea;
    if (dock.widget != found->widget && !bottom && !dock.widget->isFloating()) {
      dock.widget->hide();
    }
  }
  bring_to_front(panel);
  constexpr double fraction = 0.62;  // the scene needs less width than it has beside two columns of
                                     // panels
  window_.resizeDocks({found->widget}, {static_cast<int>(fraction * window_.width())},
                      Qt::Horizontal);
  emit alone(alone_);
}

void DockLayouts::enlarge(const std::string& panel) {
  if (held_) {
    return;
  }
  show_alone({});
  if (enlarged_) {
    arrange_sizes();
    enlarged_ = false;
  }
  if (panel.empty()) {
    return;
  }
  enlarged_ = true;
  constexpr double wide = 0.42, high = 0.75, narrow = 0.16;
  const auto found = std::find_if(docks_.begin(), docks_.end(), [&](const Dock& dock) {
    return panel_name(*dock.widget) == panel;
  });
  if (found != docks_.end()) {
    bring_to_front(panel);
    window_.resizeDocks({found->widget}, {static_cast<int>(wide * window_.width())},
                        Qt::Horizontal);
    window_.resizeDocks({found->widget}, {static_cast<int>(high * window_.height())}, Qt::Vertical);
    return;
  }
  for (const Dock& dock : docks_) {
    if (window_.dockWidgetArea(dock.widget) == Qt::RightDockWidgetArea &&
        !dock.widget->isHidden()) {
      window_.resizeDocks({dock.widget}, {static_cast<int>(narrow * window_.width())},
                          Qt::Horizontal);
    }
  }
}

std::vector<std::string> DockLayouts::panels() const {
  std::vector<std::string> names;
  for (const Dock& dock : docks_) {
    names.push_back(panel_name(*dock.widget));
  }
  return names;
}

}  // namespace transillum::viewer
