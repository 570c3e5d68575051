// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <array>

#include "transillum/vec3.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QMenu;
class QPushButton;
class QToolButton;

namespace transillum::viewer {

class SceneEdits;

/// The panel "Move": what is edited, where it is, and what can be added. The target has handles in
/// the scene while the panel is shown.
class MovePanel : public QWidget {
  Q_OBJECT

 public:
  explicit MovePanel(SceneEdits& edits, QWidget* parent = nullptr);

  /// Steps of the grid and of arrow keys, m.
  double step() const;
  /// Whether drags go in steps.
  bool on_grid() const;
  /// Adds the edits that need no numbers.
  void add_to(QMenu& menu) const;

 private:
  using Fields = std::array<QDoubleSpinBox*, 3>;

  QWidget* make_fields(const char* name, Fields& fields);
  QWidget* make_buttons();
  void show_state();
  void place();
  void choose_step();

  SceneEdits& edits_;
  QComboBox* reach_;
  QLabel* note_;
  QWidget* numbers_;
  Fields center_{}, turn_{}, scale_{};
  QDoubleSpinBox* step_;
  QCheckBox* grid_;
  QAction *copy_, *remove_;
  QMenu* add_;
  Vec3 shown_extents_;
  bool shows_ = false;  ///< the fields are being set
};

}  // namespace transillum::viewer
