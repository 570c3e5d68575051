// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QRect>
#include <QString>
#include <array>
#include <string>
#include <vector>

#include "state/view_choices.h"

class QDockWidget;
class QMenu;
class QSettings;

namespace transillum::viewer {

/// The docks around the scene, and their layouts.
class DockLayouts : public QObject {
  Q_OBJECT

 public:
  explicit DockLayouts(QMainWindow& window);

  /// The place of a dock in a layout: a side of the window, and the height in pixels.
  struct Place {
    Layout layout;
    Qt::DockWidgetArea area;
    int height;
    bool behind = false;  ///< a tab behind the dock added before it
  };
  /// Docks on one side are stacked in the order in which they were added.
  QDockWidget* add(const QString& title, const char* name, QWidget* content,
                   std::vector<Place> places);
  /// Switches to a layout as it is at first.
  void arrange(Layout layout);
  /// Switches to a layout as the user left it; the layout in use is reset.
  void choose(Layout layout);
  /// Arranges the layout in use as it was at first.
  void reset();
  /// Sets the widths of the sides for the current font size.
  void follow_type();
  /// Gives panels at the bottom the height that they ask for, if the window is high enough.
  void fit_bottom();
  /// The places and sizes of all docks, for restore(). While held, their places and sizes from
  /// before hold().
  QByteArray state() const;
  /// Restores a state saved in layout number `layout`. @returns false where it is damaged or does
  /// not fit this version
  bool restore(int layout, const QByteArray& state);
  /// Saves the places and sizes of all docks in all layouts, and the layout in use.
  void save(QSettings& settings) const;
  /// Arranges the saved layout. Saved places that are damaged or do not fit this version are
  /// ignored. @returns false where the places of the layout in use are ignored
  bool load(const QSettings& settings);
  /// While held, layouts and panels stay as they are, whatever is requested.
  void hold(bool held);
  /// The layout in use.
  Layout current() const { return current_; }
  /// Shows a panel, in front of the others in its place.
  /// @param panel the name of its dock without "_dock"
  /// @returns false where there is none
  bool bring_to_front(const std::string& panel);
  /// Gives a panel, or the `scene`, most of the window; restores the usual sizes if `panel` is
  /// empty.
  void enlarge(const std::string& panel);
  /// Hides all panels but this one and the panels at the bottom, and gives it the room that the
  /// scene can spare. An empty name restores all panels, and so does another layout or a page of a
  /// lesson.
  void show_alone(const std::string& panel);
  /// The names that bring_to_front() accepts.
  std::vector<std::string> panels() const;
  /// Adds the actions that show and hide docks, and the layouts.
  void add_to(QMenu& menu);

 signals:
  /// Another layout is in use.
  void switched();
  /// The panel that show_alone() shows now has changed; it may be empty.
  void alone(const QString& panel);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// The places and sizes of all docks, as they were before show_alone().
  QByteArray plain_state() const;
  void end_alone();
  /// Repaints areas without a background: where a separator has moved away, Qt leaves a part of it
  /// there.
  void repaint_moved();
  /// Arranges the usual sizes of the layout, without moving docks.
  void arrange_sizes();

  struct Dock {
    QDockWidget* widget;
    std::vector<Place> places;
  };
  void place_others(const QList<QDockWidget*>& shown);
  void place(const Dock& dock, Layout layout, QList<QDockWidget*>& shown, QList<int>& heights);

  QMainWindow& window_;
  std::vector<Dock> docks_;
  std::array<QByteArray, layout_count> kept_;  ///< states of the layouts that are not in use
  Layout current_ = Layout::inspect;
  bool held_ = false;
  QByteArray held_state_;
  bool enlarged_ = false;
  std::vector<QRect> places_;  ///< places of docks_ when the window was painted
  QString alone_;              ///< argument of show_alone()
  QByteArray before_alone_;    ///< state of the window
};

}  // namespace transillum::viewer
