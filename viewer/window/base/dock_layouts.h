// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QRect>
#include <QString>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "state/view_choices.h"
#include "transillum/at.h"
#include "window/base/dock_places.h"

class QAction;
class QDockWidget;
class QMenu;
class QSettings;

namespace transillum::viewer {

/// The docks around the scene, and their layouts.
class DockLayouts : public QObject {
  Q_OBJECT

 public:
  explicit DockLayouts(QMainWindow& window);

  /// Adds a panel. Panels of one stack are tabs in the order in which they were added.
  /// @param name of the dock; ends in "_dock". dock_places_of() has its places
  QDockWidget* add(const QString& title, const char* name, QWidget* content);
  /// Switches to a layout as it is at first.
  void arrange(Layout layout);
  /// Switches to a layout as the user left it.
  void choose(Layout layout);
  /// Arranges the layout in use as it was at first.
  void reset();
  /// Sets the widths of the sides for the current font size.
  void follow_type();
  /// Gives the panel at the bottom the height that it asks for, if the window is high enough.
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
  /// Shows these panels; the others that have a place in the layout to teach are closed, except the
  /// lesson. For a page of a lesson.
  void show_for_page(const std::vector<std::string>& panels);
  /// While the window shows its first page, all panels that do not float are hidden. Choosing a
  /// layout and showing a panel end this.
  void cover(bool covered);
  /// Gives a panel, or the `scene`, most of the window; restores the usual sizes if `panel` is
  /// empty.
  void enlarge(const std::string& panel);
  /// Hides all panels but this one and the panels at the bottom, and gives it the room that the
  /// scene can spare. An empty name restores all panels, and so does another layout or a page of a
  /// lesson.
  void show_alone(const std::string& panel);
  /// The names that bring_to_front() accepts.
  std::vector<std::string> panels() const;
  /// Adds the layouts, and a menu of all panels.
  void add_to(QMenu& menu);
  /// Switches to a layout; checked while the layout is in use and not covered.
  QAction* action(Layout layout) const { return at(actions_, layout); }

 signals:
  /// The user has chosen a layout, which may be in use already.
  void chosen(transillum::viewer::Layout layout);
  /// Another layout is in use, or it was covered or uncovered.
  void switched();
  /// cover(false) was called, or another function has ended it.
  void uncovered();
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
  /// Exchanges the sizes of scene and map in the layout to step.
  void swap_views();

  struct Dock {
    QDockWidget* widget;
    std::string panel;  ///< name of the dock without "_dock"
  };
  void make_actions();
  void show_state();
  void uncover();
  const Dock* find(const std::string& panel) const;
  const DockPlace* place_of(const Dock& dock) const;
  void place(const Dock& dock, const DockPlace& place);
  void place_others();
  /// Closes the panel of a stack that was in front before all others, where there are more tabs
  /// than have room.
  void limit_tabs(QDockWidget* shown);
  void keep_fraction(int width_before);

  QMainWindow& window_;
  std::vector<Dock> docks_;
  std::array<QByteArray, layout_count> kept_;  ///< states of the layouts that are not in use
  Layout current_ = Layout::inspect;
  std::array<QAction*, layout_count> actions_{};
  std::map<std::pair<int, int>, QDockWidget*> stacks_;  ///< first dock of each side and stack
  std::vector<QDockWidget*> fronts_;                    ///< the newest last
  QMenu* panel_menu_;
  bool covered_ = false, uncovers_later_ = false;
  QByteArray covered_state_;
  bool held_ = false;
  QByteArray held_state_;
  bool enlarged_ = false;
  QAction* swap_ = nullptr;
  bool scene_large_ = false;   ///< in the layout to step, the scene has the room of the map
  std::vector<QRect> places_;  ///< places of docks_ when the window was painted
  QString alone_;              ///< argument of show_alone()
  QByteArray before_alone_;    ///< state of the window
};

}  // namespace transillum::viewer
