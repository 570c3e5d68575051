// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "color_controls.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "scale_menu.h"
#include "show_menu.h"

namespace transillum::viewer {

namespace {

constexpr double lowest_exposure = -12, highest_exposure = 12;  // EV
constexpr int slider_steps_per_ev = 10;
constexpr int spacing = 8;
constexpr int narrowest_quantity = 110, widest_quantity = 240, narrowest_mode = 90;

QLabel* label_for(QWidget* control, const QString& text) {
  auto* label = new QLabel(text);
  label->setBuddy(control);
  return label;
}

/// Whether an item of the list can be chosen.
void offer(QComboBox& list, int item, bool offered) {
  auto* model = qobject_cast<QStandardItemModel*>(list.model());
  model->item(item)->setEnabled(offered);
}

int room_for(const QWidget& widget) {
  // A minimum that was set counts, as in a layout.
  const int set = widget.minimumWidth();
  return (set > 0 ? set : widget.minimumSizeHint().width()) + spacing;
}

QString tr_quantity(const char* text) { return QCoreApplication::translate("Quantity", text); }

}  // namespace

ColorControls::ColorControls(ColorChoice& colors, QWidget* parent)
    : QWidget(parent), colors_(colors) {
  quantity_ = new QComboBox;
  quantity_->setObjectName("quantity");
  quantity_->setMinimumWidth(narrowest_quantity);
  quantity_->setMaximumWidth(widest_quantity);
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  quantity_->setMinimumContentsLength(9);
  fill_quantities();
  mode_ = new QComboBox;
  mode_->setObjectName("color_mode");
  mode_->setMinimumWidth(narrowest_mode);
  mode_->addItems({tr("True colour"), tr("Luminance"), tr("Red channel"), tr("Green channel"),
                   tr("Blue channel")});
  pages_ = new QStackedWidget;
  pages_->addWidget(make_true_color_page());
  pages_->addWidget(make_map_page());
  pages_->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
  show_ = new ShowMenu;

  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 5, 10, 5);
  layout->setSpacing(spacing);
  layout->addWidget(*spare_.insert(spare_.begin(), label_for(quantity_, tr("Colour"))));
  layout->addWidget(quantity_, 4);
  layout->addWidget(mode_);
  layout->addSpacing(8);
  layout->addWidget(pages_);
  layout->addStretch(1);
  layout->addWidget(show_);

  connect(quantity_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    colors_.set_quantity(static_cast<Quantity>(quantity_->itemData(index).toInt()));
  });
  connect(mode_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { colors_.set_mode(static_cast<ColorMode>(index)); });
  connect(show_->direction(), &QAction::toggled, this, &ColorControls::direction_toggled);
  connect(show_->outlines(), &QAction::toggled, this, &ColorControls::outlines_toggled);
  connect(&colors_, &ColorChoice::changed, this, &ColorControls::show_choice);
  connect(&colors_, &ColorChoice::fitted, this, &ColorControls::show_choice);
  show_choice();
  measure();
}

void ColorControls::add_tool(QWidget* tool) {
  layout()->addWidget(spare_.emplace_back(tool));
  measure();
}

void ColorControls::measure() {
  int page = 0;
  for (int k = 0; k < pages_->count(); ++k)
    page = std::max(page, least_width(*pages_->widget(k)->layout()));
  setMinimumWidth(least_width(*layout()) + page);
  leave_out();
}

int ColorControls::least_width(const QLayout& row) const {
  int sum = row.contentsMargins().left() + row.contentsMargins().right();
  for (int k = 0; k < row.count(); ++k) {
    QLayoutItem* item = row.itemAt(k);
    const QWidget* widget = item->widget();
    const bool spare = std::find(spare_.begin(), spare_.end(), widget) != spare_.end();
    if (!widget)
      sum += item->minimumSize().width() + spacing;
    else if (!spare && widget != pages_)
      sum += room_for(*widget);
  }
  return sum;
}

void ColorControls::fill_quantities() {
  // What belongs together is set apart from the rest.
  for (const QuantityTraits& traits : quantity_traits()) {
    const bool begins_group = traits.quantity == Quantity::form_factor_from ||
                              traits.quantity == Quantity::fragments ||
                              traits.quantity == Quantity::difference;
    if (begins_group) quantity_->insertSeparator(quantity_->count());
    quantity_->addItem(tr_quantity(traits.name), static_cast<int>(traits.quantity));
    quantity_->setItemData(quantity_->count() - 1, tr_quantity(traits.meaning), Qt::ToolTipRole);
  }
}

void ColorControls::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  leave_out();
}

void ColorControls::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  measure();  // a change of type while it was hidden has not reached it
}

void ColorControls::leave_out() {
  int left = width() - minimumWidth();
  // The last ones are missed most.
  for (auto widget = spare_.rbegin(); widget != spare_.rend(); ++widget) {
    const QWidget* page = (*widget)->parentWidget();
    const bool behind = page->parentWidget() == pages_ && page != pages_->currentWidget();
    const int needed = behind ? 0 : room_for(**widget);
    (*widget)->setVisible(needed <= left);
    if (needed <= left) left -= needed;
  }
}

