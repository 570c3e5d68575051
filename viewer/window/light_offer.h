// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "window/window_parts.h"

class QMenu;
class QPushButton;

namespace transillum::viewer {

class MaterialPanel;
class ViewStateApplier;

/// The bar above a scene in which nothing emits. It says so, and lets the user make the selected
/// face, its material or its group emit. It is hidden once anything emits.
class LightOffer : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  LightOffer(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
             MaterialPanel& materials, ViewStateApplier& applier);

 private:
  void update();
  void fill_menu();
  void add_target(const QString& text, const std::string& target);
  /// Gives a target an exitance, and shows its sliders.
  void make_emit(const std::string& target);

  WindowFrame frame_;
  DockLayouts& docks_;
  SettingsPanel& settings_;
  MaterialPanel& materials_;
  ViewStateApplier& applier_;
  QMenu* menu_;
  bool closed_ = false;  ///< by the user, for the open scene
};

}  // namespace transillum::viewer
