// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/figure_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <initializer_list>

#include "transillum/errors.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr double pixels_per_cm = 300 / 2.54;

QDoubleSpinBox* number(const char* name, double low, double high, double value, int decimals) {
  auto* box = named(name, new QDoubleSpinBox);
  box->setRange(low, high);
  box->setDecimals(decimals);
  box->setValue(value);
  return box;
}

}  // namespace

FigureDialog::FigureDialog(const FigurePlan& plan, bool has_map, QWidget* parent)
    : QDialog(parent) {
  setObjectName("figure_dialog");
  setWindowTitle(tr("Save figure"));
  make_fields(plan);
  enable_if(*map_, has_map, tr("No direction is shown yet"));
  map_->setChecked(plan.map && has_map);
  auto* shows = make_row({});
  auto* size = make_row({});
  for (QWidget* field : std::initializer_list<QWidget*>{scene_, map_, chart_}) {
    shows->addWidget(field);
  }
  for (QWidget* field :
       std::initializer_list<QWidget*>{width_, new QLabel(tr("×")), height_, unit_}) {
    size->addWidget(field);
  }
  auto* form = new QFormLayout;
  form->addRow(tr("Show"), shows);
  form->addRow(tr("Title"), title_);
  form->addRow(QString(), explained_);
  form->addRow(QString(), direction_);
  form->addRow(tr("Size"), size);
  form->addRow(tr("Text, points"), text_);
  form->addRow(tr("Background"), background_);
  form->addRow(QString(), note_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  save_ = buttons->addButton(tr("Save…"), QDialogButtonBox::AcceptRole);
  save_->setObjectName("figure_save");
  save_->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(12);
  layout->addLayout(form);
  layout->addWidget(buttons);
  layout->setSizeConstraint(QLayout::SetFixedSize);
  show_state();
}

void FigureDialog::make_fields(const FigurePlan& plan) {
  scene_ = named("figure_scene", new QCheckBox(tr("Scene")));
  map_ = named("figure_map", new QCheckBox(tr("Map")));
  chart_ = named("figure_chart", new QCheckBox(tr("Charts")));
  explained_ = named("figure_explained", new QCheckBox(tr("Color bar, legend and scale bar")));
  direction_ = named("figure_direction", new QCheckBox(tr("Direction and step in the scene")));
  direction_->setChecked(plan.direction);
  title_ = named("figure_title", new QLineEdit(plan.title));
  const int decimals = plan.centimeters ? 1 : 0;
  width_ = number("figure_width", 0, 16384, plan.size.width(), decimals);
  height_ = number("figure_height", 0, 16384, plan.size.height(), decimals);
  text_ = number("figure_text", 4, 96, plan.text_points, 1);
  unit_ = named("figure_unit", new QComboBox);
  unit_->addItems({tr("px"), tr("cm")});
  unit_->setCurrentIndex(plan.centimeters ? 1 : 0);
  background_ = named("figure_background", new QComboBox);
  background_->addItems({tr("Light"), tr("Dark"), tr("Transparent")});
  background_->setCurrentIndex(static_cast<int>(plan.background));
  note_ = named("figure_note", note_label());
  scene_->setChecked(plan.scene);
  chart_->setChecked(plan.chart);
  explained_->setChecked(plan.explained);
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this, &FigureDialog::change_unit);
  for (QDoubleSpinBox* box : {width_, height_}) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &FigureDialog::show_state);
  }
  for (QCheckBox* box : {scene_, map_, chart_}) {
    connect(box, &QCheckBox::toggled, this, &FigureDialog::show_state);
  }
}

void FigureDialog::change_unit() {
  const bool centimeters = unit_->currentIndex() == 1;
  const double factor = centimeters ? 1 / pixels_per_cm : pixels_per_cm;
  for (QDoubleSpinBox* box : {width_, height_}) {
    const double value = factor * box->value();
    box->setDecimals(centimeters ? 1 : 0);
    box->setValue(value);
  }
  show_state();
}

void FigureDialog::show_state() {
  QString problem;
  try {
    plan().validate();
  } catch (const InputError& error) {
    problem = QString::fromStdString(error.what());
  }
  const QSize size = plan().pixels();
  enable_if(*save_, problem.isEmpty(), problem);
  note_->setText(problem.isEmpty()
                     ? tr("%1 × %2 pixels; .svg and .pdf keep text, map and charts as vectors")
                           .arg(size.width())
                           .arg(size.height())
                     : problem);
}

FigurePlan FigureDialog::plan() const {
  FigurePlan plan;
  plan.scene = scene_->isChecked();
  plan.map = map_->isChecked();
  plan.chart = chart_->isChecked();
  plan.title = title_->text();
  plan.explained = explained_->isChecked();
  plan.direction = direction_->isChecked();
  plan.size = {width_->value(), height_->value()};
  plan.centimeters = unit_->currentIndex() == 1;
  plan.text_points = text_->value();
  plan.background = static_cast<FigurePlan::Background>(background_->currentIndex());
  return plan;
}

}  // namespace transillum::viewer
