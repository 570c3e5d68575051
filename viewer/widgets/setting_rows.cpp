// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/setting_rows.h"

#include <QLabel>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

// The widest label; each is of that width, so that fields begin at one line.
constexpr const char* widest_label = "Painter's order";

}  // namespace

SettingRows::SettingRows(QWidget* parent) : QWidget(parent) { make_column(this, {0, 2, 0, 8}, 6); }

QLabel* SettingRows::add(const QString& label, QWidget* field, const QString& tip) {
  auto* row = new QWidget;
  auto* text = new QLabel(label);
  text->setBuddy(field);
  text->setToolTip(tip);
  if (field->toolTip().isEmpty()) {
    field->setToolTip(tip);
  }
  text->setMinimumWidth(text->fontMetrics().horizontalAdvance(QLatin1String(widest_label)));
  auto* layout = make_row(row, {}, 8);
  // A field of several lines has its label at the first.
  layout->addWidget(text, 0, Qt::AlignVCenter);
  layout->addWidget(field, 1);
  add(row);
  return text;
}

void SettingRows::add(QWidget* widget) { layout()->addWidget(widget); }

void SettingRows::show_row(QWidget* field, bool shown) { field->parentWidget()->setVisible(shown); }

}  // namespace transillum::viewer
