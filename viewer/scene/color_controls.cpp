// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The row above the 3-D view. It shows and sets a ColorChoice (quantity; in a menu color mode,
// exposure, range), and holds the Show menu.
#include "scene/color_controls.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QToolButton>
#include <QWidgetAction>
#include <cmath>

#include "colors/scale_panel.h"
#include "scene/show_menu.h"
#include "widgets/build.h"
#include "widgets/elided.h"

namespace transillum::viewer {

namespace {

constexpr double lowest_exposure = -12, highest_exposure = 12;  // EV
constexpr int slider_steps_per_ev = 10;
constexpr int spacing = 8;
constexpr int min_quantity_letters = 4;  // in a narrow scene
constexpr int max_quantity_width = 260;

/// Enables an item of the list, or disables it and says why in its tool tip.
void enable_item(QComboBox& list, int item, bool enabled, const QString& why) {
  auto* model = qobject_cast<QStandardItemModel*>(list.model());
  model->item(item)->setEnabled(enabled);
  model->item(item)->setToolTip(enabled ? QString() : why);
}

QString tr_quantity(const char* text) { return QCoreApplication::translate("Quantity", text); }

}  // namespace

ColorControls::ColorControls(ColorChoice& colors, QWidget* parent)
    : QWidget(parent), colors_(colors) {
  make_quantity();
  make_scale_menu();
  show_ = new ShowMenu;
  auto* row = make_row(this, {10, 5, 10, 5}, spacing);
  row->addWidget(quantity_, 1);
  row->addWidget(scale_);
  row->addStretch(1);
  row->addWidget(show_);

  connect(quantity_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    colors_.set_quantity(static_cast<Quantity>(quantity_->itemData(index).toInt()));
  });
  connect(mode_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { colors_.set_mode(static_cast<ColorMode>(index)); });
  connect(show_->direction(), &QAction::toggled, this, &ColorControls::direction_toggled);
  connect(show_->outlines(), &QAction::toggled, this, &ColorControls::outlines_toggled);
  connect(&colors_, &ColorChoice::changed, this, &ColorControls::show_choice);
  connect(&colors_, &ColorChoice::fitted, this, &ColorControls::show_choice);
  quantity_->view()->parentWidget()->installEventFilter(this);
  show_choice();
}

void ColorControls::make_quantity() {
  quantity_ = named("quantity", new ElidedComboBox);
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  quantity_->setMinimumContentsLength(min_quantity_letters);
  quantity_->setMaximumWidth(max_quantity_width);
  quantity_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  fill_quantities();
}

void ColorControls::make_scale_menu() {
  mode_ = named("color_mode", new QComboBox);
  mode_->addItems({tr("True color"), tr("Luminance"), tr("Red"), tr("Green"), tr("Blue")});
  pages_ = new QStackedWidget;
  pages_->addWidget(make_true_color_page());
  pages_->addWidget(make_map_page());
  auto* panel = new QWidget;
  auto* column = make_column(panel, {14, 10, 14, 12}, spacing);
  column->addWidget(mode_);
  column->addWidget(pages_);
  scale_ = named("scale_button", new QToolButton, tr("Set the exposure, or the color map"));
  scale_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  auto* action = new QWidgetAction(menu);
  action->setDefaultWidget(panel);
  menu->addAction(action);
  scale_->setMenu(menu);
}

bool ColorControls::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Hide) {
    emit list_closed();
  }
  return QWidget::eventFilter(watched, event);
}

void ColorControls::add_tool(QWidget* tool) { layout()->addWidget(tool); }

void ColorControls::set_thin(bool thin) {
  for (int k = 0; k < layout()->count(); ++k) {
    QWidget* tool = layout()->itemAt(k)->widget();
    if (tool != nullptr && tool != quantity_ && tool != show_) {
      tool->setVisible(!thin);
    }
  }
}

void ColorControls::fill_quantities() {
  // Separators between groups.
  for (const QuantityTraits& traits : quantity_traits()) {
    const bool begins_group = traits.quantity == Quantity::form_factor_from ||
                              traits.quantity == Quantity::fragments ||
                              traits.quantity == Quantity::difference;
    if (begins_group) {
      quantity_->insertSeparator(quantity_->count());
    }
    quantity_->addItem(tr_quantity(traits.name), static_cast<int>(traits.quantity));
    quantity_->setItemData(quantity_->count() - 1, tip_of(traits.quantity), Qt::ToolTipRole);
    quantity_->setItemData(quantity_->count() - 1, QString::fromUtf8(traits.symbol),
                           ElidedComboBox::short_text);
  }
}

QWidget* ColorControls::make_true_color_page() {
  exposure_slider_ = named("exposure_slider", new QSlider(Qt::Horizontal));
  exposure_slider_->setRange(static_cast<int>(lowest_exposure) * slider_steps_per_ev,
                             static_cast<int>(highest_exposure) * slider_steps_per_ev);
  exposure_ =
      named("exposure", new QDoubleSpinBox, tr("Exposure: B is multiplied by 2 to this power"));
  exposure_->setRange(lowest_exposure, highest_exposure);
  exposure_->setSingleStep(0.25);
  exposure_->setDecimals(2);
  exposure_->setSuffix(tr(" EV"));
  automatic_ = new QCheckBox(tr("Auto"));
  automatic_->setToolTip(tr("Adjust exposure automatically"));
  gamma_ = new QDoubleSpinBox;
  gamma_->setRange(1.0, 3.0);
  gamma_->setSingleStep(0.1);
  gamma_->setDecimals(1);
  gamma_->setToolTip(tr("Gamma of the display"));

  auto* page = new QWidget;
  auto* grid = new QGridLayout(page);
  grid->setContentsMargins({});
  grid->addWidget(new QLabel(tr("Exposure")), 0, 0);
  grid->addWidget(exposure_, 0, 1);
  grid->addWidget(automatic_, 0, 2);
  grid->addWidget(exposure_slider_, 1, 0, 1, 3);
  grid->addWidget(new QLabel(tr("Gamma of the display")), 2, 0);
  grid->addWidget(gamma_, 2, 1);

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
  logarithmic_ = named("logarithmic", new QCheckBox(tr("Logarithmic")));

  auto* page = new QWidget;
  auto* layout = make_column(page, {}, spacing);
  layout->addWidget(logarithmic_);
  layout->addWidget(new ScalePanel(colors_));
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
  quantity_->setToolTip(tip_of(traits.quantity));
  mode_->setCurrentIndex(static_cast<int>(scale.mode));
  mode_->setVisible(traits.has_channels);
  enable_item(*mode_, 0, traits.is_light, tr("The quantity is no light"));
  scale_->setText((traits.has_channels ? mode_->currentText() : tr("Colors")) + QLatin1Char(' '));
  const int page = scale.mode == ColorMode::true_color ? 0 : 1;
  pages_->setCurrentIndex(page);
  exposure_slider_->setValue(static_cast<int>(std::lround(scale.exposure * slider_steps_per_ev)));
  exposure_->setValue(scale.exposure);
  automatic_->setChecked(colors_.exposure_is_automatic());
  gamma_->setValue(scale.gamma);
  enable_if(*logarithmic_, !traits.is_signed, tr("The quantity has values below 0"));
  logarithmic_->setChecked(scale.logarithmic);
  show_->set_linear(colors_.linear() && !colors_.is_fitted());
}

}  // namespace transillum::viewer
