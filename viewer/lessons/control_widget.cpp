// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A slider with its value, or a choice, in the text of a page. Positions and materials are changed
// here; options by the window, which starts the solve again.
#include "lessons/control_widget.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/material_edits.h"
#include "state/focus.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int gray_steps = 100;

bool is_gray(PageControl::Kind kind) {
  return kind == PageControl::Kind::reflectance || kind == PageControl::Kind::exitance;
}

}  // namespace

ControlWidget::ControlWidget(PageControl control, Focus& focus, MaterialEdits& edits,
                             QWidget* parent)
    : QWidget(parent), control_(std::move(control)), focus_(focus), edits_(edits) {
  setObjectName("control_" + QString::fromStdString(control_.name));
  make_row(this, {4, 0, 4, 0}, 6);
  if (control_.kind == PageControl::Kind::option && !control_.slides) {
    make_choice();
  } else {
    make_slider();
  }
  if (is_gray(control_.kind)) {
    connect(&edits_, &MaterialEdits::changed, this, &ControlWidget::follow_edits);
    follow_edits();
  } else if (control_.kind != PageControl::Kind::option) {
    connect(&focus_, &Focus::moved, this, &ControlWidget::follow_focus);
    connect(&focus_, &Focus::target_changed, this, &ControlWidget::follow_focus);
    follow_focus();
  }
}

void ControlWidget::make_slider() {
  slider_ = named("slider", new QSlider(Qt::Horizontal),
                  tr("Drag, or use the arrow keys: the window follows at once"));
  slider_->setFixedWidth(theme::scaled(110));
  slider_->setRange(
      0, is_gray(control_.kind) ? gray_steps : static_cast<int>(control_.values.size()) - 1);
  slider_->setPageStep(is_gray(control_.kind) ? 10 : 1);
  value_ = named("value", new QLabel);
  layout()->addWidget(slider_);
  layout()->addWidget(value_);
  connect(slider_, &QSlider::sliderPressed, this, [this] { edits_.begin_drag(); });
  connect(slider_, &QSlider::actionTriggered, this, [this](int action) {
    if (action != QAbstractSlider::SliderMove) {  // by a key or the wheel
      edits_.begin_drag();
    }
  });
  connect(slider_, &QSlider::valueChanged, this, &ControlWidget::moved);
}

void ControlWidget::set_text_font(const QFont& font) {
  if (!value_) {
    choice_->setFont(font);
    return;
  }
  QFont bold = font;
  bold.setBold(true);
  value_->setFont(bold);
  // The line does not move while the value changes.
  QStringList texts{is_gray(control_.kind) ? QStringLiteral("0.00")
                                           : tr("%1 of %2").arg(99).arg(99)};
  if (control_.kind == PageControl::Kind::option) {
    texts.clear();
  }
  for (const std::string& label : control_.labels) {
    texts << QString::fromStdString(label);
  }
  const QString shown = value_->text();
  int widest = 0;
  for (const QString& text : texts) {
    value_->setText(text);
    widest = std::max(widest, value_->sizeHint().width());
  }
  value_->setText(shown);
  value_->setMinimumWidth(widest);
}

void ControlWidget::make_choice() {
  choice_ = named("choice", new QComboBox);
  for (const std::string& label : control_.labels) {
    choice_->addItem(QString::fromStdString(label));
  }
  choice_->setToolTip(tr("Choose: the window follows at once"));
  layout()->addWidget(choice_);
  connect(choice_, qOverload<int>(&QComboBox::activated), this, &ControlWidget::moved);
}

double ControlWidget::gray_at(int position) const {
  return control_.low + (control_.high - control_.low) * position / gray_steps;
}

void ControlWidget::moved(int position) {
  show_position(position);
  const double gray = gray_at(position);
  switch (control_.kind) {
    case PageControl::Kind::option:
      emit option_chosen(control_.target, at(control_.values, position));
      return;
    case PageControl::Kind::reflectance:
      edits_.set_reflectance(edits_.with_kind(control_.target), {gray, gray, gray});
      return;
    case PageControl::Kind::exitance:
      edits_.set_exitance(edits_.with_kind(control_.target), {gray, gray, gray});
      return;
    case PageControl::Kind::step:
      focus_.go_to_step(position - 1);
      return;
    case PageControl::Kind::direction:
      focus_.go_to_direction(focus_.target().iteration, position - 1);
      return;
  }
}

void ControlWidget::show_position(int position) {
  if (!value_) {
    return;
  }
  switch (control_.kind) {
    case PageControl::Kind::option:
      value_->setText(position < 0 ? QStringLiteral("–")
                                   : QString::fromStdString(at(control_.labels, position)));
      return;
    case PageControl::Kind::reflectance:
      value_->setText(QString::number(gray_at(position), 'f', 2));
      return;
    case PageControl::Kind::exitance:
      value_->setText(number_text(gray_at(position)));
      return;
    default:
      value_->setText(tr("%1 of %2").arg(position).arg(slider_->maximum()));
  }
}

void ControlWidget::show_options(const RunOptions& options) {
  if (control_.kind != PageControl::Kind::option) {
    return;
  }
  const int now = value_in(control_, options);
  if (choice_) {
    choice_->setCurrentIndex(now);
    return;
  }
  const QSignalBlocker blocker(slider_);
  slider_->setValue(std::max(now, 0));
  show_position(now);
}

void ControlWidget::follow_focus() {
  const QSignalBlocker blocker(slider_);
  const bool of_steps = control_.kind == PageControl::Kind::step;
  const auto map = focus_.map();
  enable_if(*this, map != nullptr, tr("No direction is shown yet"));
  if (!map) {
    return;
  }
  slider_->setRange(of_steps ? 0 : 1, of_steps ? map->history.step_count()
                                               : focus_.passes_of(focus_.position().iteration));
  slider_->setValue(of_steps ? focus_.position().step + 1 : focus_.target().direction + 1);
  show_position(slider_->value());
}

void ControlWidget::follow_edits() {
  if (!edits_.materials()) {
    return;
  }
  const Material now = edits_.values_of(edits_.with_kind(control_.target));
  const Rgb& value =
      control_.kind == PageControl::Kind::reflectance ? now.reflectance : now.exitance;
  const double fraction =
      ((value.r + value.g + value.b) / 3 - control_.low) / (control_.high - control_.low);
  const QSignalBlocker blocker(slider_);
  slider_->setValue(static_cast<int>(std::lround(gray_steps * fraction)));
  show_position(slider_->value());
}

}  // namespace transillum::viewer
