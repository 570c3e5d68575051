// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The menu of the color map and its range.
#include "colors/scale_menu.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleValidator>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QRadioButton>
#include <QSignalBlocker>
#include <QWidgetAction>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

QString end_text(double value) { return QString::number(value, 'g', 5); }

}  // namespace

ScaleMenu::ScaleMenu(ColorChoice& colors, QWidget* parent) : QToolButton(parent), colors_(colors) {
  setObjectName("scale");
  setPopupMode(QToolButton::InstantPopup);
  setToolTip(tr("Color map and its range"));
  auto* menu = new QMenu(this);
  auto* panel = new QWidgetAction(menu);
  panel->setDefaultWidget(make_panel());
  menu->addAction(panel);
  setMenu(menu);
  connect(&colors_, &ColorChoice::changed, this, &ScaleMenu::show_choice);
  connect(&colors_, &ColorChoice::fitted, this, &ScaleMenu::show_choice);
  show_choice();
}

QWidget* ScaleMenu::make_panel() {
  rules_ = new QButtonGroup(this);
  auto* panel = new QWidget;
  auto* grid = new QGridLayout(panel);
  grid->setContentsMargins(14, 10, 14, 12);
  map_ = named("color_map", new QComboBox);
  map_->addItems({"Viridis", "Cividis", "Inferno"});  // in the order of ColorMap
  grid->addWidget(new QLabel(tr("Map")), 0, 0);
  grid->addWidget(map_, 0, 1);
  grid->addWidget(new QLabel(tr("Range")), 1, 0);
  const auto add_rule = [&](RangeRule rule, const QString& text, const QString& tip) {
    auto* button = new QRadioButton(text);
    button->setToolTip(tip);
    rules_->addButton(button, static_cast<int>(rule));
    grid->addWidget(button, grid->rowCount(), 0, 1, 2);
  };
  add_rule(RangeRule::automatic, tr("Automatic: fit each picture"),
           tr("The meaning of a color changes from picture to picture"));
  add_rule(RangeRule::widening, tr("Locked over time: only widens"),
           tr("Pictures of one solve run can be compared"));
  add_rule(RangeRule::fixed, tr("Fixed:"), tr("From and to the values below"));
  const auto add_end = [&](const char* name, const QString& text) {
    auto* edit = named(name, new QLineEdit);
    edit->setValidator(new QDoubleValidator(edit));
    auto* label = new QLabel(text);
    label->setBuddy(edit);
    const int row = grid->rowCount();
    grid->addWidget(label, row, 0);
    grid->addWidget(edit, row, 1);
    connect(edit, &QLineEdit::editingFinished, this, &ScaleMenu::apply_range);
    return edit;
  };
  low_ = add_end("range_low", tr("from"));
  high_ = add_end("range_high", tr("to"));
  connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { colors_.set_map(static_cast<ColorMap>(index)); });
  connect(rules_, &QButtonGroup::idClicked, this,
          [this](int rule) { colors_.set_range_rule(static_cast<RangeRule>(rule)); });
  return panel;
}

void ScaleMenu::apply_range() {
  const ColorScale& scale = colors_.scale();
  // editingFinished is also emitted without a change.
  if (low_->text() == end_text(scale.low) && high_->text() == end_text(scale.high)) {
    return;
  }
  colors_.set_range(low_->text().toDouble(), high_->text().toDouble());
}

void ScaleMenu::show_choice() {
  const ColorScale& scale = colors_.scale();
  switch (colors_.range_rule()) {
    case RangeRule::automatic:
      setText(tr("Range: automatic "));
      break;
    case RangeRule::widening:
      setText(tr("Range: locked "));
      break;
    case RangeRule::fixed:
      setText(tr("Range: fixed "));
      break;
  }
  const QSignalBlocker quiet(map_);
  map_->setCurrentIndex(static_cast<int>(colors_.map()));
  map_->setEnabled(!traits_of(colors_.quantity()).is_signed);
  rules_->button(static_cast<int>(colors_.range_rule()))->setChecked(true);
  if (!low_->hasFocus()) {
    low_->setText(end_text(scale.low));
  }
  if (!high_->hasFocus()) {
    high_->setText(end_text(scale.high));
  }
}

}  // namespace transillum::viewer
