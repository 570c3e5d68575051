// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "relighting.h"
#include "selection.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace transillum::viewer {

class ChannelSliders;

/// E and rho of a material by sliders: the light follows without a new pass.
class MaterialPanel : public QWidget {
  Q_OBJECT

 public:
  MaterialPanel(Relighting& relighting, const Selection& selection, QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);
  /// There may be form factors now.
  void show_state();

 private:
  void show_material();
  int material() const;

  Relighting& relighting_;
  const Selection& selection_;
  std::shared_ptr<const Scene> scene_;
  QComboBox* material_;
  QLabel* words_;
  QLabel* account_;  ///< what the light is found from
  QWidget* sliders_;
  ChannelSliders *reflectance_, *exitance_;
  QPushButton* restore_;
};

}  // namespace transillum::viewer
