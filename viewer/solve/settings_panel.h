// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include <optional>
#include <vector>

#include "model/run_options.h"
#include "solve/solve_cost.h"
#include "transillum/solve_options.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;
class QSpinBox;
class QStackedWidget;

namespace transillum::viewer {

class Fold;
class QualityControls;
class RefineControls;
class RoundPanel;
class SettingRows;
class SunControls;
struct SunOfDay;

/// Controls for the options of the next solve: quality, patches and the button on top, the others
/// below in sections that can be folded. A setting that has no effect is not shown.
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
    return {.solve = solve_options(),
            .scene = scene_options(),
            .refine = refinement(),
            .total = total()};
  }
  /// The number of patches that the user has asked for, while set_patch_area() is awaited; else 0.
  std::int64_t patches_wanted() const { return patches_wanted_; }
  /// Leaves refinement() as it is, and total() where the goal is about surfaces.
  void set_options(const SolveOptions& solve, const SceneOptions& scene);
  void set_options(const RunOptions& options);
  /// Sets the solve that is shown; the button is emphasized while the panel differs.
  void set_in_effect(const std::shared_ptr<const SolverSnapshot>& snapshot,
                     const SceneOptions& scene);
  bool differ_from_effect() const;
  /// SunControls::day(), with the zenith of the sky.
  std::vector<SunOfDay> sun_through_day(int count) const;
  void set_restart_enabled(bool enabled);
  /// Sets the fraction of the light of all patches that escapes from the open scene; not set while
  /// it is unknown. If no light escapes, no sky is seen, and its section is hidden.
  void show_escape(std::optional<double> fraction);
  /// Whether a sky would light the open scene, as far as is known.
  bool may_have_sky() const;
  /// Unfolds the sky, and scrolls to its exitance, to be entered.
  void ask_for_sky();
  /// Sets the vertical of the scene, which is the zenith of a sky.
  void set_scene_up(const Vec3& up);
  /// Sets the open scene, whose patches and lobes the panel tells.
  void set_scene(const Scene& scene);
  /// Sets whether the patches come from a result file, so that the scene options cannot change.
  void set_scene_fixed(bool fixed);
  /// The rounds of the current solve, below the sections.
  RoundPanel* rounds() const { return rounds_; }
  /// Shows what scene_options() would make of the scene, unless they have changed since.
  void show_forecast(const SceneOptions& options, std::int64_t patches);
  /// Sets the limit of the area that gives the number of patches asked for, unless another number
  /// has been asked for since. @param patches  number of patches with this limit
  void set_patch_area(std::int64_t wanted, double area, std::int64_t patches);

 signals:
  void restart_clicked();
  /// The errors of the solve that is shown are to be measured.
  void errors_wanted();
  /// The user has chosen the zenith of the sky.
  void zenith_chosen(const transillum::Vec3& up);
  /// The user has moved the sun, or changed its irradiance.
  void sun_moved();
  /// The options differ from the options of the open scene, and show_forecast() is to be called; or
  /// set_patch_area() where patches_wanted() is not 0.
  void forecast_wanted(const transillum::SceneOptions& options);

 private:
  void add_top();
  void add_method();
  void add_engine_rows(SettingRows& rows);
  void add_direction_rows(SettingRows& rows);
  void add_estimator_rows(SettingRows& rows);
  void add_sky();
  Vec3 zenith() const;
  Sky sky() const;
  void set_sky(const Sky& sky);
  void choose_up(const Vec3& up);
  void add_limits();
  void connect_changes();
  void add_section(Fold* fold);
  void want_patches(int patches);
  void want_forecast();
  void show_state();
  void show_method_state();
  void show_sky_state();
  void show_basis_state();
  void show_glossy_state();
  void show_resolution_state();
  void show_limits_state();
  void show_button();
  void show_cost();
  QString note_on_lobes() const;
  bool has_effect(const char* setting) const;

  SolveOptions base_;  ///< carries options without a control, such as threads and memory
  std::shared_ptr<const SolverSnapshot> in_effect_;
  SolveOptions solve_in_effect_;
  SceneOptions scene_in_effect_;
  RefineChoice refine_in_effect_;
  bool total_in_effect_ = false;
  bool fixed_ = false;  ///< set_scene_fixed()
  bool enabled_ = false;
  bool made_ = false;                       ///< all controls exist
  std::int64_t patches_wanted_ = 0;         ///< patches_wanted()
  std::int64_t patch_count_ = 0;            ///< patches of the open scene; 0 without one
  std::optional<std::int64_t> forecast_;    ///< patches that scene_options() makes, if known
  std::optional<double> largest_exponent_;  ///< in the open scene; not set without lobes
  Rgb sky_color_{1, 1, 1};                  ///< color of the sky; its largest channel is 1
  Vec3 other_zenith_{0, 0, 1};              ///< where it is not along an axis
  bool closed_ = false;                     ///< no light escapes from the open scene

  QualityControls* quality_;
  QSpinBox* patches_;
  QWidget* patches_row_;
  QLabel* cost_;
  QPushButton* restart_;
  QPushButton* how_wrong_;  ///< enabled for a solve that has ended
  QWidget* sections_;
  Fold *method_, *sky_section_, *refine_section_, *limits_;
  QComboBox* sampling_;
  QLineEdit* seed_;
  QComboBox* engine_;
  QSpinBox* resolution_;
  QComboBox* order_;
  QComboBox* pass_serves_;  ///< SolveOptions::two_way
  QComboBox* normalize_;
  QComboBox* basis_;
  QLabel* basis_note_;  ///< the chosen settings that the basis cannot be combined with
  QCheckBox* glossy_;
  QLabel* glossy_note_;
  QWidget* glossy_column_;
  QComboBox* stop_at_;
  QStackedWidget* stop_value_;
  QSlider* sky_slider_;
  QDoubleSpinBox* sky_value_;  ///< largest channel of the exitance
  QComboBox *sky_model_, *sky_up_;
  SunControls* sun_;
  QLineEdit* tolerance_;
  QComboBox* scheme_;
  QSpinBox* replicas_;
  QSpinBox* iterations_;
  QCheckBox* two_sided_;
  QLineEdit* max_patch_area_;
  RefineControls* refine_;
  RoundPanel* rounds_;
};

}  // namespace transillum::viewer
