// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <vector>

#include "io/drawing/line_chart.h"

class QWidget;

namespace transillum::viewer {

ChartColor chart_color(const QColor& color);

/// The theme's colors and the widget's font.
ChartStyle chart_style(const QWidget& widget);

/// Paints `chart` to `picture`, which gets the size `pixels`.
/// @param scale  device pixels per logical pixel
/// @return the plotted area, in logical pixels
ChartArea paint_chart(const LineChart& chart, QImage& picture, const QSize& pixels, double scale);

/// Exponents of powers of ten, first < last.
struct Decades {
  int first = -1, last = 0;
};

/// A line chart with counts from 1 along x and a logarithmic y axis. Values that are not positive
/// leave a gap in the line; the legend gives their number.
class LogChart : public QWidget {
  Q_OBJECT

 public:
  struct Line {
    QString name;
    QColor color;
    std::vector<double> values;  ///< values[k] is at x = k + 1
    bool dots = false;           ///< mark each value
    ChartDashes dashes = ChartDashes::solid;
    double width = 1.4;  ///< pixels
  };
  /// A horizontal line, such as a tolerance.
  struct Level {
    QString name;
    QColor color;
    double value = 0;
  };

  LogChart(const QString& title, const QString& x_title, const QString& y_title,
           QWidget* parent = nullptr);

  void set_title(const QString& title);
  /// @param x_max least right end of the x axis
  void show_lines(std::vector<Line> lines, std::vector<Level> levels, int x_max);
  /// Fixes both axes, for a curve that is drawn by hand.
  /// @param names  of the counts, from 1
  void set_axes(QStringList names, const Decades& decades);
  /// The text shown if there is nothing to draw.
  void set_hint(const QString& hint);
  /// Sets the current count, which a vertical line marks; no mark if it is not set.
  void set_mark(std::optional<int> x);
  std::optional<int> mark() const { return mark_; }
  /// The count nearest to a position in the widget, clamped to the axis.
  int count_at(const QPointF& position) const;
  /// The position in the widget of a count, halfway up.
  QPointF position_of(int x) const;
  /// The chart as it is shown.
  LineChart chart() const;

  /// The position in the widget of a value at a count; inside the plot only between the decades.
  QPointF position_of(int x, double value) const;

  QSize sizeHint() const override { return {420, 210}; }
  QSize minimumSizeHint() const override { return {240, 3 * fontMetrics().height() + 66}; }

 signals:
  void clicked(int x);
  /// The left button is held at a place of the plot: the nearest count, and the value there.
  void pointed(int x, double value);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Scale;
  Scale scale() const;
  void change();
  Decades decades() const;
  void point_at(const QPointF& position);
  void add_levels(LineChart& chart) const;
  void add_mark(LineChart& chart) const;
  void add_lines(LineChart& chart) const;
  void draw() const;

  QString title_, x_title_, y_title_, hint_;
  std::vector<Line> lines_;
  std::vector<Level> levels_;
  int x_max_ = 1;
  QStringList names_;
  std::optional<Decades> decades_;
  std::optional<int> mark_;
  mutable QImage picture_;  ///< in device pixels; null until it is painted
  mutable ChartArea area_;  ///< area of the plot in the picture, logical pixels
};

/// The powers of ten that enclose all positive values; [-1, 0] without values.
Decades decades_of(const std::vector<LogChart::Line>& lines,
                   const std::vector<LogChart::Level>& levels);

}  // namespace transillum::viewer
