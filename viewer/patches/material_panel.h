// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <string>

#include "colors/color_choice.h"
#include "model/requests/relighting.h"
#include "state/selection.h"

class QComboBox;
class QLabel;
class QLayout;
class QPushButton;

namespace transillum::viewer {

class ChannelSliders;
class GlossSlider;

/// Sliders for E and rho of a material, a group of faces or a face; B is recomputed without a new
/// pass.
class MaterialPanel : public QWidget {
  Q_OBJECT

 public:
  MaterialPanel(Relighting& relighting, const Selection& selection, ColorChoice& colors,
                QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);
  /// Shows the sliders of a target of MaterialEdits.
  void show_target(const std::string& target);
  /// To be called when form factors may have become available.
  void show_state();

 private:
  QLayout* make_choice();
  QWidget* make_sliders();
  void connect_edits();
  void fill_kinds();
  /// Lists the names of the chosen kind; `patch`, if any, selects one.
  void fill_names(PatchId patch);
  void show_values();
  void show_lobe(const Material& shown);
  QString extent_text() const;
  /// Ends automatic exposure, which would compensate a change, so that the picture stays the same.
  void hold_exposure();
  void release_exposure();
  TargetKind kind() const;
  /// Empty if nothing is chosen.
  std::string target() const;

  Relighting& relighting_;
  const Selection& selection_;
  ColorChoice& colors_;
  std::shared_ptr<const Scene> scene_;
  QComboBox *kind_, *name_;
  QLabel* extent_;    ///< how many patches the target has, and whether they differ
  QLabel* obstacle_;  ///< why materials cannot be changed now
  QLabel* account_;   ///< note on the source of B
  QWidget* sliders_;
  ChannelSliders *reflectance_, *lobe_, *exitance_;
  GlossSlider* gloss_;
  QPushButton* restore_;
  bool holds_exposure_ = false;  ///< which was automatic before
};

}  // namespace transillum::viewer
