// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/gloss_slider.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int gloss_steps = 240;
constexpr double largest_exponent = 999;  // 1 + n is 1000 at the right end
constexpr double least_roughness = 0.05;

/// 0 to 1, from dull to sharp; the exponents are spread by the logarithm of 1 + n.
double place_of(double value, bool is_exponent) {
  return is_exponent ? std::log1p(value) / std::log1p(largest_exponent)
                     : (1 - value) / (1 - least_roughness);
}

double value_at_place(double place, bool is_exponent) {
  if (!is_exponent) {
    return 1 - place * (1 - least_roughness);
  }
  const double exponent = std::expm1(place * std::log1p(largest_exponent));
  return std::round(exponent);  // lobes with whole exponents are evaluated faster
}

}  // namespace

GlossSlider::GlossSlider(QWidget* parent) : QWidget(parent), drag_([this] { emit drag_began(); }) {
  title_ = new QLabel;
  slider_ = named("gloss", new QSlider(Qt::Horizontal));
  slider_->setRange(0, gloss_steps);
  slider_->setMinimumWidth(70);
  box_ = named("gloss_value", new QDoubleSpinBox);
  box_->setKeyboardTracking(false);
  auto* dull = new QLabel(tr("dull"));
  auto* sharp = new QLabel(tr("sharp"));
  for (QLabel* end : {dull, sharp}) {
    end->setForegroundRole(QPalette::PlaceholderText);
  }
  auto* row = make_row({}, 6);
  row->addWidget(dull);
  row->addWidget(slider_, 1);
  row->addWidget(sharp);
  row->addWidget(box_);
  auto* column = make_column(this, {}, 1);
  column->addWidget(title_);
  column->addLayout(row);
  setToolTip(
      tr("<span>Width of the lobe: the exponent n of the cosine (Phong), or the roughness (GGX). A "
         "sharp lobe requires more directions: about ten times its exponent.</span>"));
  connect(slider_, &QSlider::valueChanged, this,
          [this](int step) { change(value_at_place(1.0 * step / gloss_steps, is_exponent_)); });
  connect(box_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &GlossSlider::change);
  drag_.watch(slider_);
  drag_.watch(box_);
  show_exponent(0);
}

void GlossSlider::change(double value) {
  drag_.change();
  show_value(value);
  emit moved(value);
}

void GlossSlider::show_exponent(double exponent) {
  const QSignalBlocker quiet(box_);
  is_exponent_ = true;
  title_->setText(tr("<b>Exponent n</b> of the lobe"));
  box_->setDecimals(1);
  box_->setRange(0, largest_exponent);
  box_->setSingleStep(1);
  show_value(exponent);
}

void GlossSlider::show_roughness(double roughness) {
  const QSignalBlocker quiet(box_);
  is_exponent_ = false;
  title_->setText(tr("<b>Roughness</b> of the lobe"));
  box_->setDecimals(3);
  box_->setRange(least_roughness, 1);
  box_->setSingleStep(0.01);
  show_value(roughness);
}

void GlossSlider::show_value(double value) {
  const QSignalBlocker quiet_box(box_), quiet_slider(slider_);
  box_->setValue(value);
  slider_->setValue(static_cast<int>(
      std::lround(gloss_steps * std::clamp(place_of(value, is_exponent_), 0.0, 1.0))));
}

}  // namespace transillum::viewer
