// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/material_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "widgets/channel_sliders.h"

namespace transillum::viewer {

namespace {

constexpr double most_reflectance = 0.99;

// The slider's end: some way above what the scene has, so that a dark material can be lit too.
double most_exitance(const std::vector<Material>& materials) {
  double most = 0;
  for (const Material& material : materials) {
    most = std::max(most, max_abs(material.exitance));
  }
  return most > 0 ? 4 * most : 10;
}

}  // namespace

MaterialPanel::MaterialPanel(Relighting& relighting, const Selection& selection,
                             const ColorChoice& colors, QWidget* parent)
    : QWidget(parent), relighting_(relighting), selection_(selection), colors_(colors) {
  material_ = new QComboBox;
  material_->setObjectName("material");
  material_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  material_->setMinimumContentsLength(6);
  words_ = new QLabel;
  words_->setObjectName("material_words");
  words_->setWordWrap(true);
  words_->setForegroundRole(QPalette::PlaceholderText);
  reflectance_ = new ChannelSliders("rho", tr("Reflectance ρ"), 3);
  exitance_ = new ChannelSliders("exitance", tr("Emitted exitance E, W/m²"), 2);
  restore_ = new QPushButton(tr("As in the scene"));
  restore_->setObjectName("restore_materials");
  restore_->setToolTip(tr("Take back all changes of materials"));
  sliders_ = new QWidget;
  sliders_->setToolTip(tr("B follows from the kept form factors, without a new pass"));
  auto* column = new QVBoxLayout(sliders_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  account_ = new QLabel;
  account_->setObjectName("material_account");
  account_->setWordWrap(true);
  account_->setForegroundRole(QPalette::PlaceholderText);
  column->addWidget(account_);
  column->addWidget(reflectance_);
  column->addWidget(exitance_);
  exposure_ = new QLabel(tr("Auto exposure hides this: untick Auto."));
  exposure_->setToolTip(
      tr("The picture is exposed anew for every light. Auto stands above the scene."));
  exposure_->setObjectName("material_exposure");
  exposure_->setWordWrap(true);
  column->addWidget(exposure_);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 6, 12, 6);
  layout->setSpacing(6);
  auto* choice = new QHBoxLayout;
  choice->setSpacing(6);
  choice->addWidget(material_, 1);
  choice->addWidget(restore_);
  layout->addLayout(choice);
  layout->addWidget(words_);
  layout->addWidget(sliders_);
  layout->addStretch(1);

  MaterialEdits& edits = relighting_.edits();
  for (ChannelSliders* sliders : {reflectance_, exitance_}) {
    connect(sliders, &ChannelSliders::drag_began, &edits, &MaterialEdits::begin_drag);
  }
  connect(reflectance_, &ChannelSliders::moved, this, [this, &edits](const Rgb& value) {
    const auto m = static_cast<std::size_t>(material());
    edits.set(material(), edits.materials()[m].exitance, value);
  });
  connect(exitance_, &ChannelSliders::moved, this, [this, &edits](const Rgb& value) {
    const auto m = static_cast<std::size_t>(material());
    edits.set(material(), value, edits.materials()[m].reflectance);
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
  show_state();
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
  const QString obstacle = relighting_.obstacle();
  sliders_->setEnabled(obstacle.isEmpty() && material() >= 0);
  words_->setText(obstacle);
  words_->setHidden(obstacle.isEmpty());
  account_->setText(relighting_.account());
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
  const auto m = static_cast<std::size_t>(material());
  restore_->setEnabled(edits.any());
  if (material() >= 0 && m < edits.materials().size()) {
    reflectance_->show_value(edits.materials()[m].reflectance, most_reflectance);
    exitance_->show_value(edits.materials()[m].exitance, most_exitance(edits.originals()));
  }
  show_state();
}

}  // namespace transillum::viewer
