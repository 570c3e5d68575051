// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Three sliders with spin boxes for an RGB value. With "together" checked, a drag scales all three
// channels by one factor, relative to the value at the start of the drag.
#include "widgets/channel_sliders.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int slider_steps = 1000;
constexpr const char* channel_names[] = {"red", "green", "blue"};

std::array<double*, 3> channels_of(Rgb& value) { return {&value.r, &value.g, &value.b}; }

}  // namespace

ChannelSliders::ChannelSliders(const char* name, const QString& title, int decimals,
                               QWidget* parent)
    : QWidget(parent), drag_([this] {
        at_drag_start_ = value_;
        emit drag_began();
      }) {
  const auto part = [name](const char* what) { return QStringLiteral("%1_%2").arg(name, what); };
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(1);
  auto* heading = named(part("heading"), new QLabel(title));
  set_strong(*heading);
  together_ = named(part("together"), new QCheckBox(tr("together")),
                    tr("Keeps the proportions of red, green and blue, and so the hue"));
  together_->setChecked(true);
  grid->addWidget(heading, 0, 0, 1, 2);
  grid->addWidget(together_, 0, 2);
  const QString labels[] = {tr("red"), tr("green"), tr("blue")};
  for (std::size_t c = 0; c < 3; ++c) {
    const int row = static_cast<int>(c) + 1;
    sliders_[c] = new QSlider(Qt::Horizontal);
    sliders_[c]->setObjectName(part(channel_names[c]));
    sliders_[c]->setRange(0, slider_steps);
    sliders_[c]->setMinimumWidth(70);
    boxes_[c] = new QDoubleSpinBox;
    boxes_[c]->setObjectName(part(channel_names[c]) + "_value");
    boxes_[c]->setDecimals(decimals);
    boxes_[c]->setKeyboardTracking(false);
    auto* label = new QLabel(labels[c]);
    label->setBuddy(boxes_[c]);
    grid->addWidget(label, row, 0);
    grid->addWidget(sliders_[c], row, 1);
    grid->addWidget(boxes_[c], row, 2);
    connect(sliders_[c], &QSlider::valueChanged, this, [this, c](int step) {
      drag_.change();
      set_channel(c, most_ * step / slider_steps);
    });
    connect(boxes_[c], qOverload<double>(&QDoubleSpinBox::valueChanged), this,
            [this, c](double value) {
              drag_.change();
              set_channel(c, value);
            });
    drag_.watch(sliders_[c]);
    drag_.watch(boxes_[c]);
  }
  grid->setColumnStretch(1, 1);
}

void ChannelSliders::set_channel(std::size_t channel, double value) {
  Rgb next = value_;
  const double before = *channels_of(at_drag_start_)[channel];
  if (together_->isChecked() && before > 0) {
    // The factor is limited so that no channel exceeds the range.
    const double factor = std::min(value / before, most_ / max_abs(at_drag_start_));
    next = factor * at_drag_start_;
  } else if (together_->isChecked() && max_abs(at_drag_start_) == 0) {
    next = {value, value, value};
  } else {
    *channels_of(next)[channel] = value;
  }
  value_ = next;
  update_widgets();
  emit moved(next);
}

void ChannelSliders::show_value(const Rgb& value, double most) {
  value_ = value;
  most_ = most;
  update_widgets();
}

void ChannelSliders::update_widgets() {
  const auto values = channels_of(value_);
  for (std::size_t c = 0; c < 3; ++c) {
    const QSignalBlocker quiet_slider(sliders_[c]), quiet_box(boxes_[c]);
    boxes_[c]->setRange(0, most_);
    boxes_[c]->setSingleStep(most_ / 100);
    boxes_[c]->setValue(*values[c]);
    sliders_[c]->setValue(static_cast<int>(std::lround(slider_steps * *values[c] / most_)));
  }
}

}  // namespace transillum::viewer
