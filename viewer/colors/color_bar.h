// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QFont>
#include <QRectF>
#include <QSizeF>
#include <QWidget>
#include <optional>
#include <vector>

#include "colors/color_choice.h"
#include "widgets/theme.h"

class QPainter;

namespace transillum::viewer {

/// Draws a labeled color map with its unit, and a histogram of area over values, into a picture.
struct ColorBarSheet {
  const ColorChoice& colors;
  QSizeF size;  ///< logical pixels
  QFont font;
  QColor ink = theme::on_dark;
  QColor dim = theme::on_dark_dim;

  /// Whether `colors` have a color bar.
  static bool applies(const ColorChoice& colors) {
    return colors.scale().mode != ColorMode::true_color && !colors.values().empty();
  }
  void draw(QPainter& painter) const;
  /// The place of the color map.
  QRectF bar() const;

 private:
  bool shows_zero() const;
  void paint_title(QPainter& painter) const;
  void paint_bar(QPainter& painter, const QRectF& bar) const;
  void paint_histogram(QPainter& painter, const QRectF& box) const;
  void paint_zero(QPainter& painter, const QRectF& box) const;
  void paint_ticks(QPainter& painter, const QRectF& bar) const;
};

/// The labeled color map with a histogram of area over values. Hidden in true color, and while
/// there are no values.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(const ColorChoice& colors, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {128, 320}; }

 signals:
  /// The user has dragged over a range of values: the patches with such values, ascending.
  void patches_chosen(const std::vector<transillum::PatchId>& patches);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  ColorBarSheet sheet() const { return {colors_, size(), font()}; }

  const ColorChoice& colors_;
  /// Ends of the range that the user drags over, pixels from the top.
  std::optional<double> drag_begin_;
  double drag_end_ = 0;
};

}  // namespace transillum::viewer
