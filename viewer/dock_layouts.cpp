// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "dock_layouts.h"

#include <QAction>
#include <QDockWidget>
#include <QMenu>
#include <QScrollArea>
#include <QStyle>
#include <utility>

namespace transillum::viewer {

DockLayouts::DockLayouts(QMainWindow& window) : QObject(&window), window_(window) {
  window_.setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowNestedDocks |
                         QMainWindow::AllowTabbedDocks);
  window_.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window_.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
}

QDockWidget* DockLayouts::add(const QString& title, const char* name, QWidget* content,
                              std::vector<Place> places) {
  auto* dock = new QDockWidget(title, &window_);
  dock->setObjectName(QString::fromLatin1(name));
  dock->setWidget(content);
  docks_.push_back({dock, std::move(places)});
  return dock;
}

void DockLayouts::arrange(Layout layout) {
  for (const Dock& dock : docks_) {
    window_.removeDockWidget(dock.widget);
    dock.widget->setFloating(false);
  }
  QList<QDockWidget*> left, right, shown;
  QList<int> heights;
  for (const Dock& dock : docks_) {
    for (const Place& place : dock.places) {
      if (place.layout != layout) continue;
      window_.addDockWidget(place.area, dock.widget);
      dock.widget->show();
      if (place.behind) {
        window_.tabifyDockWidget(shown.back(), dock.widget);
        shown.back()->raise();
        continue;
      }
      shown << dock.widget;
      heights << place.height;
      if (place.area == Qt::LeftDockWidgetArea) left << dock.widget;
      if (place.area == Qt::RightDockWidgetArea) right << dock.widget;
    }
  }
  const int right_width = layout == Layout::debug ? 470 : 410;
  if (!left.isEmpty() && !right.isEmpty())
    window_.resizeDocks({left.front(), right.front()},
                        {layout == Layout::debug ? 330 : 290, right_width}, Qt::Horizontal);
  window_.resizeDocks(shown, heights, Qt::Vertical);
}

void DockLayouts::add_to(QMenu& menu) {
  for (const Dock& dock : docks_) menu.addAction(dock.widget->toggleViewAction());
  menu.addSeparator();
  const auto add_layout = [&](Layout layout, const char* name, const QString& text,
                              const char* key) {
    QAction* action = menu.addAction(
        text, this, [this, layout] { arrange(layout); }, QKeySequence(QString::fromLatin1(key)));
    action->setObjectName(QString::fromLatin1(name));
  };
  add_layout(Layout::inspect, "layout_inspect", tr("Lay out to inspect a solve"), "Ctrl+1");
  add_layout(Layout::debug, "layout_debug", tr("Lay out to step through a map"), "Ctrl+2");
}

QWidget* scrollable(QWidget* content) {
  auto* area = new QScrollArea;
  area->setWidget(content);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  // Never so narrow that something is cut off at the right.
  area->setMinimumWidth(content->minimumSizeHint().width() +
                        area->style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  return area;
}

}  // namespace transillum::viewer
