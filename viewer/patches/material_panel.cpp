// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Materials": sliders for E and rho of one material, group or face. A moved slider
// changes MaterialEdits; Relighting then finds the new B from the solve's form factors.
#include "patches/material_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QPushButton>
#include <QSet>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/channel_sliders.h"
#include "widgets/elided.h"
#include "widgets/gloss_slider.h"

namespace transillum::viewer {

namespace {

constexpr double largest_reflectance = 0.99;

// The upper end of the exitance sliders: above every exitance of the scene, and not 0.
double slider_exitance(const std::vector<Material>& materials) {
  double largest = 0;
  for (const Material& material : materials) {
    largest = std::max(largest, max_abs(material.exitance));
  }
  return largest > 0 ? 4 * largest : 40;
}

QLabel* make_note(const char* name) {
  auto* note = named(name, note_label());
  return note;
}

}  // namespace

MaterialPanel::MaterialPanel(Relighting& relighting, const Selection& selection,
                             ColorChoice& colors, QWidget* parent)
    : QWidget(parent), relighting_(relighting), selection_(selection), colors_(colors) {
  obstacle_ = make_note("material_words");
  auto* layout = make_column(this, {12, 6, 12, 6}, 6);
  layout->addLayout(make_choice());
  layout->addWidget(obstacle_);
  layout->addWidget(make_sliders());
  layout->addStretch(1);
  connect_edits();
  show_state();
}

QLayout* MaterialPanel::make_choice() {
  kind_ =
      named("material_kind", new QComboBox,
            tr("Choose what the sliders change: a material, a group of faces or a single face"));
  name_ = named("material", new ElidedComboBox,
                tr("Click a patch in the scene to choose what it belongs to"));
  name_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  name_->setMinimumContentsLength(6);
  extent_ = make_note("material_extent");
  restore_ = named("restore_materials", new QPushButton(tr("As in the scene")),
                   tr("Undo all changes to materials"));
  auto* extent_row = new QHBoxLayout;
  extent_row->addWidget(extent_, 1);
  extent_row->addWidget(restore_);
  auto* choice = new QGridLayout;
  choice->setSpacing(6);
  choice->setColumnStretch(1, 1);
  choice->addWidget(kind_, 0, 0);
  choice->addWidget(name_, 0, 1);
  choice->addLayout(extent_row, 1, 0, 1, 2);
  return choice;
}

QWidget* MaterialPanel::make_sliders() {
  reflectance_ = new ChannelSliders("rho", tr("Reflectance ρ"), 3);
  lobe_ = new ChannelSliders("lobe", tr("Lobe reflects k"), 3);
  lobe_->setToolTip(
      tr("<span>Fraction of the light that the lobe reflects, most of it near the mirror "
         "direction. The sum of k and ρ is at most 1; where it is more, k is lowered</span>"));
  gloss_ = new GlossSlider;
  exitance_ = new ChannelSliders("exitance", tr("Exitance E, W/m²"), 2);
  account_ = make_note("material_account");
  sliders_ = new QWidget;
  sliders_->setToolTip(
      tr("Change the material; B is recomputed from the form factors, without a "
         "new pass"));
  auto* column = make_column(sliders_, {}, 4);
  column->addWidget(account_);
  column->addWidget(reflectance_);
  column->addWidget(lobe_);
  column->addWidget(gloss_);
  column->addWidget(exitance_);
  return sliders_;
}

void MaterialPanel::connect_edits() {
  MaterialEdits& edits = relighting_.edits();
  // Sliders of lessons change materials too.
  connect(&edits, &MaterialEdits::begun, this, &MaterialPanel::hold_exposure);
  connect(gloss_, &GlossSlider::drag_began, &edits, &MaterialEdits::begin_drag);
  connect(gloss_, &GlossSlider::moved, this, [this, &edits](double value) {
    Lobe lobe = edits.values_of(target()).lobe;
    (lobe.shape == LobeShape::phong ? lobe.exponent : lobe.roughness) = value;
    edits.set_lobe(target(), lobe);
  });
  connect(lobe_, &ChannelSliders::moved, this, [this, &edits](const Rgb& value) {
    Lobe lobe = edits.values_of(target()).lobe;
    lobe.reflectance = value;
    edits.set_lobe(target(), lobe);
  });
  for (ChannelSliders* sliders : {reflectance_, lobe_, exitance_}) {
    connect(sliders, &ChannelSliders::drag_began, &edits, &MaterialEdits::begin_drag);
  }
  connect(reflectance_, &ChannelSliders::moved, this,
          [this, &edits](const Rgb& value) { edits.set_reflectance(target(), value); });
  connect(exitance_, &ChannelSliders::moved, this,
          [this, &edits](const Rgb& value) { edits.set_exitance(target(), value); });
  connect(restore_, &QPushButton::clicked, &edits, &MaterialEdits::restore);
  connect(restore_, &QPushButton::clicked, this, &MaterialPanel::release_exposure);
  connect(kind_, qOverload<int>(&QComboBox::activated), this,
          [this] { fill_names(selection_.patch()); });
  connect(name_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &MaterialPanel::show_values);
  connect(&edits, &MaterialEdits::changed, this, &MaterialPanel::show_values);
  connect(&colors_, &ColorChoice::changed, this, &MaterialPanel::show_state);
  connect(&selection_, &Selection::changed, this, [this](PatchId patch) {
    if (scene_ && patch != no_patch) {
      fill_names(patch);
    }
  });
}

TargetKind MaterialPanel::kind() const {
  return static_cast<TargetKind>(kind_->currentData().toInt());
}

std::string MaterialPanel::target() const { return name_->currentData().toString().toStdString(); }

void MaterialPanel::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  release_exposure();
  fill_kinds();
  fill_names(no_patch);
}

