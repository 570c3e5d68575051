// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "log_chart.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "number_text.h"
#include "theme.h"

namespace transillum::viewer {

namespace {

bool drawable(double value) { return value > 0 && std::isfinite(value); }

int count_step(int count, int labels) {
  const double rough = std::max(1.0, static_cast<double>(count) / std::max(labels, 1));
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double lead : {1.0, 2.0, 5.0})
    if (lead * power >= rough) return static_cast<int>(lead * power);
  return static_cast<int>(10 * power);
}

}  // namespace

Decades decades_of(const std::vector<LogChart::Line>& lines,
                   const std::vector<LogChart::Level>& levels) {
  double low = HUGE_VAL, high = 0;
  const auto count = [&](double value) {
    if (!drawable(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const auto& line : lines)
    for (const double value : line.values) count(value);
  const bool any = high > 0;
  for (const auto& level : levels) count(level.value);
  if (!any) count(1);  // room for what will come, above a level that waits alone
  Decades decades{static_cast<int>(std::floor(std::log10(low))),
                  static_cast<int>(std::ceil(std::log10(high)))};
  if (decades.first == decades.last) --decades.first;
  return decades;
}

struct LogChart::Frame {
  QRectF plot;
  Decades decades;
  int x_max = 1;
  bool titled = true;  ///< the axes

  double x(double count) const {
    return plot.left() + (x_max > 1 ? (count - 1) / (x_max - 1) : 0.5) * plot.width();
  }
  double y(double value) const {
    const double share = (std::log10(value) - decades.first) / (decades.last - decades.first);
    return plot.bottom() - share * plot.height();
  }
};

LogChart::LogChart(const QString& title, const QString& x_title, const QString& y_title,
                   QWidget* parent)
    : QWidget(parent), title_(title), x_title_(x_title), y_title_(y_title) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void LogChart::set_title(const QString& title) {
  if (title == title_) return;
  title_ = title;
  update();
}

void LogChart::show_lines(std::vector<Line> lines, std::vector<Level> levels, int x_max) {
  lines_ = std::move(lines);
  levels_ = std::move(levels);
  x_max_ = std::max(x_max, 1);
  for (const Line& line : lines_) x_max_ = std::max(x_max_, static_cast<int>(line.values.size()));
  update();
}

void LogChart::set_mark(std::optional<int> x) {
  if (x == mark_) return;
  mark_ = x;
  update();
}

int LogChart::count_at(const QPointF& place) const {
  const Frame f = frame();
  const double share = (place.x() - f.plot.left()) / std::max(f.plot.width(), 1.0);
  return static_cast<int>(std::clamp(std::round(1 + share * (f.x_max - 1)), 1.0, 1.0 * f.x_max));
}

QPointF LogChart::place_of(int x) const {
  const Frame f = frame();
  return {f.x(x), f.plot.center().y()};
}

void LogChart::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && frame().plot.contains(event->localPos()))
    emit clicked(count_at(event->localPos()));
}

LogChart::Frame LogChart::frame() const {
  const int line = fontMetrics().height();
  const int left = line + 10 + fontMetrics().horizontalAdvance(QStringLiteral("10⁻¹²")) + 6;
  Frame result;
  // A low chart needs its height for the lines; the title tells what it shows.
  result.titled = height() > 9 * line;
  const int below = (result.titled ? 2 * line : line) + 12;
  result.plot =
      QRectF(rect()).adjusted(result.titled ? left : left - line, 2 * line + 16, -16, -below);
  result.decades = decades_of(lines_, levels_);
  result.x_max = x_max_;
  return result;
}

void LogChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::paper);
  const Frame f = frame();
  const int line = fontMetrics().height();

  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(theme::ink);
  const QRectF title_row(12, 6, width() - 24, line);
  painter.drawText(title_row, Qt::AlignLeft | Qt::AlignVCenter, title_);
  painter.setFont(font());
  painter.setPen(theme::ink_dim);
  if (!f.titled) painter.drawText(title_row, Qt::AlignRight | Qt::AlignVCenter, x_title_);
  if (f.plot.width() < 40 || f.plot.height() < 20) return;

  draw_axes(painter, f);
  const bool any = std::any_of(lines_.begin(), lines_.end(), [](const Line& l) {
    return std::any_of(l.values.begin(), l.values.end(), drawable);
  });
  if (!any) {
    painter.setPen(theme::ink_dim);
    painter.drawText(f.plot, Qt::AlignCenter | Qt::TextWordWrap, hint_);
  }
  for (const Level& level : levels_) {
    if (!drawable(level.value)) continue;
    painter.setPen(QPen(level.color, 1.5 * theme::scale(), Qt::DashLine));
    painter.drawLine(QPointF(f.plot.left(), f.y(level.value)),
                     QPointF(f.plot.right(), f.y(level.value)));
  }
  if (mark_ && *mark_ <= f.x_max) {
    painter.setPen(QPen(theme::accent, 5));
    painter.drawLine(QPointF(f.x(*mark_), f.plot.top()), QPointF(f.x(*mark_), f.plot.top() + 6));
    painter.setPen(QPen(theme::accent, 1));
    painter.drawLine(QPointF(f.x(*mark_), f.plot.top()), QPointF(f.x(*mark_), f.plot.bottom()));
  }
  for (const Line& l : lines_) draw_line(painter, f, l);
  draw_legend(painter, f);
}

