// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The strip above the 3-D view. It shows and sets a ColorChoice (quantity, color mode, exposure,
// range), and holds the Show menu.
#include "scene/color_controls.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <algorithm>
#include <cmath>

#include "colors/scale_menu.h"
#include "scene/show_menu.h"
#include "widgets/build.h"
#include "widgets/elided.h"

namespace transillum::viewer {

namespace {

constexpr double lowest_exposure = -12, highest_exposure = 12;  // EV
constexpr int slider_steps_per_ev = 10;
constexpr int spacing = 8;
constexpr int min_quantity_letters = 7;  // wide letters: fits "Radiosity B"
constexpr int max_quantity_width = 260;

QHBoxLayout* row_in(QWidget* part) {
  auto* row = make_row(part, {}, spacing);
  return row;
}

/// Enables or disables an item of the list.
void set_item_enabled(QComboBox& list, int item, bool enabled) {
  auto* model = qobject_cast<QStandardItemModel*>(list.model());
  model->item(item)->setEnabled(enabled);
}

QString tr_quantity(const char* text) { return QCoreApplication::translate("Quantity", text); }

}  // namespace

ColorControls::ColorControls(ColorChoice& colors, QWidget* parent)
    : QWidget(parent), colors_(colors) {
  make_quantity_row();
  pages_ = new QStackedWidget;
  pages_->addWidget(make_true_color_page());
  pages_->addWidget(make_map_page());
  pages_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  tools_ = new QWidget;
  tools_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  show_ = new ShowMenu;
  row_in(tools_)->addWidget(show_);

  grid_ = new QGridLayout(this);
  grid_->setContentsMargins(10, 5, 10, 5);
  grid_->setHorizontalSpacing(spacing);
  grid_->setVerticalSpacing(4);
  arrange();

  connect(quantity_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    colors_.set_quantity(static_cast<Quantity>(quantity_->itemData(index).toInt()));
  });
  connect(mode_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { colors_.set_mode(static_cast<ColorMode>(index)); });
  connect(show_->direction(), &QAction::toggled, this, &ColorControls::direction_toggled);
  connect(show_->outlines(), &QAction::toggled, this, &ColorControls::outlines_toggled);
  connect(&colors_, &ColorChoice::changed, this, &ColorControls::show_choice);
  connect(&colors_, &ColorChoice::fitted, this, &ColorControls::show_choice);
  for (const QComboBox* list : {quantity_, mode_}) {
    list->view()->parentWidget()->installEventFilter(this);
  }
  show_choice();
}

void ColorControls::make_quantity_row() {
  quantity_ = named("quantity", new ElidedComboBox);
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  quantity_->setMinimumContentsLength(min_quantity_letters);
  quantity_->setMaximumWidth(max_quantity_width);
  quantity_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  fill_quantities();
  mode_ = named("color_mode", new QComboBox);
  mode_->addItems({tr("True color"), tr("Luminance"), tr("Red"), tr("Green"), tr("Blue")});
  QSizePolicy fixed(QSizePolicy::Fixed, QSizePolicy::Fixed);
  fixed.setRetainSizeWhenHidden(true);  // so that the layout is the same for all quantities
  mode_->setSizePolicy(fixed);
  quantity_row_ = new QWidget;
  quantity_row_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  auto* row = row_in(quantity_row_);
  row->setSizeConstraint(QLayout::SetMinAndMaxSize);
  row->addWidget(quantity_, 1);
  row->addWidget(mode_);
}

bool ColorControls::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Hide) {
    emit list_closed();
  }
  return QWidget::eventFilter(watched, event);
}

void ColorControls::add_tool(QWidget* tool) { tools_->layout()->addWidget(tool); }

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
  }
}

bool ColorControls::event(QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) {
    arrange();
  }
  const bool placed = event->type() == QEvent::Resize || event->type() == QEvent::Show;
  if (placed && height() != grid_->sizeHint().height()) {
    ask_for_height();  // the layout above used the old size
  }
  return QWidget::event(event);
}

