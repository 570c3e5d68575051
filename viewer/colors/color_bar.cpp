// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Paints the color map as a bar with ticks, and beside it a histogram of area over values.
#include "colors/color_bar.h"

#include <QFontInfo>
#include <QFontMetricsF>
#include <QLinearGradient>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int margin = 12;
constexpr int histogram_width = 34;
constexpr int bar_width = 18;
constexpr int arrow_height = 12;
constexpr int zero_gap = 6;  // above the color of 0

// The second line of the title: the patch whose form factors are shown, or the shown channel.
QString subtitle_of(const ColorChoice& colors) {
  const QuantityTraits& traits = traits_of(colors.quantity());
  if (traits.of_selection) {
    return ColorBar::tr("i = %1").arg(colors.selection().patch());
  }
  if (!traits.has_channels) {
    return {};
  }
  switch (colors.scale().mode) {
    case ColorMode::red:
      return ColorBar::tr("red");
    case ColorMode::green:
      return ColorBar::tr("green");
    case ColorMode::blue:
      return ColorBar::tr("blue");
    case ColorMode::true_color:
    case ColorMode::luminance:
      break;
  }
  return ColorBar::tr("luminance");
}

QString tick_text(double value, bool logarithmic) {
  if (logarithmic && (value < 1e-3 || value >= 1e5)) {
    const double exponent = std::log10(value);
    if (std::abs(exponent - std::round(exponent)) < 1e-6) {
      return power_of_ten_text(static_cast<int>(std::lround(exponent)));
    }
  }
  return number_text(value);
}

}  // namespace

ColorBar::ColorBar(const ColorChoice& colors, QWidget* parent) : QWidget(parent), colors_(colors) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  setObjectName("color_bar");
  const auto show = [this] {
    setToolTip(
        QString::fromUtf8(traits_of(colors_.quantity()).symbol) + QStringLiteral(": ") +
        tip_of(colors_.quantity()) + QLatin1Char('\n') +
        tr("Left of the bar: area per value, square-root scale. Drag over a range to select the\n"
           "patches with such values"));
    const bool applies = ColorBarSheet::applies(colors_);
    // Selecting moves no picture, though there are no values without a patch.
    setVisible(applies || (colors_.snapshot() && follows_selection(colors_.quantity())));
    setEnabled(applies);  // a range of values can be dragged over
    update();
  };
  connect(&colors, &ColorChoice::changed, this, show);
  connect(&colors, &ColorChoice::fitted, this, show);
  show();
}

bool ColorBarSheet::shows_zero() const { return colors.scale().marks_zero && colors.scale().zeros; }

QRectF ColorBarSheet::bar() const {
  const int line = QFontMetrics(font).height();
  const int top = margin + 2 * line + 10 + arrow_height;
  const int zero_height = shows_zero() ? line + zero_gap : 0;
  return QRectF(margin + histogram_width, top, bar_width,
                size.height() - top - margin - arrow_height - zero_height);
}

void ColorBarSheet::draw(QPainter& painter) const {
  painter.setFont(font);
  paint_title(painter);
  const QRectF box = bar();
  if (box.height() < 20) {
    return;
  }
  paint_bar(painter, box);
  paint_histogram(painter, QRectF(margin, box.top(), histogram_width - 4, box.height()));
  paint_ticks(painter, box);
  if (shows_zero()) {
    paint_zero(painter, QRectF(box.left(), box.bottom() + arrow_height + zero_gap, box.width(),
                               QFontMetrics(font).height()));
  }
}

void ColorBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  if (drag_begin_) {
    QColor band = theme::selection;
    band.setAlphaF(0.4);
    painter.fillRect(QRectF(QPointF(0, *drag_begin_), QPointF(width(), drag_end_)).normalized(),
                     band);
  }
  if (ColorBarSheet::applies(colors_)) {
    sheet().draw(painter);
  }
}

void ColorBar::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    drag_begin_ = drag_end_ = event->pos().y();
  }
}

void ColorBar::mouseMoveEvent(QMouseEvent* event) {
  drag_end_ = event->pos().y();
  update();
}

void ColorBar::mouseReleaseEvent(QMouseEvent* event) {
  if (!drag_begin_) {
    return;
  }
  drag_end_ = event->pos().y();
  const auto [top, bottom] = std::minmax({*std::exchange(drag_begin_, std::nullopt), drag_end_});
  update();
  if (bottom - top < 2) {
    return;  // a click
  }
  const QRectF bar = sheet().bar();
  const ColorScale& scale = colors_.scale();
  const auto value_at = [&](double y) { return scale.value_at((bar.bottom() - y) / bar.height()); };
  // A pointed end of the bar stands for the values beyond it.
  const double low = bottom >= bar.bottom() + 2 ? -HUGE_VAL : value_at(bottom);
  const double high = top <= bar.top() - 2 ? HUGE_VAL : value_at(top);
  std::vector<PatchId> patches;
  for (std::size_t i = 0; i < colors_.values().size(); ++i) {
    const double value = scale.value(colors_.values()[i]);
    if (value >= low && value <= high && !(scale.marks_zero && value == 0)) {
      patches.push_back(static_cast<PatchId>(i));
    }
  }
  emit patches_chosen(patches);
}

