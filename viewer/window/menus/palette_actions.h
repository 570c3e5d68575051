// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <set>
#include <string>
#include <vector>

#include "widgets/command_palette.h"
#include "window/base/window_views.h"

class QAction;
class QDockWidget;
class QWidget;

namespace transillum::viewer {

/// The action that shows the command palette, and what the palette has: all actions, the
/// buttons of the scene and of panels, panels, scenes, lessons, groups and materials of the open
/// scene, and patches by their number.
class PaletteActions : public QObject {
  Q_OBJECT

 public:
  /// @param frame, docks must outlive this object
  PaletteActions(const WindowFrame& frame, DockLayouts& docks);

  QAction* action() const { return action_; }

 private:
  void show();
  std::vector<PaletteEntry> entries();
  const QDockWidget* dock_of(const std::string& panel) const;
  void add_panels(std::vector<PaletteEntry>& entries);
  /// Adds the buttons of a widget that are shown in it.
  /// @param panel  the panel to show before a button is pressed; empty for none
  /// @param taken  actions that the palette has already, or in another form
  void add_buttons(const QWidget& widget, const QString& place, const std::string& panel,
                   std::set<const QAction*>& taken, std::vector<PaletteEntry>& entries);
  /// Adds actions that are in no menu.
  void add_other_actions(std::set<const QAction*>& taken, std::vector<PaletteEntry>& entries);
  void add_quantities(std::vector<PaletteEntry>& entries);
  void add_surfaces(std::vector<PaletteEntry>& entries);
  std::vector<PaletteEntry> patch_of(const QString& query);

  WindowFrame frame_;
  DockLayouts& docks_;
  QAction* action_;
};

}  // namespace transillum::viewer