void ColorControls::arrange() {
  const QMargins margins = grid_->contentsMargins();
  const int room = width() - margins.left() - margins.right();
  const int tools = tools_->sizeHint().width();
  // Hides the slider where there is no room: the box beside it shows the same value.
  const int spare =
      exposure_label_->sizeHint().width() + exposure_slider_->sizeHint().width() + 2 * spacing;
  const int exposure = pages_->widget(0)->sizeHint().width();
  const int scale = pages_->widget(1)->sizeHint().width();
  // The result does not depend on whether the slider is hidden: otherwise each arrangement could
  // ask for the other.
  const int page = std::max(exposure - (exposure_slider_->isHidden() ? 0 : spare), scale);
  const int quantity = quantity_row_->minimumSizeHint().width();
  setMinimumWidth(std::max({quantity, tools, page}) + margins.left() + margins.right());

  const int others = quantity_row_->sizeHint().width() + tools + 2 * spacing;
  const bool one_row = others + page <= room;
  const bool whole = page + spare + (one_row ? others : 0) <= room;
  exposure_label_->setVisible(whole);
  exposure_slider_->setVisible(whole);
  const int rows = one_row ? 1 : quantity + spacing + tools <= room ? 2 : 3;
  if (rows == rows_) {
    return;
  }
  rows_ = rows;
  if (rows < 3) {
    grid_->addWidget(quantity_row_, 0, 0);
    grid_->addWidget(tools_, 0, 2);
  } else {
    grid_->addWidget(quantity_row_, 0, 0, 1, 3);
    grid_->addWidget(tools_, 1, 0, 1, 3, Qt::AlignLeft);
  }
  if (one_row) {
    grid_->addWidget(pages_, 0, 1, Qt::AlignLeft);
  } else {
    grid_->addWidget(pages_, rows - 1, 0, 1, 3, Qt::AlignLeft);
  }
  ask_for_height();
}

// Within a resize, and while a page above is hidden, the layouts above do not notice that the
// height changes.
void ColorControls::ask_for_height() {
  QMetaObject::invokeMethod(
      this,
      [this] {
        updateGeometry();
        for (QWidget* above = parentWidget(); above && above->layout();
             above = above->parentWidget()) {
          above->layout()->activate();
        }
      },
      Qt::QueuedConnection);
}

QWidget* ColorControls::make_true_color_page() {
  exposure_slider_ = named("exposure_slider", new QSlider(Qt::Horizontal));
  exposure_slider_->setRange(static_cast<int>(lowest_exposure) * slider_steps_per_ev,
                             static_cast<int>(highest_exposure) * slider_steps_per_ev);
  exposure_slider_->setMinimumWidth(70);
  exposure_slider_->setMaximumWidth(110);
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
  gamma_->setPrefix(tr("γ "));
  gamma_->setToolTip(tr("Gamma of the display"));

  exposure_label_ = new QLabel(tr("Exposure"));
  exposure_label_->setBuddy(exposure_);
  auto* page = new QWidget;
  QHBoxLayout* layout = row_in(page);
  layout->addWidget(exposure_label_);
  layout->addWidget(exposure_slider_);
  layout->addWidget(exposure_);
  layout->addWidget(automatic_);
  layout->addWidget(gamma_);

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
  QHBoxLayout* layout = row_in(page);
  layout->addWidget(logarithmic_);
  layout->addWidget(new ScaleMenu(colors_));
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
  set_item_enabled(*mode_, 0, traits.is_light);
  const int page = scale.mode == ColorMode::true_color ? 0 : 1;
  pages_->setCurrentIndex(page);
  exposure_slider_->setValue(static_cast<int>(std::lround(scale.exposure * slider_steps_per_ev)));
  exposure_->setValue(scale.exposure);
  automatic_->setChecked(colors_.exposure_is_automatic());
  gamma_->setValue(scale.gamma);
  logarithmic_->setEnabled(!traits.is_signed);
  logarithmic_->setChecked(scale.logarithmic);
  show_->set_linear(colors_.linear());
}

}  // namespace transillum::viewer
