// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/refine_controls.h"

#include <QComboBox>
#include <QDoubleValidator>
#include <QFormLayout>
#include <QLineEdit>
#include <QLocale>
#include <QSpinBox>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int usual_patches = 600;  // until a number is entered

QString percent_text(double fraction) {
  return fraction > 0 ? QString::number(100 * fraction, 'g', QLocale::FloatingPointShortest)
                      : QString();
}

}  // namespace

RefineControls::RefineControls(QWidget* parent) : QWidget(parent) {
  by_ =
      named("refine_by", new QComboBox,
            tr("Rounds of refinement before the solve: each solves, and divides the patches that "
               "are worst\nJumps: where B jumps most to neighboring patches\nError: where a solve "
               "with every patch divided differs most; rounds take about five times as long"));
  by_->addItems({tr("None"), tr("Jumps"), tr("Error")});
  by_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  by_->setMinimumContentsLength(8);
  patches_ = named("refine_patches", new QSpinBox, tr("Largest number of patches"));
  patches_->setRange(1, 1 << 24);
  patches_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  patches_->setValue(usual_patches);
  until_ = named("refine_until", new QLineEdit);
  auto* percent = new QDoubleValidator(0, 99, 6, until_);
  percent->setLocale(QLocale::c());
  until_->setValidator(percent);
  until_->setPlaceholderText(tr("No limit"));
  until_->setToolTip(
      tr("The rounds end when the RMS jump or the L2 error,\nin percent of B, is this small"));
  limits_ = new QWidget;
  auto* limits = new QFormLayout(limits_);
  limits->setContentsMargins(0, 2, 0, 0);
  limits->setHorizontalSpacing(6);
  limits->setVerticalSpacing(4);
  limits->addRow(tr("Patches"), patches_);
  limits->addRow(tr("Until, %"), until_);
  until_label_ = limits->labelForField(until_);
  auto* layout = make_column(this, {}, 2);
  layout->addWidget(by_);
  layout->addWidget(limits_);
  show_limits();
  connect(by_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    show_limits();
    emit changed();
  });
  connect(patches_, qOverload<int>(&QSpinBox::valueChanged), this, &RefineControls::changed);
  connect(until_, &QLineEdit::textChanged, this, &RefineControls::changed);
}

RefineChoice RefineControls::choice() const {
  RefineChoice choice = base_;
  choice.by.reset();
  if (by_->currentIndex() > 0) {
    choice.by = static_cast<RefineBy>(by_->currentIndex() - 1);
  }
  choice.patches = patches_->value();
  if (until_->text() != percent_text(base_.until)) {
    choice.until = QLocale::c().toDouble(until_->text()) / 100;
  }
  return choice;
}

void RefineControls::set_choice(const RefineChoice& choice) {
  base_ = choice;
  patches_->setValue(choice.patches > 0 ? choice.patches : usual_patches);
  until_->setText(percent_text(choice.until));
  by_->setCurrentIndex(choice.is_set() ? static_cast<int>(*choice.by) + 1 : 0);
}

void RefineControls::set_available(bool available, bool total) {
  available_ = available;
  total_ = total;
  by_->setEnabled(available && !total);
  show_limits();
}

void RefineControls::show_limits() {
  limits_->setVisible(available_ && (total_ || by_->currentIndex() > 0));
  until_->setVisible(!total_);
  until_label_->setVisible(!total_);
}

}  // namespace transillum::viewer