void ColorBarSheet::paint_zero(QPainter& painter, const QRectF& box) const {
  painter.fillRect(box, QColor(zero_color[0], zero_color[1], zero_color[2]));
  painter.setPen(ink);
  painter.drawText(box.translated(box.width() + 9, 0), Qt::AlignLeft | Qt::AlignVCenter,
                   QStringLiteral("0"));
}

void ColorBarSheet::paint_title(QPainter& painter) const {
  const QuantityTraits& traits = traits_of(colors.quantity());
  const QString unit = QString::fromUtf8(traits.unit);
  const int line = QFontMetrics(font).height();
  QFont bold = font;
  bold.setBold(true);
  const QString title = QString::fromUtf8(traits.symbol) +
                        (unit.isEmpty() ? unit : QStringLiteral(" (%1)").arg(unit));
  const double room = size.width() - margin, needed = QFontMetricsF(bold).horizontalAdvance(title);
  if (needed > room) {
    bold.setPixelSize(static_cast<int>(room / needed * QFontInfo(bold).pixelSize()));
  }
  painter.setFont(bold);
  painter.setPen(ink);
  painter.drawText(QRectF(0, margin, size.width(), line), Qt::AlignHCenter, title);
  painter.setFont(font);
  painter.setPen(dim);
  painter.drawText(QRectF(0, margin + line, size.width(), line), Qt::AlignHCenter,
                   subtitle_of(colors));
}

void ColorBarSheet::paint_bar(QPainter& painter, const QRectF& bar) const {
  const ColorScale& scale = colors.scale();
  const auto color_at = [&](double t) {
    const Color8 c = color_of(scale.map, t);
    return QColor(c[0], c[1], c[2]);
  };
  // One shape, without seams also in vector graphics.
  constexpr int stops = 64;
  QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
  for (int k = 0; k <= stops; ++k) {
    gradient.setColorAt(1.0 * k / stops, color_at(1.0 * k / stops));
  }
  painter.fillRect(bar, gradient);
  // An arrow at an end of the bar: there are values beyond it. `sign` -1: upward.
  const auto paint_arrow = [&](double y, double sign, const QColor& color) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawPolygon(
        QPolygonF({QPointF(bar.left(), y + 2 * sign), QPointF(bar.right(), y + 2 * sign),
                   QPointF(bar.center().x(), y + arrow_height * sign)}));
    painter.setBrush(Qt::NoBrush);
    painter.setRenderHint(QPainter::Antialiasing, false);
  };
  if (scale.above) {
    paint_arrow(bar.top(), -1, color_at(1));
  }
  if (scale.below) {
    paint_arrow(bar.bottom(), 1, color_at(0).lighter(160));
  }
  painter.setPen(QPen(dim, 1));
  painter.drawRect(bar.adjusted(-0.5, -0.5, 0.5, 0.5));
}

void ColorBarSheet::paint_histogram(QPainter& painter, const QRectF& box) const {
  constexpr double pixels_per_bin = 4;
  const int bins = std::max(1, static_cast<int>(box.height() / pixels_per_bin));
  const double bin_height = box.height() / bins;
  const std::vector<double> fractions =
      histogram(colors.scale(), *colors.snapshot()->loaded->scene, colors.values(), bins);
  for (int k = 0; k < bins; ++k) {
    const double fraction = at(fractions, k);
    if (fraction <= 0) {
      continue;
    }
    // The square root makes rare values visible beside common ones.
    const double length = std::max(1.0, std::sqrt(fraction) * box.width());
    painter.fillRect(QRectF(box.right() - length, box.bottom() - (k + 1) * bin_height, length,
                            std::max(1.0, bin_height - 1)),
                     dim);
  }
}

void ColorBarSheet::paint_ticks(QPainter& painter, const QRectF& bar) const {
  const ColorScale& scale = colors.scale();
  const int line = QFontMetrics(font).height();
  painter.setPen(ink);
  for (const double value : scale.ticks()) {
    const double y = bar.bottom() - scale.position(value) * bar.height();
    painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + 5, y));
    painter.drawText(QRectF(bar.right() + 9, y - line / 2.0, size.width() - bar.right() - 9, line),
                     Qt::AlignLeft | Qt::AlignVCenter, tick_text(value, scale.logarithmic));
  }
}

}  // namespace transillum::viewer
