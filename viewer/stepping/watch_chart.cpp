// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The chart below the timeline. The list of watches comes from Watches, the values from the map in
// Focus. Lines go through the smallest and largest value of each pixel column.
#include "stepping/watch_chart.h"

#include <QAction>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <cmath>

#include "stepping/timeline_lanes.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int plot_height = 52;
// The height where the panels leave no more room; the buttons are then beside the plot.
constexpr int least_height = 37, least_plot_height = 30;
constexpr int top_gap = 4, bottom_gap = 5;
constexpr double least_defect = 1e-17;  ///< bottom of the logarithmic scale of closure defects

QIcon icon_of(const QColor& color) {
  QPixmap pixmap(24, 24);
  pixmap.fill(color);
  return QIcon(pixmap);
}

}  // namespace

WatchChart::WatchChart(Focus& focus, Selection& selection, Watches& watches,
                       const TimelineLanes& lanes, QWidget* parent)
    : QWidget(parent),
      focus_(focus),
      selection_(selection),
      watches_(watches),
      lanes_(lanes),
      menu_(std::make_unique<QMenu>()) {
  setToolTip(
      tr("Watched values over the steps of the direction, each on its own scale from 0 to "
         "its largest value (open parts: logarithmic, from 10⁻¹⁷ to 1). Click or drag "
         "to go to a step."));
  make_menu();
  connect(&watches_, &Watches::changed, this, &WatchChart::show_list);
  connect(&focus_, &Focus::moved, this, [this] {
    if (focus_.map() != computed_) {
      compute();
    }
    show_values();
  });
  show_list();
}

WatchChart::~WatchChart() = default;

void WatchChart::make_menu() {
  menu_->setTitle(tr("Watch"));
  const auto add = [this](const char* name, const QString& text, Watch::Kind kind) {
    auto* action = new QAction(text, this);
    menu_->addAction(action);
    connect(action, &QAction::triggered, this, [this, kind] {
      watches_.add({kind, kind == Watch::Kind::patch_area ? selection_.patch() : no_patch});
    });
    action->setObjectName(QString::fromLatin1(name));
    choices_.push_back(action);
  };
  add("watch_area", tr("Area of the selected patch in V"), Watch::Kind::patch_area);
  add("watch_defect", tr("Open part of the receiver"), Watch::Kind::closure_defect);
  add("watch_size", tr("Number of polygons of V"), Watch::Kind::map_size);
  const auto show_state = [this] {
    const bool room = watches_.list().size() < Watches::most;
    for (QAction* choice : choices_) {
      enable_if(*choice, room, tr("There is no room for another"));
    }
    if (room) {
      enable_if(*choices_.front(), selection_.patch() != no_patch, tr("No patch is selected"));
    }
  };
  connect(&selection_, &Selection::changed, this, show_state);
  connect(&watches_, &Watches::changed, this, show_state);
  show_state();
}

QColor WatchChart::color_of(std::size_t k) {
  // Hues by Okabe and Ito, which color-blind viewers can tell apart, darker or lighter than there
  // so that they stand out from the plot.
  constexpr std::array<QRgb, Watches::most> on_light{0xff0072b2, 0xffa97000, 0xff007f5f,
                                                     0xffb3528a, 0xff2483b8, 0xffcc5500};
  constexpr std::array<QRgb, Watches::most> on_dark{0xff4fa8e8, 0xffe69f00, 0xff2fbf96,
                                                    0xffdb8fb8, 0xff9ad3f5, 0xffff8a4a};
  const auto& colors = theme::appearance().dark ? on_dark : on_light;
  return QColor(colors[k % colors.size()]);
}

void WatchChart::show_list() {
  for (const Series& series : series_) {
    delete series.button;
  }
  series_.clear();
  for (const Watch& watch : watches_.list()) {
    const std::size_t k = series_.size();
    auto* button = named(QStringLiteral("watch_%1").arg(k), new QToolButton(this));
    button->setIcon(icon_of(color_of(k)));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setAutoRaise(true);
    button->setIconSize({theme::scaled(12), theme::scaled(12)});
    // The call is made later: the button is deleted with its list.
    connect(
        button, &QToolButton::clicked, this, [this, k] { watches_.remove(k); },
        Qt::QueuedConnection);
    button->show();
    series_.push_back({watch, {}, 0, button});
  }
  setVisible(!series_.empty());
  compute();
  show_values();
}

void WatchChart::compute() {
  computed_ = focus_.map();
  for (Series& series : series_) {
    series.values = computed_ ? values_of(series.watch, computed_->history) : std::vector<double>();
    series.largest = 0;
    for (const double value : series.values) {
      series.largest = std::fmax(series.largest, value);  // not a number where there is no value
    }
  }
}

void WatchChart::show_values() {
  const auto step = static_cast<std::size_t>(focus_.position().step + 1);
  for (const Series& series : series_) {
    const QString name = text_of(series.watch);
    QString text = name, value = QStringLiteral("–");
    if (step < series.values.size()) {
      if (!std::isnan(series.values[step])) {
        value = number_text(series.values[step]);
      }
      text = tr("%1: %2, at most %3").arg(name, value, number_text(series.largest));
    }
    series.button->setText(is_low() ? value : text);
    series.button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    series.button->setToolTip(tr("%1. Click to remove.").arg(text));
  }
  place_buttons();
  update();
}

