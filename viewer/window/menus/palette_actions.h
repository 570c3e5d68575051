// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <vector>

#include "widgets/command_palette.h"
#include "window/base/window_views.h"

class QAction;

namespace transillum::viewer {

/// The action that shows the command palette, and what the palette has: the actions of all menus,
/// panels, scenes, lessons, groups and materials of the open scene, and patches by their number.
class PaletteActions : public QObject {
  Q_OBJECT

 public:
  /// @param frame, docks must outlive this object
  PaletteActions(const WindowFrame& frame, DockLayouts& docks);

  QAction* action() const { return action_; }

 private:
  void show();
  std::vector<PaletteEntry> entries();
  void add_panels(std::vector<PaletteEntry>& entries);
  void add_quantities(std::vector<PaletteEntry>& entries);
  void add_surfaces(std::vector<PaletteEntry>& entries);
  std::vector<PaletteEntry> patch_of(const QString& query);

  WindowFrame frame_;
  DockLayouts& docks_;
  QAction* action_;
};

}  // namespace transillum::viewer
