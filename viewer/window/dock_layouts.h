// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <QMainWindow>
#include <QObject>
#include <string>
#include <vector>

#include "state/layout.h"

class QDockWidget;
class QMenu;

namespace transillum::viewer {

/// The docks round the scene, and the ways to lay them out.
class DockLayouts : public QObject {
  Q_OBJECT

 public:
  explicit DockLayouts(QMainWindow& window);

  /// Where a dock lies in a layout: at a side of the window, so many pixels high there.
  struct Place {
    Layout layout;
    Qt::DockWidgetArea area;
    int height;
    bool behind = false;  ///< a tab behind the dock added before it
  };
  /// Docks of one side lie below one another in the order they were added.
  QDockWidget* add(const QString& title, const char* name, QWidget* content,
                   std::vector<Place> places);
  void arrange(Layout layout);
  /// Gives the sides the widths that the layout wants with the type there is now.
  void follow_type();
  /// The places and sizes of all docks, for restore().
  QByteArray state() const;
  /// Restores a state saved in layout number `layout`. False where it does not fit this version.
  bool restore(int layout, const QByteArray& state);
  /// The one arranged last.
  Layout current() const { return current_; }
  /// Shows a panel, in front of those it shares its place with. `panel` is its dock's name without
  /// "_dock"; false where there is none.
  bool bring_to_front(const std::string& panel);
  /// What bring_to_front() takes.
  std::vector<std::string> panels() const;
  /// Docks to show and hide, and the layouts.
  void add_to(QMenu& menu);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Dock {
    QDockWidget* widget;
    std::vector<Place> places;
  };
  QMainWindow& window_;
  std::vector<Dock> docks_;
  Layout current_ = Layout::inspect;
};

}  // namespace transillum::viewer
