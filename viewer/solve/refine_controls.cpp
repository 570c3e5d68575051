// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/refine_controls.h"

#include <QComboBox>
#include <QDoubleValidator>
#include <QLineEdit>
#include <QLocale>
#include <QSpinBox>

#include "solve/setting_tips.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/count_box.h"
#include "widgets/setting_rows.h"

namespace transillum::viewer {

namespace {

constexpr int usual_patches = 600;  // until a number is entered

QString percent_text(double fraction) {
  return fraction > 0 ? exact_digits(100 * fraction) : QString();
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
  patches_ = named("refine_patches", new CountBox, tr("Largest number of patches"));
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
  auto* rows = new SettingRows;
  rows->add(tr("Refine by"), by_, by_->toolTip());
  rows->add(tr("Most patches"), patches_, patches_->toolTip());
  rows->add(tr("Until, %"), until_, until_->toolTip());
  make_column(this, {}, 0)->addWidget(rows);
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
  show_limits();
}

QString RefineControls::state() const {
  if (total_) {
    return tr("by all errors, %1 patches").arg(count_text(patches_->value()));
  }
  return by_->currentIndex() == 0
             ? tr("off")
             : tr("%1, %2 patches").arg(by_->currentText(), count_text(patches_->value()));
}

void RefineControls::show_limits() {
  const bool rounds = available_ && !total_ && by_->currentIndex() > 0;
  SettingRows::show_row(by_, !total_);
  SettingRows::show_row(patches_, rounds || (available_ && total_));
  SettingRows::show_row(until_, rounds);
}

}  // namespace transillum::viewer