QWidget* ColorControls::make_true_color_page() {
  exposure_slider_ = new QSlider(Qt::Horizontal);
  exposure_slider_->setRange(static_cast<int>(lowest_exposure) * slider_steps_per_ev,
                             static_cast<int>(highest_exposure) * slider_steps_per_ev);
  exposure_slider_->setMinimumWidth(70);
  exposure_slider_->setMaximumWidth(110);
  exposure_ = new QDoubleSpinBox;
  exposure_->setObjectName("exposure");
  exposure_->setRange(lowest_exposure, highest_exposure);
  exposure_->setSingleStep(0.25);
  exposure_->setDecimals(2);
  exposure_->setSuffix(tr(" EV"));
  exposure_->setToolTip(tr("Shown is 2 to the power of the exposure, times B"));
  automatic_ = new QCheckBox(tr("Auto"));
  automatic_->setToolTip(tr("Expose for what is lit, anew for every picture"));
  gamma_ = new QDoubleSpinBox;
  gamma_->setRange(1.0, 3.0);
  gamma_->setSingleStep(0.1);
  gamma_->setDecimals(1);
  gamma_->setPrefix(tr("γ "));
  gamma_->setToolTip(tr("Gamma of the screen"));

  auto* page = new QWidget;
  auto* layout = new QHBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(spacing);
  layout->addWidget(spare_.emplace_back(label_for(exposure_, tr("Exposure"))));
  layout->addWidget(spare_.emplace_back(exposure_slider_));
  layout->addWidget(exposure_);
  layout->addWidget(automatic_);
  layout->addSpacing(8);
  layout->addWidget(gamma_);
  spare_.insert(spare_.end(), {gamma_, automatic_, exposure_});

  connect(exposure_slider_, &QSlider::valueChanged, this, [this](int value) {
    colors_.set_exposure(static_cast<double>(value) / slider_steps_per_ev);
  });
  connect(exposure_, qOverload<double>(&QDoubleSpinBox::valueChanged), &colors_,
          &ColorChoice::set_exposure);
  connect(automatic_, &QCheckBox::toggled, &colors_, &ColorChoice::set_automatic_exposure);
  connect(gamma_, qOverload<double>(&QDoubleSpinBox::valueChanged), &colors_,
          &ColorChoice::set_gamma);
  return page;
}

QWidget* ColorControls::make_map_page() {
  logarithmic_ = new QCheckBox(tr("Logarithmic"));
  logarithmic_->setObjectName("logarithmic");

  auto* page = new QWidget;
  auto* layout = new QHBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(spacing);
  layout->addWidget(spare_.emplace_back(logarithmic_));
  layout->addWidget(spare_.emplace_back(new ScaleMenu(colors_)));
  layout->addStretch(1);

  connect(logarithmic_, &QCheckBox::toggled, &colors_, &ColorChoice::set_logarithmic);
  return page;
}

void ColorControls::toggle_direction() { show_->direction()->toggle(); }

void ColorControls::set_direction(bool shown) { show_->direction()->setChecked(shown); }

bool ColorControls::direction() const { return show_->direction()->isChecked(); }

void ColorControls::set_outlines(bool shown) { show_->outlines()->setChecked(shown); }

bool ColorControls::outlines() const { return show_->outlines()->isChecked(); }

void ColorControls::show_choice() {
  const ColorScale& scale = colors_.scale();
  const QSignalBlocker quiet[] = {QSignalBlocker(exposure_slider_),
                                  QSignalBlocker(exposure_),
                                  QSignalBlocker(automatic_),
                                  QSignalBlocker(gamma_),
                                  QSignalBlocker(logarithmic_),
                                  QSignalBlocker(quantity_),
                                  QSignalBlocker(mode_)};
  const QuantityTraits& traits = traits_of(colors_.quantity());
  quantity_->setCurrentIndex(quantity_->findData(static_cast<int>(traits.quantity)));
  quantity_->setToolTip(tr_quantity(traits.meaning));
  mode_->setCurrentIndex(static_cast<int>(scale.mode));
  mode_->setVisible(traits.has_channels);
  offer(*mode_, 0, traits.is_light);
  const int page = scale.mode == ColorMode::true_color ? 0 : 1;
  if (page != pages_->currentIndex()) {
    pages_->setCurrentIndex(page);
    leave_out();
  }
  exposure_slider_->setValue(static_cast<int>(std::lround(scale.exposure * slider_steps_per_ev)));
  exposure_->setValue(scale.exposure);
  automatic_->setChecked(colors_.exposure_is_automatic());
  gamma_->setValue(scale.gamma);
  logarithmic_->setEnabled(!traits.is_signed);
  logarithmic_->setChecked(scale.logarithmic);
}

}  // namespace transillum::viewer
