// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The controls of the color map and its range.
#include "colors/scale_panel.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleValidator>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QRadioButton>
#include <QSignalBlocker>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

QString end_text(double value) { return QString::number(value, 'g', 5); }

}  // namespace

ScalePanel::ScalePanel(ColorChoice& colors, QWidget* parent) : QWidget(parent), colors_(colors) {
  setObjectName("scale");
  make_controls();
  connect(&colors_, &ColorChoice::changed, this, &ScalePanel::show_choice);
  connect(&colors_, &ColorChoice::fitted, this, &ScalePanel::show_choice);
  show_choice();
}

void ScalePanel::make_controls() {
  rules_ = new QButtonGroup(this);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins({});
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
    connect(edit, &QLineEdit::editingFinished, this, &ScalePanel::apply_range);
    return edit;
  };
  low_ = add_end("range_low", tr("from"));
  high_ = add_end("range_high", tr("to"));
  connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { colors_.set_map(static_cast<ColorMap>(index)); });
  connect(rules_, &QButtonGroup::idClicked, this,
          [this](int rule) { colors_.set_range_rule(static_cast<RangeRule>(rule)); });
}

void ScalePanel::apply_range() {
  const ColorScale& scale = colors_.scale();
  // editingFinished is also emitted without a change.
  if (low_->text() == end_text(scale.low) && high_->text() == end_text(scale.high)) {
    return;
  }
  colors_.set_range(low_->text().toDouble(), high_->text().toDouble());
}

void ScalePanel::show_choice() {
  const ColorScale& scale = colors_.scale();
  const QSignalBlocker quiet(map_);
  map_->setCurrentIndex(static_cast<int>(colors_.map()));
  enable_if(*map_, !traits_of(colors_.quantity()).is_signed,
            tr("Differences have a map of their own, with 0 in its middle"));
  rules_->button(static_cast<int>(colors_.range_rule()))->setChecked(true);
  if (!low_->hasFocus()) {
    low_->setText(end_text(scale.low));
  }
  if (!high_->hasFocus()) {
    high_->setText(end_text(scale.high));
  }
}

}  // namespace transillum::viewer
