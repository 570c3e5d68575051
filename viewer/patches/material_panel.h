// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "colors/color_choice.h"
#include "model/relighting.h"
#include "state/selection.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace transillum::viewer {

class ChannelSliders;

/// E and rho of a material by sliders: the light follows without a new pass.
class MaterialPanel : public QWidget {
  Q_OBJECT

 public:
  MaterialPanel(Relighting& relighting, const Selection& selection, const ColorChoice& colors,
                QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);
  /// There may be form factors now.
  void show_state();

 private:
  void show_material();
  /// Whether the picture is exposed so that changed lamps look the same.
  bool exposure_hides_change() const;
  int material() const;

  Relighting& relighting_;
  const Selection& selection_;
  const ColorChoice& colors_;
  std::shared_ptr<const Scene> scene_;
  QComboBox* material_;
  QLabel* words_;
  QLabel* account_;  ///< what the light is found from
  QLabel* exposure_;
  QWidget* sliders_;
  ChannelSliders *reflectance_, *exitance_;
  QPushButton* restore_;
};

}  // namespace transillum::viewer
