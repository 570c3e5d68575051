// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "transillum/radiosity.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QStackedWidget;

namespace transillum::viewer {

/// The options of the next solve.
class SettingsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit SettingsPanel(QWidget* parent = nullptr);

  SolveOptions solve_options() const;
  SceneOptions scene_options() const;
  void set_options(const SolveOptions& solve, const SceneOptions& scene);
  /// What the solve under way was begun with: the button asks for attention where the panel
  /// differs.
  void set_in_effect(const SolveOptions& solve, const SceneOptions& scene);
  bool differ_from_effect() const;
  void set_restart_enabled(bool enabled);
  /// Whether the open scene's patches cannot be made anew, being those of a result.
  void set_scene_fixed(bool fixed);

 signals:
  void restart_clicked();

 private:
  void add_solve_rows(QFormLayout& form);
  void add_scene_rows(QFormLayout& form);
  void show_state();
  void show_row(QWidget* field, bool shown);

  SolveOptions base_;  ///< carries what has no control here: threads and memory
  SolveOptions solve_in_effect_;
  SceneOptions scene_in_effect_;
  bool enabled_ = false;
  QFormLayout* form_;
  QSpinBox* directions_;
  QComboBox* sampling_;
  QSpinBox* seed_;
  QComboBox* engine_;
  QSpinBox* resolution_;
  QComboBox* order_;
  QComboBox* ways_;
  QComboBox* normalize_;
  QComboBox* stop_at_;
  QStackedWidget* stop_value_;
  QLineEdit* tolerance_;
  QComboBox* scheme_ = nullptr;
  QSpinBox* replicas_ = nullptr;
  QSpinBox* iterations_;
  QCheckBox* two_sided_;
  QDoubleSpinBox* max_patch_area_;
  QPushButton* restart_ = nullptr;
};

}  // namespace transillum::viewer
