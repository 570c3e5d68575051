// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "colors/color_choice.h"
#include "model/relighting.h"
#include "state/selection.h"

class QComboBox;
class QLabel;
class QLayout;
class QPushButton;

namespace transillum::viewer {

class ChannelSliders;

/// Sliders for E and rho of a material; B is recomputed without a new pass.
class MaterialPanel : public QWidget {
  Q_OBJECT

 public:
  MaterialPanel(Relighting& relighting, const Selection& selection, const ColorChoice& colors,
                QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);
  /// To be called when form factors may have become available.
  void show_state();

 private:
  QLayout* make_choice();
  QWidget* make_sliders();
  void connect_edits();
  void show_material();
  /// Whether automatic exposure compensates a change of E, so that the picture stays the same.
  bool exposure_hides_change() const;
  int material() const;

  Relighting& relighting_;
  const Selection& selection_;
  const ColorChoice& colors_;
  std::shared_ptr<const Scene> scene_;
  QComboBox* material_;
  QLabel* obstacle_;  ///< why materials cannot be changed now
  QLabel* account_;   ///< what B is computed from
  QLabel* exposure_;  ///< shown while exposure_hides_change()
  QWidget* sliders_;
  ChannelSliders *reflectance_, *exitance_;
  QPushButton* restore_;
};

}  // namespace transillum::viewer
