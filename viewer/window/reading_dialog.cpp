// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/reading_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "transillum/scene.h"

namespace transillum::viewer {

namespace {

struct Unit {
  const char *name, *text;
};
// The display names of length_unit_names(), in their order.
constexpr Unit units[] = {{"m", QT_TRANSLATE_NOOP("ReadingDialog", "meters")},
                          {"cm", QT_TRANSLATE_NOOP("ReadingDialog", "centimeters")},
                          {"mm", QT_TRANSLATE_NOOP("ReadingDialog", "millimeters")},
                          {"in", QT_TRANSLATE_NOOP("ReadingDialog", "inches")},
                          {"ft", QT_TRANSLATE_NOOP("ReadingDialog", "feet")}};

}  // namespace

ReadingDialog::ReadingDialog(const QString& file, const SceneInput& input, QWidget* parent)
    : QDialog(parent), base_(input) {
  setObjectName("reading_dialog");
  setWindowTitle(tr("Units and orientation"));
  unit_ = new QComboBox;
  unit_->setObjectName("reading_unit");
  scale_ = new QDoubleSpinBox;
  scale_->setObjectName("reading_scale");
  scale_->setDecimals(9);
  scale_->setRange(1e-9, 1e9);
  scale_->setSuffix(tr(" m per unit"));
  orient_ = new QComboBox;
  orient_->setObjectName("reading_orient");
  orient_->addItems({tr("Faces as in the file"), tr("Turn faces that show their back")});
  join_ = new QComboBox;
  join_->setObjectName("reading_join");
  join_->addItems({tr("Usual: joined in glTF and STL"), tr("Join faces of one plane"),
                   tr("Do not join faces")});
  join_->setToolTip(tr(
      "Join faces of one plane, material and group that share edges: this makes fewer and larger "
      "patches"));
  photometric_ = new QCheckBox(tr("Emissive colors are luminances, cd/m²"));
  photometric_->setObjectName("reading_photometric");
  const QString ending = QFileInfo(file).suffix().toLower();
  photometric_->setEnabled(ending == "gltf" || ending == "glb");
  photometric_->setToolTip(
      tr("Only for glTF: divide by 683 lm/W instead of reading the values as radiances"));
  fill_units();

  auto* form = new QFormLayout;
  form->addRow(tr("Lengths in"), unit_);
  form->addRow(QString(), scale_);
  form->addRow(tr("Orientation"), orient_);
  form->addRow(tr("Joining"), join_);
  form->addRow(QString(), photometric_);
  auto* title = new QLabel(tr("How %1 is read").arg(QFileInfo(file).fileName()));
  auto* note = new QLabel(tr("The choice is remembered for this file."));
  note->setForegroundRole(QPalette::PlaceholderText);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(tr("Read again"), QDialogButtonBox::AcceptRole)->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(12);
  layout->addWidget(title);
  layout->addLayout(form);
  layout->addWidget(note);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ReadingDialog::show_scale);
  orient_->setCurrentIndex(input.orient ? 1 : 0);
  join_->setCurrentIndex(!input.read.join ? 0 : *input.read.join ? 1 : 2);
  photometric_->setChecked(input.read.photometric);
}

void ReadingDialog::fill_units() {
  const double scale = base_.read.scale;
  int chosen = -1;
  for (const Unit& unit : units) {
    const double meters = length_unit_from_name(unit.name);
    unit_->addItem(tr(unit.text), meters);
    if (meters == scale) {
      chosen = unit_->count() - 1;
    }
  }
  unit_->addItem(tr("other units"));
  scale_->setValue(scale);
  unit_->setCurrentIndex(chosen >= 0 ? chosen : unit_->count() - 1);
  scale_->setEnabled(chosen < 0);
}

void ReadingDialog::show_scale() {
  const QVariant meters = unit_->currentData();
  scale_->setEnabled(!meters.isValid());
  if (meters.isValid()) {
    scale_->setValue(meters.toDouble());
  }
}

SceneInput ReadingDialog::input() const {
  SceneInput input = base_;
  const QVariant meters = unit_->currentData();
  input.read.scale = meters.isValid() ? meters.toDouble() : scale_->value();
  input.orient = orient_->currentIndex() == 1;
  input.read.join =
      join_->currentIndex() == 0 ? std::nullopt : std::optional(join_->currentIndex() == 1);
  input.read.photometric = photometric_->isChecked();
  return input;
}

}  // namespace transillum::viewer
