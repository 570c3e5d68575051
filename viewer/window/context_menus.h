// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <initializer_list>

#include "transillum/scene.h"
#include "window/base/window_views.h"

class QAbstractItemView;
class QMenu;
class QPoint;
class QWidget;

namespace transillum::viewer {

/// The menus of clicks with the right button: on a patch in the scene and in tables, and on charts,
/// kept runs and the timeline. Almost everything in these menus is an action of the menu bar too.
class ContextMenus : public QObject {
  Q_OBJECT

 public:
  /// To be created after all panels and menus.
  /// @param frame, docks must outlive this object
  ContextMenus(const WindowFrame& frame, DockLayouts& docks);

 private:
  /// Shows the menu of a patch on right clicks in a table of patches.
  void add_to_table(QAbstractItemView& table);
  /// Shows actions of the window, by their names, on right clicks in `widget`.
  void add_actions(QWidget& widget, std::initializer_list<const char*> names);
  void show_patch_menu(PatchId patch, const QPoint& place);
  void add_selecting(QMenu& menu);
  void add_emitting(QMenu& menu, PatchId patch);
  void add_showing(QMenu& menu, PatchId patch);
  /// Adds an action of the window by its name.
  void add_action(QMenu& menu, const char* name);

  WindowFrame frame_;
  DockLayouts& docks_;
};

}  // namespace transillum::viewer