int WatchChart::button_height() const {
  return series_.empty() ? 0 : series_.front().button->sizeHint().height();
}

bool WatchChart::is_low() const {
  return height() < button_height() + top_gap + theme::scaled(least_plot_height) + bottom_gap;
}

QSize WatchChart::minimumSizeHint() const { return {300, theme::scaled(least_height)}; }

QSize WatchChart::sizeHint() const {
  return {300, button_height() + top_gap + theme::scaled(plot_height) + bottom_gap};
}

void WatchChart::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) {
    for (std::size_t k = 0; k < series_.size(); ++k) {
      series_[k].button->setIcon(icon_of(color_of(k)));
    }
  }
}

void WatchChart::resizeEvent(QResizeEvent*) { show_values(); }

void WatchChart::place_buttons() {
  constexpr int margin = 8, gap = 4;
  const int count = static_cast<int>(series_.size());
  if (is_low()) {
    const int rows = count > 1 ? 2 : 1, row = height() / rows;
    int left = static_cast<int>(plot().right()) + gap, wide = 0;
    for (int k = 0; k < count; ++k) {
      QToolButton& button = *at(series_, k).button;
      left += k % rows == 0 ? wide : 0;
      // A value that is cut off would be taken for another one.
      if (left + button.sizeHint().width() > width()) {
        button.setToolButtonStyle(Qt::ToolButtonIconOnly);
      }
      const int own = button.sizeHint().width();
      wide = k % rows == 0 ? own : std::max(wide, own);
      button.setGeometry(left, k % rows * row, own, row);
    }
    return;
  }
  int wanted = 0;
  for (const Series& series : series_) {
    wanted += series.button->sizeHint().width();
  }
  // Texts without room are cut off; the tool tips have them.
  const double room = width() - 2 * margin - gap * (count - 1);
  const double fraction = std::min(1.0, room / std::max(wanted, 1));
  int left = margin;
  for (const Series& series : series_) {
    const int wide = static_cast<int>(fraction * series.button->sizeHint().width());
    series.button->setGeometry(left, 0, wide, button_height());
    left += wide + gap;
  }
}

QRectF WatchChart::plot() const {
  const QRectF lane = lanes_.rect_of(TimelineLanes::Lane::steps);
  const double top = (is_low() ? 0 : button_height()) + top_gap;
  return {lane.left(), top, lane.width(), std::max(height() - top - bottom_gap, 1.0)};
}

double WatchChart::height_of(std::size_t k, double value) const {
  const Series& series = series_[k];
  const double decades = -std::log10(least_defect);
  const double fraction = series.watch.kind == Watch::Kind::closure_defect
                              ? 1 + std::log10(std::max(value, least_defect)) / decades
                          : series.largest > 0 ? value / series.largest
                                               : 0;
  return plot().bottom() - std::clamp(fraction, 0.0, 1.0) * plot().height();
}

void WatchChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRectF frame = plot();
  painter.fillRect(frame, theme::hover);
  painter.setPen(theme::ink_dim);
  painter.drawText(QRectF(10, frame.top(), frame.left() - 18, 22), Qt::AlignVCenter | Qt::AlignLeft,
                   tr("Watched"));
  if (!computed_) {
    return;
  }
  painter.setRenderHint(QPainter::Antialiasing);
  const int count = computed_->history.step_count() + 1;
  const double x = TimelineLanes::position(frame, focus_.position().step + 1, count);
  painter.setPen(QPen(theme::accent, 2));
  painter.drawLine(QPointF(x, frame.top()), QPointF(x, frame.bottom()));
  for (std::size_t k = 0; k < series_.size(); ++k) {
    draw(painter, k);
  }
}

void WatchChart::draw(QPainter& painter, std::size_t k) const {
  const std::vector<double>& values = series_[k].values;
  const QRectF frame = plot();
  QPolygonF line;
  double column = -1;  // column of the last two points
  for (std::size_t step = 0; step < values.size(); ++step) {
    if (std::isnan(values[step])) {
      continue;
    }
    const QPointF point(
        TimelineLanes::position(frame, static_cast<int>(step), static_cast<int>(values.size())),
        height_of(k, values[step]));
    if (std::floor(point.x()) == column) {
      QPointF &high = line[line.size() - 2], &low = line.last();
      high.setY(std::min(high.y(), point.y()));
      low.setY(std::max(low.y(), point.y()));
      continue;
    }
    column = std::floor(point.x());
    line << point << point;
  }
  painter.setPen(QPen(color_of(k), 1.6 * theme::scale()));
  painter.drawPolyline(line);
}

void WatchChart::go_to(double x) {
  if (computed_) {
    focus_.go_to_step(TimelineLanes::index(plot(), x, computed_->history.step_count() + 1) - 1);
  }
}

void WatchChart::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    go_to(event->localPos().x());
  }
}

void WatchChart::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    go_to(event->localPos().x());
  }
}

}  // namespace transillum::viewer
