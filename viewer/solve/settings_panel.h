// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include <optional>

#include "model/run_options.h"
#include "transillum/solve_options.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;
class QSpinBox;
class QStackedWidget;

namespace transillum::viewer {

class RefineControls;
class RoundPanel;

/// Controls for the options of the next solve.
class SettingsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit SettingsPanel(QWidget* parent = nullptr);

  SolveOptions solve_options() const;
  SceneOptions scene_options() const;
  RefineChoice refinement() const;
  /// Whether the accuracy limits the sum of all errors, for which patches are divided.
  bool total() const;
  RunOptions options() const {
    return {solve_options(), scene_options(), {}, refinement(), false, total()};
  }
  /// Leaves refinement() as it is, and total() where the goal is about surfaces.
  void set_options(const SolveOptions& solve, const SceneOptions& scene);
  void set_options(const RunOptions& options);
  /// Sets the options of the current solve; the button is emphasized while the panel differs.
  void set_in_effect(const SolveOptions& solve, const SceneOptions& scene,
                     const RefineChoice& refine = {}, bool total = false);
  bool differ_from_effect() const;
  void set_restart_enabled(bool enabled);
  /// Sets the fraction of the light of all patches that escapes from the open scene; not set while
  /// it is unknown. If no light escapes, no sky is seen, and its controls are disabled.
  void show_escape(std::optional<double> fraction);
  /// Whether a sky would light the open scene, as far as is known.
  bool may_have_sky() const;
  /// Scrolls to the exitance of the sky, to be entered.
  void ask_for_sky();
  /// Sets the vertical of a new scene: the zenith that is proposed for a sky that needs one.
  void set_scene_up(const Vec3& up);
  /// Sets the lobes that materials of the open scene have.
  void set_scene_lobes(const Scene& scene);
  /// Sets whether the patches come from a result file, so that the scene options cannot change.
  void set_scene_fixed(bool fixed);
  /// The rounds of the current solve, below the button.
  RoundPanel* rounds() const { return rounds_; }
  /// Shows what scene_options() would make of the scene, unless they have changed since.
  /// @param text  empty if nothing is known
  void show_forecast(const SceneOptions& options, const QString& text);

 signals:
  void restart_clicked();
  /// The options differ from the options of the open scene, and show_forecast() is to be called.
  void forecast_wanted(const transillum::SceneOptions& options);

 private:
  void add_direction_rows(QFormLayout& form);
  void add_accuracy_row(QFormLayout& form);
  AccuracyGoal goal() const;
  void add_engine_rows(QFormLayout& form);
  void add_estimator_rows(QFormLayout& form);
  void add_sky_rows(QFormLayout& form);
  Sky sky() const;
  void set_sky(const Sky& sky);
  void choose_up(const Vec3& up);
  void show_sky_state();
  void show_basis_state();
  void show_glossy_state();
  QString note_on_lobes() const;
  void add_glossy_row(QFormLayout& form);
  void add_stop_row(QFormLayout& form);
  void connect_solve_rows();
  void add_scene_rows(QFormLayout& form);
  void show_state();
  void want_forecast();
  /// Shows or hides a row below the row of the engine.
  void show_row(QLabel* label, QWidget* field, bool shown);

  SolveOptions base_;  ///< carries options without a control, such as threads and memory
  SolveOptions solve_in_effect_;
  SceneOptions scene_in_effect_;
  RefineChoice refine_in_effect_;
  bool total_in_effect_ = false;
  bool fixed_ = false;  ///< set_scene_fixed()
  bool enabled_ = false;
  QFormLayout* form_;
  QSpinBox* directions_;
  QLineEdit* accuracy_;  ///< percent; empty if not asked for
  QComboBox* accuracy_of_;
  QComboBox* sampling_;
  QLineEdit* seed_;
  QComboBox* engine_;
  QSpinBox* resolution_;
  QComboBox* order_;
  QLabel *resolution_label_, *order_label_;
  QComboBox* pass_serves_;  ///< SolveOptions::two_way
  QComboBox* normalize_;
  QComboBox* basis_;
  QLabel* basis_note_;  ///< the chosen settings that the basis cannot be combined with
  QCheckBox* glossy_;
  QLabel* glossy_note_;
  std::optional<double> largest_exponent_;  ///< in the open scene; not set without lobes
  QComboBox* stop_at_;
  QStackedWidget* stop_value_;
  Rgb sky_color_{1, 1, 1};  ///< color of the sky; its largest channel is 1
  bool closed_ = false;     ///< no light escapes from the open scene
  QSlider* sky_slider_;
  QDoubleSpinBox* sky_value_;  ///< largest channel of the exitance
  QComboBox *sky_model_, *sky_up_;
  QLabel *sky_up_label_, *sky_note_;
  QLineEdit* tolerance_;
  QComboBox* scheme_ = nullptr;
  QSpinBox* replicas_ = nullptr;
  QSpinBox* iterations_;
  QCheckBox* two_sided_;
  QLineEdit* max_patch_area_;
  QLabel* forecast_;
  RefineControls* refine_;
  QPushButton* restart_ = nullptr;
  RoundPanel* rounds_;
};

}  // namespace transillum::viewer
