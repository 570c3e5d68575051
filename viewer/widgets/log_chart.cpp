// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Chart of positive values over counts, such as changes over iterations. The window gives the lines
// and levels; the library's chart painter draws them to a picture that is kept until they change.
#include "widgets/log_chart.h"

#include <QEvent>
#include <QFontInfo>
#include <QMouseEvent>
#include <QPainter>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "support/number_text.h"
#include "widgets/theme.h"

namespace transillum::viewer {

ChartColor chart_color(const QColor& color) {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
  return {byte(color.red()), byte(color.green()), byte(color.blue())};
}

ChartStyle chart_style(const QWidget& widget) {
  const QFontInfo font(widget.font());
  ChartStyle style;
  style.paper = chart_color(theme::paper);
  style.ink = chart_color(theme::ink);
  style.dim = chart_color(theme::ink_dim);
  style.grid = chart_color(theme::rule);
  style.font = font.family().toStdString();
  style.title_size = style.text_size = style.label_size = font.pixelSize();
  style.bold_title = true;
  style.margin = 8;
  style.line_width = 1;
  style.framed = true;
  return style;
}

ChartArea paint_chart(const LineChart& chart, QImage& picture, const QSize& pixels, double scale) {
  picture = QImage(pixels, QImage::Format_RGB32);
  if (picture.isNull()) {
    return {};
  }
  return transillum::paint_chart(chart,
                                 {reinterpret_cast<std::uint32_t*>(picture.bits()), pixels.width(),
                                  pixels.height(), picture.bytesPerLine() / 4},
                                 scale);
}

namespace {

bool drawable(double value) { return value > 0 && std::isfinite(value); }

int count_step(int count, int labels) {
  const double rough = std::max(1.0, static_cast<double>(count) / std::max(labels, 1));
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double lead : {1.0, 2.0, 5.0}) {
    if (lead * power >= rough) {
      return static_cast<int>(lead * power);
    }
  }
  return static_cast<int>(10 * power);
}

}  // namespace

Decades decades_of(const std::vector<LogChart::Line>& lines,
                   const std::vector<LogChart::Level>& levels) {
  double low = HUGE_VAL, high = 0;
  const auto count = [&](double value) {
    if (!drawable(value)) {
      return;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const auto& line : lines) {
    for (const double value : line.values) {
      count(value);
    }
  }
  const bool any = high > 0;
  for (const auto& level : levels) {
    count(level.value);
  }
  if (!any) {
    count(1);  // leaves room above a level until there are values
  }
  Decades decades{static_cast<int>(std::floor(std::log10(low))),
                  static_cast<int>(std::ceil(std::log10(high)))};
  if (decades.first == decades.last) {
    --decades.first;
  }
  return decades;
}

/// Horizontal positions of counts, logical pixels.
struct LogChart::Scale {
  double left, width;
  int x_max;

  double x(double count) const {
    return left + (x_max > 1 ? (count - 1) / (x_max - 1) : 0.5) * width;
  }
};

LogChart::LogChart(const QString& title, const QString& x_title, const QString& y_title,
                   QWidget* parent)
    : QWidget(parent), title_(title), x_title_(x_title), y_title_(y_title) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void LogChart::set_title(const QString& title) {
  if (title == title_) {
    return;
  }
  title_ = title;
  change();
}

void LogChart::set_hint(const QString& hint) {
  hint_ = hint;
  change();
}

void LogChart::show_lines(std::vector<Line> lines, std::vector<Level> levels, int x_max) {
  lines_ = std::move(lines);
  levels_ = std::move(levels);
  x_max_ = std::max(x_max, 1);
  for (const Line& line : lines_) {
    x_max_ = std::max(x_max_, static_cast<int>(line.values.size()));
  }
  change();
}

void LogChart::set_axes(QStringList names, const Decades& decades) {
  names_ = std::move(names);
  decades_ = decades;
  x_max_ = std::max(1, static_cast<int>(names_.size()));
  change();
}

Decades LogChart::decades() const { return decades_ ? *decades_ : decades_of(lines_, levels_); }

void LogChart::set_mark(std::optional<int> x) {
  if (x == mark_) {
    return;
  }
  mark_ = x;
  change();
}

void LogChart::change() {
  picture_ = {};
  update();
}

void LogChart::changeEvent(QEvent* event) {
  change();  // fonts or colors may differ
  QWidget::changeEvent(event);
}

LogChart::Scale LogChart::scale() const {
  draw();
  return {area_.left, std::max(area_.right - area_.left, 1.0), x_max_};
}

int LogChart::count_at(const QPointF& position) const {
  const Scale s = scale();
  const double fraction = (position.x() - s.left) / s.width;
  return static_cast<int>(std::clamp(std::round(1 + fraction * (s.x_max - 1)), 1.0, 1.0 * s.x_max));
}

QPointF LogChart::position_of(int x) const {
  return {scale().x(x), (area_.top + area_.bottom) / 2};
}

QPointF LogChart::position_of(int x, double value) const {
  const double left = scale().x(x);
  const Decades shown = decades();
  const double fraction = (std::log10(value) - shown.first) / (shown.last - shown.first);
  return {left, area_.bottom - fraction * (area_.bottom - area_.top)};
}

void LogChart::mousePressEvent(QMouseEvent* event) {
  draw();
  const QRectF plot(QPointF(area_.left, area_.top), QPointF(area_.right, area_.bottom));
  if (event->button() == Qt::LeftButton && plot.contains(event->localPos())) {
    emit clicked(count_at(event->localPos()));
    point_at(event->localPos());
  }
}

void LogChart::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    point_at(event->localPos());
  }
}

