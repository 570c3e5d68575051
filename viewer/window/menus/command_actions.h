// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "window/base/window_views.h"

class QAction;
class QMenu;

namespace transillum::viewer {

/// Copies the shown solve, its picture, the map of the direction, or V at the step as a line for a
/// shell.
class CommandActions : public QObject {
  Q_OBJECT

 public:
  /// The objects that `frame` refers to must outlive this object.
  /// @param saved  asks to save edited faces; returns whether a command can name the scene
  CommandActions(const WindowFrame& frame, const MapView& view, std::function<bool()> saved);

  void add_to(QMenu& menu) const;

 private:
  void show_state();
  void copy_solve();
  void copy_picture();
  std::string solve() const;
  void copy_map(std::optional<std::int32_t> steps);
  void copy_step();
  RunOptions options() const;
  /// The changed materials that are not in the scene's file.
  std::vector<MaterialChange> changes() const;

  WindowFrame frame_;
  const MapView& view_;
  std::function<bool()> saved_;
  QAction *solve_, *picture_, *map_, *step_;
};

}  // namespace transillum::viewer
