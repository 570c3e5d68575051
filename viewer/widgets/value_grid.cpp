// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/value_grid.h"

#include <QGridLayout>
#include <QLabel>

namespace transillum::viewer {

namespace {

QLabel* dim_label(const QString& text) {
  auto* label = new QLabel(text);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

}  // namespace

ValueGrid::ValueGrid(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(10);
  grid_->setVerticalSpacing(4);
  grid_->setColumnStretch(1, 1);
}

QLabel* ValueGrid::add_row(const QString& name, const QString& unit, const QString& tip) {
  const int row = grid_->rowCount();
  QLabel* title = dim_label(unit.isEmpty() ? name : tr("%1, %2").arg(name, unit));
  title->setToolTip(tip);
  auto* value = new QLabel(QStringLiteral("–"));
  value->setTextInteractionFlags(Qt::TextSelectableByMouse);
  value->setToolTip(tip);
  value->setWordWrap(true);  // long values do not make the panel wider
  grid_->addWidget(title, row, 0);
  grid_->addWidget(value, row, 1);
  return value;
}

void ValueGrid::add_wide(QWidget* widget) { grid_->addWidget(widget, grid_->rowCount(), 0, 1, 2); }

}  // namespace transillum::viewer