void MaterialPanel::fill_kinds() {
  kind_->clear();
  kind_->addItem(tr("Material"), static_cast<int>(TargetKind::material));
  if (!scene_->groups().empty()) {
    kind_->addItem(tr("Group"), static_cast<int>(TargetKind::group));
  }
  kind_->addItem(tr("Face"), static_cast<int>(TargetKind::face));
}

void MaterialPanel::fill_names(PatchId patch) {
  const QSignalBlocker blocker(name_);
  const std::string before = target();
  const std::string wanted =
      patch == no_patch ? before : MaterialEdits::target_of(*scene_, kind(), patch);
  name_->clear();
  // Materials of a file may share a name, and then change together.
  QSet<QString> listed;
  const auto add = [&](const std::string& added) {
    const QString text = QString::fromStdString(added);
    if (!listed.contains(text)) {
      listed.insert(text);
      name_->addItem(text.mid(text.indexOf(':') + 1), text);
    }
  };
  switch (kind()) {
    case TargetKind::material:
      for (const Material& material : scene_->materials()) {
        add("material:" + material.name);
      }
      break;
    case TargetKind::group:
      for (const std::string& group : scene_->groups()) {
        add("group:" + group);
      }
      break;
    case TargetKind::face:
      // A list of all faces would be too long: only the face of the selected patch is listed.
      if (MaterialEdits::kind_of(wanted) == TargetKind::face) {
        add(wanted);
      }
      break;
  }
  const int index = name_->findData(QString::fromStdString(wanted));
  name_->setCurrentIndex(index >= 0 || name_->count() == 0 || patch != no_patch ? index : 0);
  show_values();
}

void MaterialPanel::show_target(const std::string& target) {
  kind_->setCurrentIndex(
      std::max(0, kind_->findData(static_cast<int>(MaterialEdits::kind_of(target)))));
  fill_names(selection_.patch());
  name_->setCurrentIndex(name_->findData(QString::fromStdString(target)));
}

void MaterialPanel::show_state() {
  if (lobe_->isHidden() == relighting_.by_lobes()) {
    lobe_->setVisible(relighting_.by_lobes());
    gloss_->setVisible(relighting_.by_lobes());
  }
  const QString reason = relighting_.reason_unavailable();
  enable_if(*sliders_, reason.isEmpty() && !target().empty(),
            reason.isEmpty() ? extent_text() : reason);
  obstacle_->setText(reason);
  obstacle_->setHidden(reason.isEmpty());
  account_->setText(relighting_.method_note());
  account_->setHidden(account_->text().isEmpty());
}

void MaterialPanel::hold_exposure() {
  // Without light, the exposure is to follow the first light.
  if (colors_.exposure_is_automatic() && relighting_.edits().has_light()) {
    colors_.set_automatic_exposure(false);
    holds_exposure_ = true;
  }
}

void MaterialPanel::release_exposure() {
  if (std::exchange(holds_exposure_, false)) {
    colors_.set_automatic_exposure(true);
  }
}

void MaterialPanel::show_values() {
  const MaterialEdits& edits = relighting_.edits();
  enable_if(*restore_, edits.any(), tr("No material is changed"));
  if (scene_ && edits.materials()) {
    const Material shown = edits.values_of(target());
    reflectance_->show_value(shown.reflectance, largest_reflectance);
    show_lobe(shown);
    exitance_->show_value(shown.exitance, slider_exitance(scene_->materials()));
    extent_->setText(extent_text());
  }
  show_state();
}

void MaterialPanel::show_lobe(const Material& shown) {
  lobe_->setVisible(relighting_.by_lobes());
  gloss_->setVisible(relighting_.by_lobes());
  lobe_->show_value(shown.lobe.reflectance, largest_reflectance);
  if (shown.lobe.shape == LobeShape::phong) {
    gloss_->show_exponent(shown.lobe.exponent);
  } else {
    gloss_->show_roughness(shown.lobe.roughness);
  }
  enable_if(*gloss_, shown.lobe.present(), tr("The material has no lobe"));
}

QString MaterialPanel::extent_text() const {
  if (target().empty()) {
    return kind() == TargetKind::face ? tr("Click a face in the scene to choose it.")
                                      : tr("The selected face is in no group.");
  }
  const MaterialEdits::Extent extent = relighting_.edits().extent_of(target());
  const QString patches =
      extent.patches == 1 ? tr("1 patch") : tr("%1 patches").arg(count_text(extent.patches));
  return extent.uniform ? patches : tr("%1 with different values").arg(patches);
}

}  // namespace transillum::viewer