void LogChart::point_at(const QPointF& position) {
  const int x = count_at(position);
  const double height = std::max(area_.bottom - area_.top, 1.0);
  const double fraction = std::clamp((area_.bottom - position.y()) / height, 0.0, 1.0);
  const Decades shown = decades();
  emit pointed(x, std::pow(10, shown.first + fraction * (shown.last - shown.first)));
}

LineChart LogChart::chart() const {
  LineChart chart;
  chart.style = chart_style(*this);
  chart.title = title_.toStdString();
  chart.legend_below_title = true;
  // A low chart needs its height for the curves; its title is enough.
  chart.axis_titles = height() > 9 * fontMetrics().height();

  const Decades decades = this->decades();
  chart.y = {y_title_.toStdString(),
             std::pow(10, decades.first),
             std::pow(10, decades.last),
             true,
             true,
             {}};
  for (int e = decades.first; e <= decades.last; ++e) {
    chart.y.ticks.push_back({std::pow(10, e), power_of_ten_text(e).toStdString()});
  }
  const bool one = x_max_ == 1;
  chart.x = {x_title_.toStdString(), one ? 0.5 : 1, one ? 1.5 : x_max_, false, false, {}};
  for (int x = 1; x <= names_.size(); ++x) {
    chart.x.ticks.push_back({1.0 * x, names_[x - 1].toStdString()});
  }
  const int step = count_step(x_max_ - 1, width() / 60);
  for (int x = step; x <= x_max_ && names_.isEmpty(); x += step) {
    chart.x.ticks.push_back({1.0 * x, count_text(x).toStdString()});
  }

  add_levels(chart);
  add_mark(chart);
  add_lines(chart);
  return chart;
}

void LogChart::add_levels(LineChart& chart) const {
  for (const Level& level : levels_) {
    if (!drawable(level.value)) {
      continue;
    }
    ChartSeries series;
    series.name = level.name.toStdString();
    series.color = chart_color(level.color);
    series.width = 1.5 * theme::scale();
    series.dashes = ChartDashes::dashes;
    series.points = {{chart.x.low, level.value}, {chart.x.high, level.value}};
    chart.series.push_back(series);
  }
}

void LogChart::add_mark(LineChart& chart) const {
  if (!mark_ || *mark_ > x_max_) {
    return;
  }
  ChartSeries series;
  series.color = chart_color(theme::accent);
  series.width = 1;
  series.points = {{1.0 * *mark_, chart.y.low}, {1.0 * *mark_, chart.y.high}};
  chart.series.push_back(series);
  series.marker = ChartMarker::pointer;
  series.points.erase(series.points.begin());
  chart.series.push_back(series);
}

void LogChart::add_lines(LineChart& chart) const {
  bool any = false;
  for (const Line& line : lines_) {
    ChartSeries series;
    std::ptrdiff_t gaps = 0;
    for (std::size_t k = 0; k < line.values.size(); ++k) {
      series.points.push_back({static_cast<double>(k + 1), line.values[k]});
      if (!drawable(line.values[k])) {
        ++gaps;
      }
    }
    any = any || gaps < std::ssize(line.values);
    const QString name = gaps == 0 || line.name.isEmpty()
                             ? line.name
                             : tr("%1 (%2 zero)").arg(line.name, count_text(gaps));
    series.name = name.toStdString();
    series.color = chart_color(line.color);
    series.width = (line.dots ? 2 : line.width) * theme::scale();
    series.dashes = line.dashes;
    if (line.dots) {
      series.marker = ChartMarker::dot;
    }
    chart.legend.push_back(chart.series.size());
    chart.series.push_back(std::move(series));
  }
  for (std::size_t k = 0; k + lines_.size() < chart.series.size(); ++k) {
    chart.legend.push_back(k);
  }
  if (!any) {
    chart.hint = hint_.toStdString();
  }
}

void LogChart::draw() const {
  const QSize pixels = size() * devicePixelRatioF();
  if (picture_.size() == pixels) {
    return;
  }
  area_ = paint_chart(chart(), picture_, pixels, devicePixelRatioF());
}

void LogChart::paintEvent(QPaintEvent*) {
  draw();
  QPainter(this).drawImage(rect(), picture_);
}

}  // namespace transillum::viewer
