// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/film_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QPushButton>
#include <QStandardItemModel>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

QStandardItem& item_of(const QComboBox& box, int row) {
  return *static_cast<QStandardItemModel*>(box.model())->item(row);
}

void disable(const QComboBox& box, int row, const QString& why) {
  item_of(box, row).setEnabled(false);
  item_of(box, row).setToolTip(why);
}

}  // namespace

FilmDialog::FilmDialog(const FilmPlan& plan, bool has_map,
                       const std::vector<FilmPlan::Over>& missing, QWidget* parent)
    : QDialog(parent) {
  setObjectName("film_dialog");
  setWindowTitle(tr("Save film"));
  show_ = named("film_show", new QComboBox);
  show_->addItems({tr("Scene"), tr("Visibility map"), tr("Scene and map, side by side")});
  over_ = named("film_over", new QComboBox);
  over_->addItems({tr("Changes in the window, until you finish"), tr("Steps of this direction"),
                   tr("Directions of this iteration"), tr("Iterations"),
                   tr("One turn of the camera"), tr("The day of the sun, by place and day"),
                   tr("The last move of the selection")});
  size_ = named("film_size", new QComboBox);
  for (const QSize& size : {plan.size, QSize(640, 360), QSize(1280, 720), QSize(1920, 1080)}) {
    const QString text = tr("%1 × %2").arg(size.width()).arg(size.height());
    size_->addItem(size_->count() == 0 ? tr("%1, as in the window").arg(text) : text, size);
  }
  speed_ = named("film_speed", new QDoubleSpinBox);
  speed_->setRange(0.5, 60);
  speed_->setDecimals(1);
  speed_->setValue(plan.per_second);
  if (!has_map) {
    const QString why = tr("No direction is shown yet");
    for (const auto over :
         {FilmPlan::Over::polygons, FilmPlan::Over::directions, FilmPlan::Over::iterations}) {
      disable(*over_, static_cast<int>(over), why);
    }
    disable(*show_, static_cast<int>(FilmPlan::Show::map), why);
    disable(*show_, static_cast<int>(FilmPlan::Show::both), why);
  }
  for (const FilmPlan::Over over : missing) {
    disable(*over_, static_cast<int>(over),
            over == FilmPlan::Over::move ? tr("Nothing has been moved")
                                         : tr("The scene has no sun by place and day"));
  }
  show_->setCurrentIndex(has_map ? static_cast<int>(plan.show) : 0);
  const int over = static_cast<int>(plan.over);
  over_->setCurrentIndex(item_of(*over_, over).isEnabled() ? over : 0);
  auto* form = new QFormLayout;
  form->addRow(tr("Show"), show_);
  form->addRow(tr("Over"), over_);
  form->addRow(tr("Size, pixels"), size_);
  form->addRow(tr("Pictures per second"), speed_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(tr("Save…"), QDialogButtonBox::AcceptRole)->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(12);
  layout->addLayout(form);
  layout->addWidget(buttons);
  layout->setSizeConstraint(QLayout::SetFixedSize);
}

FilmPlan FilmDialog::plan() const {
  return {static_cast<FilmPlan::Show>(show_->currentIndex()),
          static_cast<FilmPlan::Over>(over_->currentIndex()), size_->currentData().toSize(),
          speed_->value()};
}

}  // namespace transillum::viewer
