// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "window/base/window_views.h"

class QAction;
class QMenu;

namespace transillum::viewer {

/// Copies the shown solve, the map of the direction, or V at the step as a line for a shell.
class CommandActions : public QObject {
  Q_OBJECT

 public:
  /// The objects that `parts` refers to must outlive this object.
  CommandActions(const WindowFrame& frame, const MapView& view);

  void add_to(QMenu& menu) const;

 private:
  void copy_solve();
  void copy_map(std::optional<std::int32_t> steps);
  void copy_step();
  RunOptions options() const;

  WindowFrame frame_;
  const MapView& view_;
  QAction *solve_, *map_, *step_;
};

}  // namespace transillum::viewer
