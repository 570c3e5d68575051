// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Solve settings": which rows are shown, the notes on settings that they cannot be
// combined with, the states of the sections, and the cost of the next solve.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStackedWidget>
#include <algorithm>

#include "model/snapshot_values.h"
#include "solve/quality_controls.h"
#include "solve/refine_controls.h"
#include "solve/setting_tips.h"
#include "solve/settings_panel.h"
#include "solve/sun_controls.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "widgets/build.h"
#include "widgets/engine_text.h"
#include "widgets/fold.h"
#include "widgets/scrolling.h"
#include "widgets/setting_rows.h"

namespace transillum::viewer {

namespace {

const QString dot = QString::fromUtf8(FoldHeader::separator);

}  // namespace

bool SettingsPanel::has_effect(const char* setting) const {
  return why_unused(setting, {options()}).empty();
}

void SettingsPanel::show_state() {
  if (!made_) {
    return;
  }
  show_sky_state();
  show_basis_state();
  show_glossy_state();
  show_resolution_state();
  show_method_state();
  show_limits_state();
  refine_->set_available(!fixed_, total());
  refine_section_->setVisible(!fixed_);
  refine_section_->header()->set_state(refine_->state());
  quality_->show_state(takes_directions(engine_of(*engine_)),
                       QString::fromStdString(conflict_of("accuracy", options())));
  show_cost();
  show_button();
}

void SettingsPanel::show_method_state() {
  const SolveOptions solve = solve_options();
  const bool directions = takes_directions(solve.engine);
  const bool chosen = solve.goal.is_set();
  engine_->setToolTip(engine_sentence(solve.engine));
  SettingRows::show_row(order_, has_effect("order"));
  SettingRows::show_row(sampling_, directions);
  SettingRows::show_row(seed_, has_effect("seed"));
  SettingRows::show_row(pass_serves_, directions);
  SettingRows::show_row(replicas_, directions && !chosen);
  SettingRows::show_row(quality_->accuracy_of(), chosen);
  two_sided_->setVisible(!fixed_);
  QStringList parts{engine_->currentText()};
  if (directions) {
    parts << sampling_->currentText();
  }
  if (solve.basis != Basis::constant) {
    parts << basis_->currentText();
  }
  if (solve.scheme != Scheme::fixed) {
    parts << scheme_->currentText();
  }
  if (glossy_->isChecked()) {
    parts << tr("lobes");
  }
  if (two_sided_->isChecked()) {
    parts << tr("two-sided");
  }
  method_->header()->set_state(parts.join(dot));
}

void SettingsPanel::show_resolution_state() {
  SettingRows::show_row(resolution_, has_effect("resolution"));
  const bool rays = traits_of(engine_of(*engine_)).error == EngineTraits::Error::statistical;
  resolution_->setSpecialValueText(
      rays ? tr("%1 rays per patch").arg(solve_in_effect_.engine_options.lines_per_patch)
           : tr("Default: %1 px").arg(EngineOptions::default_resolution));
  resolution_->setToolTip(
      rays ? tr("Pixels along the longer side of the projected scene, one ray through each;\n"
                "the smallest value sets a number of rays per patch instead")
           : tr("Pixels along the longer side of the projected scene"));
}

void SettingsPanel::show_escape(std::optional<double> fraction) {
  constexpr double rounding = 1e-9;
  closed_ = fraction && *fraction < rounding;
  show_state();
}

bool SettingsPanel::may_have_sky() const {
  return !closed_ && takes_directions(engine_of(*engine_));
}

void SettingsPanel::ask_for_sky() {
  sky_section_->set_open(true);
  scroll_to(sky_value_);
  sky_value_->setFocus();
  sky_value_->selectAll();
}

void SettingsPanel::show_sky_state() {
  const bool any = may_have_sky() && sky_value_->value() > 0;
  const Sun sun = sun_->sun(zenith());
  FoldHeader& header = *sky_section_->header();
  sky_section_->setVisible(!closed_);
  if (!closed_) {
    QStringList parts;
    if (any) {
      parts << tr("%1 W/m²").arg(number_text(sky_value_->value())) << sky_model_->currentText();
    }
    if (sun.is_set()) {
      parts << tr("sun %1 W/m²").arg(number_text(max_abs(sun.irradiance)));
    } else if (sun.below_horizon) {
      parts << tr("night");
    }
    header.set_state(parts.isEmpty() ? tr("none") : parts.join(dot));
  }
  // Engines without directions see the sun alone.
  SettingRows::show_row(sky_value_->parentWidget(), may_have_sky());
  SettingRows::show_row(sky_model_, any);
  SettingRows::show_row(sky_up_, any && sky_model_->currentIndex() != 0);
}

void SettingsPanel::show_limits_state() {
  stop_value_->setCurrentIndex(stop_at_->currentIndex());
  SettingRows::show_row(max_patch_area_, !fixed_);
  const bool by_number = stop_at_->currentIndex() == 1;
  QStringList parts{by_number ? tr("%1 iterations").arg(count_text(iterations_->value()))
                              : tr("tolerance %1").arg(tolerance_->text())};
  if (scene_options().max_patch_area > 0 && !fixed_) {
    parts << tr("%1 m²").arg(number_text(scene_options().max_patch_area));
  }
  limits_->header()->set_state(parts.join(dot));
}

void SettingsPanel::show_basis_state() {
  const QString note = QString::fromStdString(conflict_of("basis", options()));
  basis_note_->setText(note);
  basis_note_->setVisible(!note.isEmpty());
  if (!note.isEmpty()) {
    method_->set_open(true);  // a conflict has to be seen
  }
}

void SettingsPanel::show_glossy_state() {
  SettingRows::show_row(glossy_column_, glossy_->isChecked() || largest_exponent_);
  glossy_note_->setText(glossy_->isChecked() ? note_on_lobes()
                        : largest_exponent_  ? tr("the scene has lobes")
                                             : QString());
  glossy_note_->setVisible(!glossy_note_->text().isEmpty());
}

QString SettingsPanel::note_on_lobes() const {
  QString obstacle = QString::fromStdString(conflict_of("glossy", options()));
  if (!obstacle.isEmpty()) {
    return obstacle;
  }
  if (!largest_exponent_) {
    return tr("no material has a lobe");
  }
  if (options().solve.goal.is_set()) {
    return {};  // the accuracy chooses M
  }
  const int replicas = options().solve.replicas;
  return *largest_exponent_ > resolved_exponent(quality_->directions() / replicas)
             ? tr("n = %1 needs M = %2")
                   .arg(number_text(*largest_exponent_),
                        number_text(10 * *largest_exponent_ * replicas))
             : QString();
}

void SettingsPanel::set_scene(const Scene& scene) {
  patch_count_ = scene.patch_count();
  largest_exponent_.reset();
  for (const Patch& patch : scene.patches()) {
    const Lobe lobe = used_lobe(at(scene.materials(), patch.material));
    if (lobe.present()) {
      largest_exponent_ = std::max(largest_exponent_.value_or(0), equivalent_exponent(lobe));
    }
  }
  in_effect_ = nullptr;
  show_state();
}

void SettingsPanel::show_cost() {
  patches_row_->setVisible(!fixed_);
  const bool unchanged = scene_options().two_sided == scene_in_effect_.two_sided &&
                         scene_options().max_patch_area == scene_in_effect_.max_patch_area;
  const std::optional<std::int64_t> patches = unchanged ? std::optional(patch_count_) : forecast_;
  if (patches_wanted_ == 0 && !patches_->hasFocus()) {
    const QSignalBlocker quiet(patches_);
    const bool divided = scene_options().max_patch_area > 0;
    patches_->setValue(divided && patches
                           ? static_cast<int>(std::min<std::int64_t>(*patches, patches_->maximum()))
                           : 0);
  }
  cost_->setText(patches_wanted_ > 0 || !patches ? tr("Counting patches…")
                 : *patches == 0                 ? QString()
                                 : cost_text(cost_of(in_effect_.get(), solve_options(), *patches)));
  using Choice = QualityControls::Choice;
  for (const Choice choice : {Choice::draft, Choice::normal, Choice::fine}) {
    // The stages of a solve to a total error are not known before.
    const bool known = patches && patches_wanted_ == 0 && (choice == Choice::draft || !total());
    quality_->show_cost(
        choice, known ? short_time_text(cost_of(in_effect_.get(),
                                                quality_->with(solve_options(), choice), *patches))
                      : QString());
  }
}

void SettingsPanel::show_button() {
  const bool differs = enabled_ && differ_from_effect();
  enable_if(*restart_, enabled_, tr("No scene is open yet, or one is being loaded"));
  restart_->setDefault(differs);
  QFont font = restart_->font();
  font.setBold(differs);
  restart_->setFont(font);
  enable_if(*how_wrong_, in_effect_ && in_effect_->progress.finished && has_light(*in_effect_),
            tr("Errors are measured for a solve that has ended, of a scene with light"));
}

}  // namespace transillum::viewer
