// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/clip_controls.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>

namespace transillum::viewer {

namespace {

constexpr int steps = 200;

}  // namespace

ClipControls::ClipControls(QWidget* parent) : QWidget(parent) {
  axis_ = new QComboBox;
  axis_->setObjectName("clip_axis");
  axis_->addItems({tr("Off"), tr("x"), tr("y"), tr("z")});
  axis_->setToolTip(tr("The axis that is perpendicular to the clipping plane (X: the next axis)"));
  place_ = new QSlider(Qt::Horizontal);
  place_->setObjectName("clip_place");
  place_->setRange(0, steps);
  place_->setValue(steps / 2);
  place_->setMinimumWidth(120);
  place_->setToolTip(tr("Position of the clipping plane"));
  other_side_ = new QCheckBox(tr("Other side"));
  other_side_->setObjectName("clip_other_side");
  other_side_->setToolTip(tr("Show the other side of the plane"));
  auto* label = new QLabel(tr("Clipping plane"));
  label->setBuddy(axis_);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 6, 14, 8);
  for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(axis_),
                          static_cast<QWidget*>(place_), static_cast<QWidget*>(other_side_)}) {
    row->addWidget(widget);
  }
  const auto show_state = [this] {
    place_->setEnabled(axis_->currentIndex() > 0);
    other_side_->setEnabled(axis_->currentIndex() > 0);
  };
  show_state();
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this, show_state] {
    show_state();
    emit changed();
  });
  connect(place_, &QSlider::valueChanged, this, &ClipControls::changed);
  connect(other_side_, &QCheckBox::toggled, this, &ClipControls::changed);
}

std::optional<ClipPlane> ClipControls::choice() const {
  const int axis = axis_->currentIndex();
  if (axis == 0) {
    return std::nullopt;
  }
  return ClipPlane{static_cast<ClipPlane::Axis>(axis - 1),
                   static_cast<double>(place_->value()) / steps, other_side_->isChecked()};
}

void ClipControls::set_choice(const std::optional<ClipPlane>& clip) {
  if (clip) {
    place_->setValue(qRound(clip->place * steps));
    other_side_->setChecked(clip->other_side);
  }
  axis_->setCurrentIndex(clip ? static_cast<int>(clip->axis) + 1 : 0);
}

void ClipControls::next_axis() {
  axis_->setCurrentIndex((axis_->currentIndex() + 1) % axis_->count());
}

}  // namespace transillum::viewer
