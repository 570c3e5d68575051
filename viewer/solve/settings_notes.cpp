// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Solve settings": bases and lobes, the notes on settings that they cannot be
// combined with, and rows that are hidden.
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>
#include <algorithm>

#include "solve/settings_panel.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "widgets/build.h"

namespace transillum::viewer {

void SettingsPanel::add_glossy_row(QFormLayout& form) {
  glossy_ = named("glossy", new QCheckBox(tr("Lobes reflect too")),
                  tr("<span>Off: all surfaces are diffuse, and reflect ρ only. On: the lobes of "
                     "materials (MTL: Ks with Ns or Pr; glTF: metal and roughness) reflect too, "
                     "most of it about the mirror direction. Patches then keep light by direction, "
                     "and look different from each point. M directions resolve exponents n up to "
                     "about M/10; sharper lobes are coarse.</span>"));
  glossy_note_ = named("glossy_note", note_label());
  glossy_note_->hide();
  auto* column = make_column({}, 2);
  column->addWidget(glossy_);
  column->addWidget(glossy_note_);
  form.addRow(tr("Glossy"), column);
}

void SettingsPanel::show_basis_state() {
  const QString note = QString::fromStdString(conflict_of("basis", options()));
  basis_note_->setText(note);
  basis_note_->setVisible(!note.isEmpty());
}

void SettingsPanel::show_glossy_state() {
  glossy_note_->setText(glossy_->isChecked() ? note_on_lobes()
                        : largest_exponent_  ? tr("the scene has lobes")
                                             : QString());
  glossy_note_->setVisible(!glossy_note_->text().isEmpty());
}

QString SettingsPanel::note_on_lobes() const {
  const QString obstacle = QString::fromStdString(conflict_of("glossy", options()));
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
  return *largest_exponent_ > resolved_exponent(directions_->value() / replicas)
             ? tr("n = %1 needs M = %2")
                   .arg(number_text(*largest_exponent_),
                        number_text(10 * *largest_exponent_ * replicas))
             : QString();
}

void SettingsPanel::set_scene_lobes(const Scene& scene) {
  largest_exponent_.reset();
  for (const Patch& patch : scene.patches()) {
    const Lobe lobe = used_lobe(at(scene.materials(), patch.material));
    if (lobe.present()) {
      largest_exponent_ = std::max(largest_exponent_.value_or(0), equivalent_exponent(lobe));
    }
  }
  show_glossy_state();
}

// A hidden row would leave its spacing.
void SettingsPanel::show_row(QLabel* label, QWidget* field, bool shown) {
  const bool in_form = form_->indexOf(field) >= 0;
  if (shown && !in_form) {
    int row = 0;
    form_->getWidgetPosition(engine_, &row, nullptr);
    form_->insertRow(row + 1, label, field);
  } else if (!shown && in_form) {
    const QFormLayout::TakeRowResult row = form_->takeRow(field);
    delete row.labelItem;
    delete row.fieldItem;
  }
  label->setVisible(shown);
  field->setVisible(shown);
}

}  // namespace transillum::viewer
