// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Materials": sliders for E and rho of one material. A moved slider changes
// MaterialEdits; Relighting then finds the new B from the solve's form factors.
#include "patches/material_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <iterator>
#include <utility>

#include "transillum/at.h"
#include "widgets/channel_sliders.h"

namespace transillum::viewer {

namespace {

constexpr double largest_reflectance = 0.99;

// The upper end of the exitance sliders: above every exitance of the scene, and not 0.
double slider_exitance(const std::vector<Material>& materials) {
  double largest = 0;
  for (const Material& material : materials) {
    largest = std::max(largest, max_abs(material.exitance));
  }
  return largest > 0 ? 4 * largest : 10;
}

QLabel* make_note(const char* name) {
  auto* note = new QLabel;
  note->setObjectName(QString::fromLatin1(name));
  note->setWordWrap(true);
  note->setForegroundRole(QPalette::PlaceholderText);
  return note;
}

}  // namespace

MaterialPanel::MaterialPanel(Relighting& relighting, const Selection& selection,
                             const ColorChoice& colors, QWidget* parent)
    : QWidget(parent), relighting_(relighting), selection_(selection), colors_(colors) {
  obstacle_ = make_note("material_words");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 6, 12, 6);
  layout->setSpacing(6);
  layout->addLayout(make_choice());
  layout->addWidget(obstacle_);
  layout->addWidget(make_sliders());
  layout->addStretch(1);
  connect_edits();
  show_state();
}

QLayout* MaterialPanel::make_choice() {
  material_ = new QComboBox;
  material_->setObjectName("material");
  material_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  material_->setMinimumContentsLength(6);
  restore_ = new QPushButton(tr("As in the scene"));
  restore_->setObjectName("restore_materials");
  restore_->setToolTip(tr("Undo all changes to materials"));
  auto* choice = new QHBoxLayout;
  choice->setSpacing(6);
  choice->addWidget(material_, 1);
  choice->addWidget(restore_);
  return choice;
}

QWidget* MaterialPanel::make_sliders() {
  reflectance_ = new ChannelSliders("rho", tr("Reflectance ρ"), 3);
  exitance_ = new ChannelSliders("exitance", tr("Emitted exitance E, W/m²"), 2);
  account_ = make_note("material_account");
  exposure_ = new QLabel(tr("Auto exposure hides this: turn off Auto."));
  exposure_->setToolTip(
      tr("Automatic exposure adjusts the picture to each change of E. Auto is above the scene."));
  exposure_->setObjectName("material_exposure");
  exposure_->setWordWrap(true);

  sliders_ = new QWidget;
  sliders_->setToolTip(
      tr("Change the material; B is recomputed from the form factors, without a "
         "new pass"));
  auto* column = new QVBoxLayout(sliders_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(account_);
  column->addWidget(reflectance_);
  column->addWidget(exitance_);
  column->addWidget(exposure_);
  return sliders_;
}

void MaterialPanel::connect_edits() {
  MaterialEdits& edits = relighting_.edits();
  for (ChannelSliders* sliders : {reflectance_, exitance_}) {
    connect(sliders, &ChannelSliders::drag_began, &edits, &MaterialEdits::begin_drag);
  }
  connect(reflectance_, &ChannelSliders::moved, this, [this, &edits](const Rgb& value) {
    edits.set(material(), at(edits.materials(), material()).exitance, value);
  });
  connect(exitance_, &ChannelSliders::moved, this, [this, &edits](const Rgb& value) {
    edits.set(material(), value, at(edits.materials(), material()).reflectance);
  });
  connect(restore_, &QPushButton::clicked, &edits, &MaterialEdits::restore);
  connect(material_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &MaterialPanel::show_material);
  connect(&edits, &MaterialEdits::changed, this, &MaterialPanel::show_material);
  connect(&colors_, &ColorChoice::changed, this, &MaterialPanel::show_state);
  connect(&selection_, &Selection::changed, this, [this](PatchId patch) {
    if (scene_ && patch != no_patch) {
      material_->setCurrentIndex(scene_->patch(patch).material);
    }
  });
}

int MaterialPanel::material() const { return material_->currentIndex(); }

void MaterialPanel::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  material_->clear();
  for (const Material& material : scene_->materials()) {
    material_->addItem(QString::fromStdString(material.name));
  }
  show_material();
}

void MaterialPanel::show_state() {
  const QString reason = relighting_.reason_unavailable();
  sliders_->setEnabled(reason.isEmpty() && material() >= 0);
  obstacle_->setText(reason);
  obstacle_->setHidden(reason.isEmpty());
  account_->setText(relighting_.method_note());
  account_->setHidden(account_->text().isEmpty());
  exposure_->setVisible(exposure_hides_change());
}

bool MaterialPanel::exposure_hides_change() const {
  const MaterialEdits& edits = relighting_.edits();
  const bool changed =
      !std::equal(edits.materials().begin(), edits.materials().end(), edits.originals().begin(),
                  [](const Material& a, const Material& b) { return a.exitance == b.exitance; });
  return changed && colors_.exposure_is_automatic() &&
         colors_.scale().mode == ColorMode::true_color;
}

void MaterialPanel::show_material() {
  const MaterialEdits& edits = relighting_.edits();
  restore_->setEnabled(edits.any());
  if (material() >= 0 && material() < std::ssize(edits.materials())) {
    const Material& shown = at(edits.materials(), material());
    reflectance_->show_value(shown.reflectance, largest_reflectance);
    exitance_->show_value(shown.exitance, slider_exitance(edits.originals()));
  }
  show_state();
}

}  // namespace transillum::viewer