void LogChart::draw_axes(QPainter& painter, const Frame& f) const {
  const int line = fontMetrics().height();
  const int span = f.decades.last - f.decades.first;
  const int every = std::max(1, static_cast<int>(std::ceil(span * (line + 4.0) / f.plot.height())));
  for (int e = f.decades.first; e <= f.decades.last; ++e) {
    const double y = f.y(std::pow(10.0, e));
    painter.setPen(QPen(theme::rule, 1));
    if ((e - f.decades.first) % every == 0) {
      painter.drawLine(QPointF(f.plot.left(), y), QPointF(f.plot.right(), y));
      painter.setPen(theme::ink);
      painter.drawText(QRectF(0, y - line / 2.0, f.plot.left() - 6, line),
                       Qt::AlignRight | Qt::AlignVCenter, power_of_ten_text(e));
    }
  }
  const int step = count_step(f.x_max - 1, static_cast<int>(f.plot.width() / 60));
  painter.setPen(theme::ink);
  for (int x = 0; x <= f.x_max; x += step) {
    if (x == 0 && step > 1) continue;
    const int at = std::max(x, 1);
    if (x == 0) continue;
    painter.drawLine(QPointF(f.x(at), f.plot.bottom()), QPointF(f.x(at), f.plot.bottom() + 4));
    painter.drawText(QRectF(f.x(at) - 40, f.plot.bottom() + 5, 80, line), Qt::AlignCenter,
                     count_text(at));
  }
  painter.setPen(QPen(theme::ink_dim, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(f.plot);

  painter.setPen(theme::ink_dim);
  if (!f.titled) return;
  painter.drawText(QRectF(f.plot.left(), f.plot.bottom() + line + 5, f.plot.width(), line),
                   Qt::AlignCenter, x_title_);
  painter.save();
  painter.translate(8 + line / 2.0, f.plot.center().y());
  painter.rotate(-90);
  const double room = f.plot.height() + 2 * line;
  painter.drawText(QRectF(-room / 2, -line / 2.0, room, line), Qt::AlignCenter,
                   fontMetrics().elidedText(y_title_, Qt::ElideRight, static_cast<int>(room)));
  painter.restore();
}

void LogChart::draw_line(QPainter& painter, const Frame& f, const Line& l) const {
  painter.save();
  painter.setClipRect(f.plot.adjusted(-4, -4, 4, 4));
  // One column of pixels shows its lowest and highest value: as good as all of them, and quick.
  const auto columns = static_cast<std::size_t>(std::max(f.plot.width(), 1.0));
  const std::size_t block = std::max<std::size_t>(1, l.values.size() / columns);
  QPainterPath path;
  bool pen_down = false;
  const auto add = [&](std::size_t k) {
    const QPointF p(f.x(static_cast<double>(k + 1)), f.y(l.values[k]));
    if (pen_down)
      path.lineTo(p);
    else
      path.moveTo(p);
    pen_down = true;
  };
  for (std::size_t begin = 0; begin < l.values.size(); begin += block) {
    const std::size_t end = std::min(begin + block, l.values.size());
    std::size_t low = end, high = end;
    for (std::size_t k = begin; k < end; ++k) {
      if (!drawable(l.values[k])) continue;
      if (low == end || l.values[k] < l.values[low]) low = k;
      if (high == end || l.values[k] > l.values[high]) high = k;
    }
    if (low == end) {
      pen_down = false;
      continue;
    }
    add(std::min(low, high));
    if (low != high) add(std::max(low, high));
  }
  painter.setPen(QPen(l.color, (l.dots ? 2 : 1.4) * theme::scale(), Qt::SolidLine, Qt::RoundCap,
                      Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(path);
  if (l.dots) {
    painter.setBrush(l.color);
    painter.setPen(Qt::NoPen);
    for (std::size_t k = 0; k < l.values.size(); ++k)
      if (drawable(l.values[k]))
        painter.drawEllipse(QPointF(f.x(static_cast<double>(k + 1)), f.y(l.values[k])), 3, 3);
  }
  painter.restore();
}

void LogChart::draw_legend(QPainter& painter, const Frame& f) const {
  // One row between title and plot.
  const int line = fontMetrics().height();
  const double y = f.plot.top() - line / 2.0 - 5;
  double x = f.plot.left();
  const auto entry = [&](const QString& full_name, const QPen& pen) {
    const auto room = static_cast<int>(f.plot.right() - x) - 25;
    if (room < 30) return;
    const QString name = fontMetrics().elidedText(full_name, Qt::ElideRight, room);
    painter.setPen(pen);
    painter.drawLine(QPointF(x, y), QPointF(x + 20, y));
    painter.setPen(theme::ink);
    const int text_width = fontMetrics().horizontalAdvance(name);
    painter.drawText(QRectF(x + 25, y - line / 2.0, text_width + 2, line), Qt::AlignVCenter, name);
    x += 25 + text_width + 16;
  };
  for (const Line& l : lines_) {
    const auto gaps = std::count_if(l.values.begin(), l.values.end(),
                                    [](double value) { return !drawable(value); });
    entry(gaps == 0 ? l.name : tr("%1 (%2 zero)").arg(l.name, count_text(gaps)), QPen(l.color, 2));
  }
  for (const Level& level : levels_)
    if (drawable(level.value)) entry(level.name, QPen(level.color, 1.5, Qt::DashLine));
}

}  // namespace transillum::viewer
