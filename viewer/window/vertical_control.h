// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <optional>
#include <string>

#include "transillum/vec3.h"
#include "window/base/window_views.h"

class QActionGroup;
class QPushButton;

namespace transillum::viewer {

struct LoadedScene;

/// The one vertical of the open scene: a menu and a bar choose it, and the camera and the zenith of
/// the sky follow it.
class VerticalControl : public QObject {
  Q_OBJECT

 public:
  /// @param frame, settings must outlive this object
  VerticalControl(const WindowFrame& frame, SettingsPanel& settings);

  /// Sets the vertical of the next scene that is opened.
  void prefer(const Vec3& up) { preferred_ = up; }
  /// Begins with a new scene; to be called before views show it. A scene that is read again keeps
  /// its vertical.
  void show_scene(const LoadedScene& loaded);

 private:
  void make_menu();
  void follow();
  /// The vertical that the scene's format, or a sky that is set, tells.
  std::optional<Vec3> known_of(const LoadedScene& loaded);

  WindowFrame frame_;
  SettingsPanel& settings_;
  QActionGroup* choices_;
  QPushButton* turn_;
  std::optional<Vec3> preferred_;
  std::string spec_;  ///< the scene whose vertical is shown
};

}  // namespace transillum::viewer
